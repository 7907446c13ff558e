import { scaleLinear, type ScaleLinear } from "d3-scale";
import { html, named, spaced, svg } from "../dom";
import { fixed, plain, signed } from "../numbers";
import type { StoredSweep, SweptParameter } from "../report";
import { words } from "../words";
import { figure } from "./figure";

const width = 560, left = 52, right = 12, top = 4, bottom = 34;
/// Heights of a map and of a strip.
const planeHeight = 112, stripHeight = 34;
/// Cells at least so wide and high have their margins in them.
const roomForNumber = { width: 24, height: 12 };

/// A design's margin, and the target that has the least to spare.
interface Design {
  margin_deg: number | null;
  target: string | null;
}

interface Axis {
  parameter: SweptParameter;
  scale: ScaleLinear<number, number>;
  /// Half a step, in the picture's units.
  half: number;
}

/// The designs of a sweep that leave every target free: a cell for each computed design, a line along the last parameter where values are
/// known to be free, and a point at the values of the joint, which drags and moves by arrow keys.
export class SweepMap {
  readonly element: HTMLElement;
  private readonly x: Axis;
  private readonly y: Axis | null;
  private readonly picture: SVGSVGElement;
  private readonly point = svg("g", { class: "cross" });
  /// The point's own text, shortened.
  private readonly said = html("p", { class: "small", "aria-hidden": "true" });
  private at: number[];

  /// `moved` to values in the hand, in the order of the sweep's parameters. `prefix` is of ids: a hidden map's patterns draw nothing in another one.
  constructor(
    private readonly sweep: StoredSweep, private readonly margins: Float64Array, private readonly least: Uint8Array,
    private readonly moved: (values: number[]) => void, private readonly prefix = "") {
    const [first, second] = sweep.parameters as [SweptParameter, SweptParameter | undefined];
    const high = second ? planeHeight : stripHeight;
    this.x = axisOf(first, [left, width - right]);
    this.y = second ? axisOf(second, [top + high, top]) : null;
    this.at = sweep.parameters.map(({ first: low }) => low);
    const height = top + high + bottom;
    this.picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot map sweep-map", tabindex: 0 });
    this.drawCells(high);
    this.drawLines(high);
    this.drawAxes(high, height);
    this.point.append(svg("line", { x1: -9, x2: 9, y1: 0, y2: 0 }), svg("line", { x1: 0, x2: 0, y1: -9, y2: 9 }), svg("circle", { r: 5 }));
    this.picture.append(this.point);
    this.listen();
    const names = sweep.parameters.map(({ name }) => nameOf(name)) as [string, string?];
    this.element = html("div", { class: "sweep-place" },
      figure({ name: "sweep", caption: words.sweepCaption, picture: this.picture, role: "slider", data: () => this.data() }, this.legend()), this.said);
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
    this.point.setAttribute("transform", `translate(${this.x.scale(values[0]!).toFixed(2)} ${(this.y ? this.y.scale(values[1]!) : top + stripHeight / 2).toFixed(2)})`);
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

  private drawCells(high: number): void {
    const { x, y } = this, wide = 2 * x.half, tall = y ? 2 * y.half : high;
    this.picture.append(svg("defs", {}, svg("pattern", { id: `${this.prefix}sweep-unfree`, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
      svg("rect", { width: 6, height: 6, class: "unfree-back" }), svg("rect", { width: 2, height: 6, class: "unfree-line" }))));
    const isRoomy = wide >= roomForNumber.width && tall >= roomForNumber.height;
    for (let i = 0; i < this.margins.length; ++i) {
      const [a, b] = this.valuesOf(i) as [number, number?], { margin_deg } = this.design(i);
      const middle = { x: x.scale(a), y: y ? y.scale(b!) : top + high / 2 };
      this.picture.append(svg("rect", {
        x: middle.x - x.half, y: middle.y - tall / 2, width: wide, height: tall,
        class: margin_deg === null ? "sweep-contact" : margin_deg >= 0 ? "sweep-safe" : "sweep-short",
        ...(margin_deg === null ? { fill: `url(#${this.prefix}sweep-unfree)` } : {}),
      }));
      if (isRoomy && margin_deg !== null)
        this.picture.append(svg("text", { x: middle.x + (y ? 4 : 0), y: middle.y + 4, "text-anchor": y ? "start" : "middle", class: "sweep-number", "aria-hidden": "true" }, signed(margin_deg, Math.abs(margin_deg) < 1 ? 1 : 0)));
    }
  }

  /// Along the last parameter: ends are known to a hundredth of a step.
  private drawLines(high: number): void {
    for (const { line, low, high: above } of this.sweep.safe) {
      if (this.y) {
        const { first, step } = this.x.parameter, x = this.x.scale(first + line * step);
        this.picture.append(svg("line", { x1: x, x2: x, y1: this.y.scale(low), y2: this.y.scale(above), class: "sweep-line" }));
      } else {
        this.picture.append(svg("line", { x1: this.x.scale(low), x2: this.x.scale(above), y1: top + high, y2: top + high, class: "sweep-line" }));
      }
    }
  }

  private drawAxes(high: number, height: number): void {
    const unit = ({ unit: of }: SweptParameter) => (of === "deg" ? "°" : "");
    for (const tick of this.x.scale.ticks(8))
      this.picture.append(svg("text", { x: this.x.scale(tick), y: top + high + 15, "text-anchor": "middle" }, `${plain(tick)}${unit(this.x.parameter)}`));
    this.picture.append(svg("text", { x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle" }, nameOf(this.x.parameter.name)));
    if (!this.y) return;
    for (const tick of this.y.scale.ticks(6))
      this.picture.append(svg("text", { x: left - 6, y: this.y.scale(tick) + 4, "text-anchor": "end" }, `${plain(tick)}${unit(this.y.parameter)}`));
    this.picture.append(svg("text", { transform: `translate(13 ${top + high / 2}) rotate(-90)`, "text-anchor": "middle" }, nameOf(this.y.parameter.name)));
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

function axisOf(parameter: SweptParameter, range: [number, number]): Axis {
  const { first, step, count } = parameter, last = first + (count - 1) * step, margin = count > 1 ? step / 2 : 0.5;
  const scale = scaleLinear([first - margin, last + margin], range);
  return { parameter, scale, half: Math.abs(scale(margin) - scale(0)) };
}

/// "cup inclination" of "cup.inclination".
function nameOf(parameter: string): string {
  return spaced(named(parameter)).replace(".", " ");
}
