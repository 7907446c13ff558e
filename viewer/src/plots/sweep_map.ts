import { scaleLinear, type ScaleLinear } from "d3-scale";
import { html, named, spaced, svg } from "../dom";
import { fixed, plain, signed } from "../numbers";
import type { StoredSweep, SweptParameter } from "../report";
import { words } from "../words";
import { figure, hatching, type Drawing } from "./figure";

const left = 52, right = 12, top = 4, bottom = 34;
/// Cells at least so wide and high have their margins in them.
const roomForNumber = { width: 24, height: 13 };

/// A design's margin, and the target that has the least to spare.
interface Design {
  margin_deg: number | null;
  target: string | null;
}

interface Axis {
  parameter: SweptParameter;
  scale: ScaleLinear<number, number>;
}

/// The designs of a sweep that leave every target free: a cell for each computed design, a line along the last parameter where values are
/// known to be free, and a point at the values of the joint, which drags and moves by arrow keys.
export class SweepMap {
  readonly element: HTMLElement;
  readonly drawing: Drawing;
  private readonly x: Axis;
  private readonly y: Axis | null;
  private readonly picture: SVGSVGElement;
  private readonly point = svg("g", { class: "cross" },
    svg("line", { x1: -9, x2: 9, y1: 0, y2: 0 }), svg("line", { x1: 0, x2: 0, y1: -9, y2: 9 }), svg("circle", { r: 5 }));
  /// The point's own text, shortened.
  private readonly said = html("p", { class: "small", "aria-hidden": "true" });
  private at: number[];

  /// `moved` to values in the hand, in the order of the sweep's parameters. `prefix` is of ids: a hidden map's patterns draw nothing in another one.
  constructor(
    private readonly sweep: StoredSweep, private readonly margins: Float64Array, private readonly least: Uint8Array,
    private readonly moved: (values: number[]) => void, private readonly prefix = "") {
    const [first, second] = sweep.parameters as [SweptParameter, SweptParameter | undefined];
    this.x = axisOf(first);
    this.y = second ? axisOf(second) : null;
    this.at = sweep.parameters.map(({ first: low }) => low);
    this.picture = svg("svg", { class: "plot map sweep-map", tabindex: 0 });
    this.listen();
    const names = sweep.parameters.map(({ name }) => nameOf(name)) as [string, string?];
    this.drawing = {
      name: "sweep", caption: words.sweepCaption, picture: this.picture, role: "slider", lay: (width, height) => this.lay(width, height), data: () => this.data(),
    };
    this.element = html("div", { class: second ? "sweep-place" : "sweep-place strip" }, figure(this.drawing, this.legend()), this.said);
    this.picture.setAttribute("aria-label", words.sweepLabel(...names));
    this.picture.setAttribute("aria-valuemin", String(first.first));
    this.picture.setAttribute("aria-valuemax", String(first.last));
  }

  /// Where the joint is; outside of what was swept it has no point.
  show(values: readonly number[]): void {
    this.at = [...values];
    const inside = this.sweep.parameters.every(({ first, last }, i) => values[i]! >= first && values[i]! <= last);
    const amounts = this.sweep.parameters.map(({ unit }, i) => `${plain(values[i]!, 2)}${words.partUnit[unit] ?? ""}`);
    const place = this.sweep.parameters.map(({ name }, i) => `${nameOf(name)} ${amounts[i]}`).join(", ");
    const textAt = (where: string) => (inside ? words.sweepHere(where, this.designText(this.nearest(values))) : words.sweepOutside(where));
    this.point.style.visibility = inside ? "" : "hidden";
    this.movePoint();
    this.picture.setAttribute("aria-valuenow", String(values[0]!));
    this.said.textContent = textAt(amounts.join(", "));
    this.picture.setAttribute("aria-valuetext", textAt(place));
  }

  // -- designs ----------------------------------------------------------------------------------------------------------------------

  private design(i: number): Design {
    const margin = this.margins[i]!;
    return Number.isNaN(margin) ? { margin_deg: null, target: null } : { margin_deg: margin, target: this.sweep.targets[this.least[i]!]!.name };
  }

  private nearest(values: readonly number[]): Design {
    return this.design(this.sweep.parameters.reduce((i, { first, step, count }, p) =>
      i * count + Math.min(count - 1, Math.max(0, Math.round((values[p]! - first) / step))), 0));
  }

  private designText({ margin_deg, target }: Design): string {
    if (margin_deg === null) return words.sweepInContact;
    return margin_deg >= 0 ? words.sweepSafe(fixed(margin_deg, 1), target!) : words.sweepShort(fixed(-margin_deg, 1), target!);
  }

  private valuesOf(i: number): number[] {
    const values: number[] = [];
    for (let p = this.sweep.parameters.length; p-- > 0;) {
      const { first, step, count } = this.sweep.parameters[p]!;
      values[p] = first + (i % count) * step;
      i = Math.floor(i / count);
    }
    return values;
  }

  // -- what is drawn ----------------------------------------------------------------------------------------------------------------

  private lay(width: number, height: number): void {
    const { x, y } = this, base = height - bottom;
    x.scale.range([left, width - right]);
    y?.scale.range([base, top]);
    const wide = (width - left - right) / x.parameter.count, tall = (base - top) / (y?.parameter.count ?? 1);
    this.picture.replaceChildren(svg("defs", {}, hatching(`${this.prefix}sweep-unfree`)), ...this.cells(wide, tall, (top + base) / 2), ...this.lines(base),
      ...this.axes(width, height), this.point);
    this.movePoint();
  }

