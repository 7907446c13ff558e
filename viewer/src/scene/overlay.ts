import { html, svg } from "../dom";
import { words } from "../words";
import type { ColourScale } from "./colour_scale";
import { legendElement } from "./legend";

/// Text over the scene, in pixels of the page from its top left corner.
export interface Written {
  width: number;
  height: number;
  /// Letters of the directions at the edges.
  edges: { top: string; bottom: string; left: string; right: string };
  scaleBar: { length: number; mm: number; isTrueEverywhere: boolean };
  pin: { x: number; y: number; label: string } | null;
  /// Points that the user has set.
  numbered: { x: number; y: number; number: number }[];
}

/// The same where the scene is shown so many times as large.
export function enlarged(written: Written, times: number): Written {
  const { width, height, scaleBar, pin, numbered } = written;
  const moved = <At extends { x: number; y: number }>(at: At) => ({ ...at, x: at.x * times, y: at.y * times });
  return {
    ...written, width: width * times, height: height * times, scaleBar: { ...scaleBar, length: scaleBar.length * times },
    pin: pin && moved(pin), numbered: numbered.map(moved),
  };
}

const pinAside = 34, pinAbove = 40, border = 6;
export const edgeNames = ["top", "bottom", "left", "right"] as const;

/// The corner of a pin's label that is nearest to its point, so that all of it is within the scene.
export function placeOfLabel({ width, height, pin }: Written, labelWidth: number, labelHeight: number): { x: number; y: number } {
  const { x, y } = pin!;
  const isRight = x > width / 2;
  const left = isRight ? x + pinAside : x - pinAside - labelWidth, top = y - pinAbove - labelHeight;
  return {
    x: Math.min(Math.max(border, left), Math.max(border, width - labelWidth - border)),
    y: Math.min(Math.max(border, top < border ? y + pinAbove : top), Math.max(border, height - labelHeight - border)),
  };
}

export function scaleBarText({ mm, isTrueEverywhere }: Written["scaleBar"]): string {
  return isTrueEverywhere ? words.scaleBar(mm) : `${words.scaleBar(mm)} ${words.scaleBarAtCentre}`;
}

/// Elements over the canvas: letters, a scale bar, the legend and a pin. None takes the pointer.
export class SceneOverlay {
  readonly element = html("div", { class: "scene-overlay" });
  private readonly letters = Object.fromEntries(edgeNames.map((name) => [name, html("span", { class: `edge ${name}`, "aria-hidden": "true" })]));
  private readonly barText = html("span", {});
  private readonly bar = html("div", { class: "length" });
  private readonly legend = html("div", { id: "legend", class: "scene-legend" });
  private readonly leader = svg("line", { class: "leader" });
  private readonly ring = svg("circle", { r: 5, class: "ring" });
  private readonly pinDrawing = svg("svg", { class: "scene-pin-drawing", "aria-hidden": "true" }, this.leader, this.ring);
  private readonly pinLabel = html("div", { class: "scene-pin", role: "status" });
  private readonly lost = html("p", { class: "scene-lost", role: "status" });
  private readonly numbers = html("div", { "aria-hidden": "true" });

  constructor() {
    this.pinLabel.hidden = true;
    this.element.append(
      ...Object.values(this.letters), html("div", { class: "scene-scale" }, this.bar, this.barText), this.legend, this.numbers, this.pinDrawing, this.pinLabel, this.lost);
  }

  /// A line while the browser has taken the graphics away.
  setLost(isLost: boolean): void {
    this.lost.textContent = isLost ? words.graphicsLost : "";
  }

  setScale(scale: ColourScale | null): void {
    this.legend.replaceChildren(...(scale ? legendElement(scale) : []));
    this.legend.hidden = scale === null;
  }

  update(written: Written): void {
    for (const name of edgeNames) setText(this.letters[name]!, written.edges[name]);
    this.bar.style.width = `${written.scaleBar.length}px`;
    setText(this.barText, scaleBarText(written.scaleBar));
    this.showNumbers(written.numbered);
    const { pin } = written;
    this.pinLabel.hidden = pin === null;
    this.pinDrawing.toggleAttribute("hidden", pin === null);
    if (!pin) return;
    setText(this.pinLabel, pin.label);
    const { offsetWidth: width, offsetHeight: height } = this.pinLabel, at = placeOfLabel(written, width, height);
    this.pinLabel.style.transform = `translate(${at.x}px, ${at.y}px)`;
    const set = (element: SVGElement, values: Record<string, number>) =>
      Object.entries(values).forEach(([name, value]) => element.setAttribute(name, value.toFixed(1)));
    set(this.ring, { cx: pin.x, cy: pin.y });
    set(this.leader, { x1: pin.x, y1: pin.y, x2: at.x + width / 2, y2: at.y + height / 2 });
  }

  private showNumbers(numbered: Written["numbered"]): void {
    while (this.numbers.childElementCount > numbered.length) this.numbers.lastElementChild!.remove();
    while (this.numbers.childElementCount < numbered.length) this.numbers.append(html("span", { class: "scene-number" }));
    numbered.forEach(({ x, y, number }, i) => {
      const mark = this.numbers.children[i] as HTMLElement;
      setText(mark, String(number));
      mark.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    });
  }
}

function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
