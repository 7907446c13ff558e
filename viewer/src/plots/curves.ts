import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { named, spaced, svg } from "../dom";
import { plain } from "../numbers";
import type { Recorded } from "../report";
import { words } from "../words";
import type { Drawing } from "./figure";

const left = 54, right = 14, top = 4, bottom = 40, laneHead = 17, laneGap = 6;

/// Kind of a curve at a glance.
export type CurveKind = "changes" | "zero" | "empty";

/// One number per frame of a motion.
export interface Curve {
  name: string;
  title: string;
  unit: string;
  kind: CurveKind;
  values: Float64Array;
}

export function curveOf({ name, unit }: { name: string; unit: string }, values: Float64Array): Curve {
  const finite = Array.from(values).filter(Number.isFinite);
  return {
    // Names of columns end in their units, letters and digits only.
    name, unit, values, title: spaced(named(name.replace(/_(mm2|mm3|mm|deg|nmm|n|mpa|mj|percent)$/, ""))),
    kind: finite.length === 0 ? "empty" : finite.every((value) => value === 0) ? "zero" : "changes",
  };
}

/// The curves shown first, if they vary: a motion without contact still has a gap to draw.
const first = ["max_pressure_mpa", "area_mm2", "max_depth_mm", "smallest_gap_mm", "mean_pressure_mpa", "force_in_mobile_y_n", "force_in_fixed_y_n"];
export const shownAtOnce = 4;

export function usualCurves(curves: readonly Curve[]): Curve[] {
  const changing = curves.filter(({ kind }) => kind === "changes");
  const wanted = first.flatMap((name) => changing.find((curve) => curve.name === name) ?? []);
  const says = (curve: Curve) => !wanted.includes(curve) && !/^(in_contact|intersecting_pairs|balanced|state)$/.test(curve.name);
  return [...wanted, ...changing.filter(says)].slice(0, shownAtOnce);
}

/// A value with its significant digits.
export function valueText(value: number, unit: string): string {
  if (!Number.isFinite(value)) return words.noValue;
  const size = Math.abs(value), digits = size >= 100 ? 0 : size >= 10 ? 1 : 2;
  return unit === "°" ? `${plain(value, 1)}°` : [plain(value, digits), unit].filter(Boolean).join(" ");
}

/// Curves over each other with one axis of time, and a cursor in all of them that mouse and arrow keys move.
export class CurveStack {
  readonly picture = svg("svg", { class: "plot curve-plot" });
  private readonly cursor = svg("line", { y1: top, class: "cursor" });
  private readonly x;
  private size = { width: 0, height: 0 };
  private shown: readonly Curve[] = [];
  private readouts: SVGTextElement[] = [];
  private frame = 0;

  constructor(private readonly axis: Recorded["axis"], private readonly times: Float64Array, private readonly go: (frame: number) => void) {
    this.x = scaleLinear([times[0]!, times[times.length - 1]!], [0, 1]);
    const { picture } = this;
    picture.setAttribute("tabindex", "0");
    picture.setAttribute("aria-valuemin", "0");
    picture.setAttribute("aria-valuemax", String(times.length - 1));
    const goTo = (event: PointerEvent) => {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM()!.inverse());
      this.go(this.nearest(this.x.invert(at.x)));
    };
    picture.addEventListener("pointerdown", (event) => {
      picture.setPointerCapture(event.pointerId);
      goTo(event);
    });
    picture.addEventListener("pointermove", (event) => {
      if (event.buttons !== 0) goTo(event);
    });
    picture.addEventListener("keydown", (event) => this.moveByKey(event));
  }

  drawing(): Drawing {
    return {
      name: "curves", caption: words.curvesCaption, picture: this.picture, role: "slider",
      lay: (width, height) => {
        this.size = { width, height };
        this.x.range([left, width - right]);
        this.cursor.setAttribute("y2", String(height - bottom));
        this.show(this.shown);
      },
      data: () => [
        [this.axis, ...this.shown.map(({ name }) => name)],
        ...Array.from(this.times, (t, i) => [t, ...this.shown.map(({ values }) => (Number.isFinite(values[i]) ? values[i]! : null))]),
      ],
    };
  }

  show(curves: readonly Curve[]): void {
    this.shown = curves;
    const { width, height } = this.size;
    const each = (height - top - bottom) / Math.max(1, curves.length);
    this.readouts = [];
    this.picture.replaceChildren(
      ...curves.flatMap((curve, i) => this.lane(curve, top + i * each, top + (i + 1) * each - laneGap)),
      ...this.x.ticks(6).map((tick) => svg("text", { x: this.x(tick), y: height - 23, "text-anchor": "middle" }, plain(tick, 3))),
      svg("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, words.recordedAxis[this.axis]),
      this.cursor);
    this.setFrame(this.frame);
  }

  setFrame(frame: number): void {
    this.frame = frame;
    const x = String(this.x(this.times[frame]!));
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
    this.shown.forEach(({ values, unit }, i) => (this.readouts[i]!.textContent = valueText(values[frame]!, unit)));
    this.picture.setAttribute("aria-valuenow", String(frame));
    this.picture.setAttribute("aria-valuetext", this.shown.map(({ title, values, unit }) => `${title} ${valueText(values[frame]!, unit)}`).join(", "));
  }

  private lane(curve: Curve, from: number, to: number): SVGElement[] {
    const finite = Array.from(curve.values).filter(Number.isFinite);
    const ends = [Math.min(0, ...finite), Math.max(0, ...finite)];
    const y = scaleLinear(ends[0] === ends[1] ? [0, 1] : ends, [to, from + laneHead]).nice(3);
    const path = line<number>((_, i) => this.x(this.times[i]!)).y((value) => y(value)).defined(Number.isFinite);
    const { width } = this.size, readout = svg("text", { x: width - right, y: from + 12, "text-anchor": "end", class: "readout" });
    this.readouts.push(readout);
    const room = to - from - laneHead, ticks = room > 42 ? y.ticks(3) : y.domain().slice(room > 13 ? 0 : 1);
    return [
      svg("text", { x: left, y: from + 12 }, curve.unit ? `${curve.title}, ${curve.unit}` : curve.title), readout,
      ...ticks.flatMap((tick) => [
        svg("line", { x1: left, x2: width - right, y1: y(tick), y2: y(tick), class: "grid" }),
        svg("text", { x: left - 6, y: y(tick) + 4, "text-anchor": "end" }, plain(tick, 3)),
      ]),
      svg("path", { d: path(Array.from(curve.values)) ?? "", class: "curve" }),
    ];
  }

  private nearest(time: number): number {
    let nearest = 0;
    this.times.forEach((t, i) => {
      if (Math.abs(t - time) < Math.abs(this.times[nearest]! - time)) nearest = i;
    });
    return nearest;
  }

  private moveByKey(event: KeyboardEvent): void {
    const { frame } = this, last = this.times.length - 1, far = 10;
    const to = ({
      ArrowLeft: frame - 1, ArrowDown: frame - 1, ArrowRight: frame + 1, ArrowUp: frame + 1, PageDown: frame - far, PageUp: frame + far,
      Home: 0, End: last,
    } as Record<string, number>)[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.go(Math.max(0, Math.min(last, to)));
  }
}