  private movePoint(): void {
    const middle = (top + this.picture.viewBox.baseVal.height - bottom) / 2, [a, b] = this.at as [number, number?];
    this.point.setAttribute("transform", `translate(${this.x.scale(a).toFixed(2)} ${(this.y ? this.y.scale(b!) : middle).toFixed(2)})`);
  }

  private cells(wide: number, tall: number, middleOfStrip: number): SVGElement[] {
    const { x, y } = this, isRoomy = wide >= roomForNumber.width && tall >= roomForNumber.height;
    return Array.from(this.margins, (_, i) => {
      const [a, b] = this.valuesOf(i) as [number, number?], { margin_deg } = this.design(i);
      const middle = { x: x.scale(a), y: y ? y.scale(b!) : middleOfStrip };
      return [svg("rect", {
        x: middle.x - wide / 2, y: middle.y - tall / 2, width: wide, height: tall,
        class: margin_deg === null ? "sweep-contact" : margin_deg >= 0 ? "sweep-safe" : "sweep-short",
        ...(margin_deg === null ? { fill: `url(#${this.prefix}sweep-unfree)` } : {}),
      }), ...(isRoomy && margin_deg !== null ? [svg("text", {
        x: middle.x + (y ? 4 : 0), y: middle.y + 4, "text-anchor": y ? "start" : "middle", class: "sweep-number", "aria-hidden": "true",
      }, signed(margin_deg, Math.abs(margin_deg) < 1 ? 1 : 0))] : [])];
    }).flat();
  }

  /// Along the last parameter: ends are known to a hundredth of a step.
  private lines(base: number): SVGElement[] {
    return this.sweep.safe.map(({ line, low, high }) => {
      if (!this.y) return svg("line", { x1: this.x.scale(low), x2: this.x.scale(high), y1: base, y2: base, class: "sweep-line" });
      const { first, step } = this.x.parameter, x = this.x.scale(first + line * step);
      return svg("line", { x1: x, x2: x, y1: this.y.scale(low), y2: this.y.scale(high), class: "sweep-line" });
    });
  }

  private axes(width: number, height: number): SVGElement[] {
    const { x, y } = this, base = height - bottom, unit = ({ parameter }: Axis) => (parameter.unit === "deg" ? "°" : "");
    return [
      ...x.scale.ticks(8).map((tick) => svg("text", { x: x.scale(tick), y: base + 15, "text-anchor": "middle" }, `${plain(tick)}${unit(x)}`)),
      svg("text", { x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle" }, nameOf(x.parameter.name)),
      ...(y ? [
        ...y.scale.ticks(6).map((tick) => svg("text", { x: left - 6, y: y.scale(tick) + 4, "text-anchor": "end" }, `${plain(tick)}${unit(y)}`)),
        svg("text", { transform: `translate(13 ${(top + base) / 2}) rotate(-90)`, "text-anchor": "middle" }, nameOf(y.parameter.name)),
      ] : []),
    ];
  }

  private legend(): HTMLElement {
    const key = (kind: string, text: string) => html("span", { class: "key" }, html("span", { class: `sweep-key ${kind}`, "aria-hidden": "true" }), ` ${text}`);
    return html("p", { class: "small map-legend" }, key("sweep-safe", words.sweepKeySafe), key("sweep-short", words.sweepKeyShort), key("sweep-line", words.sweepKeyLine));
  }

  // -- in the hand ------------------------------------------------------------------------------------------------------------------

  private listen(): void {
    const { picture } = this;
    const take = (event: PointerEvent) => {
      const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM()!.inverse());
      this.move([this.x.scale.invert(x), ...(this.y ? [this.y.scale.invert(y)] : [])]);
    };
    picture.addEventListener("pointerdown", (event) => {
      picture.setPointerCapture(event.pointerId);
      take(event);
    });
    picture.addEventListener("pointermove", (event) => {
      if (event.buttons !== 0 && picture.hasPointerCapture(event.pointerId)) take(event);
    });
    picture.addEventListener("keydown", (event) => {
      const [across, up] = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as Record<string, [number, number]>)[event.key] ?? [0, 0];
      if (across === 0 && up === 0) return;
      event.preventDefault();
      const by = this.sweep.parameters.length > 1 ? [across, up] : [across + up];
      this.move(this.at.map((value, i) => value + by[i]! * this.sweep.parameters[i]!.step));
    });
  }

  /// To a tenth, within what was swept.
  private move(values: readonly number[]): void {
    this.moved(values.map((value, i) => {
      const { first, last } = this.sweep.parameters[i]!;
      return Math.min(last, Math.max(first, Number(value.toFixed(1))));
    }));
  }

  private data(): (string | number | null)[][] {
    return [[...this.sweep.parameters.map(({ name }) => name), "margin_deg", "safe"],
      ...Array.from(this.margins, (margin, i) => [...this.valuesOf(i), Number.isNaN(margin) ? null : margin, margin >= 0 ? 1 : 0])];
  }
}

function axisOf(parameter: SweptParameter): Axis {
  const { first, step, count } = parameter, margin = count > 1 ? step / 2 : 0.5;
  return { parameter, scale: scaleLinear().domain([first - margin, first + (count - 1) * step + margin]) };
}

/// "cup inclination" of "cup.inclination".
function nameOf(parameter: string): string {
  return spaced(named(parameter)).replace(".", " ");
}
