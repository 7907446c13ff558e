import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { spaced, svg } from "../dom";
import type { Recorded } from "../report";
import { words } from "../words";
import type { Drawing } from "./figure";

const width = 460, height = 140, left = 52, right = 18, top = 18, bottom = 36;

/// Kind of a curve at a glance.
export type CurveKind = "changes" | "zero" | "empty";

/// A curve over the frames of a motion, with a cursor that mouse and arrow keys move.
export class CurvePlot {
  readonly drawing: Drawing;
  readonly kind: CurveKind;
  readonly title: string;
  private readonly cursor = svg("line", { y1: top, y2: height - bottom, class: "cursor" });
  private readonly x;

  constructor(
    { name, unit }: Recorded["curves"][number], axis: Recorded["axis"], private readonly times: Float64Array,
    private readonly values: Float64Array, go: (frame: number) => void, frame: () => number) {
    const finite = Array.from(values).filter(Number.isFinite);
    this.kind = finite.length === 0 ? "empty" : finite.every((value) => value === 0) ? "zero" : "changes";
    this.x = scaleLinear([times[0]!, times[times.length - 1]!], [left, width - right]);
    const ends = [Math.min(0, ...finite), Math.max(0, ...finite)];
    const y = scaleLinear(this.kind === "changes" ? ends : [0, 1], [height - bottom, top]).nice();
    const path = line<number>((_, i) => this.x(times[i]!)).y((value) => y(value)).defined(Number.isFinite);
    // Names of columns end in their units, letters and digits only.
    this.title = spaced(name.replace(/_(mm2|mm3|mm|deg|nmm|n|mpa|mj)$/, ""));
    const caption = unit ? `${this.title}, ${unit}` : this.title;
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot curve-plot" },
      svg("text", { x: left, y: 11, class: "small" }, caption),
      ...y.ticks(4).flatMap((tick) => [
        svg("line", { x1: left, x2: width - right, y1: y(tick), y2: y(tick), class: "grid" }),
        svg("text", { x: left - 6, y: y(tick) + 4, "text-anchor": "end" }, y.tickFormat(4)(tick)),
      ]),
      ...this.x.ticks(6).map((tick) => svg("text", { x: this.x(tick), y: height - 21, "text-anchor": "middle" }, String(tick))),
      svg("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle", class: "small" }, words.recordedAxis[axis]),
      svg("path", { d: path(Array.from(values)) ?? "", class: "curve" }),
      this.cursor);
    picture.addEventListener("click", (event) => {
      const box = picture.getBoundingClientRect();
      const time = this.x.invert(((event.clientX - box.left) / box.width) * width);
      let nearest = 0;
      times.forEach((t, i) => {
        if (Math.abs(t - time) < Math.abs(times[nearest]! - time)) nearest = i;
      });
      go(nearest);
    });
    const last = times.length - 1, far = 10;
    picture.addEventListener("keydown", (event) => {
      const to = ({
        ArrowLeft: frame() - 1, ArrowDown: frame() - 1, ArrowRight: frame() + 1, ArrowUp: frame() + 1, PageDown: frame() - far,
        PageUp: frame() + far, Home: 0, End: last,
      } as Record<string, number>)[event.key];
      if (to === undefined) return;
      event.preventDefault();
      go(Math.max(0, Math.min(last, to)));
    });
    this.drawing = {
      name, caption, picture, role: "slider", data: () => [[axis, name], ...Array.from(times, (t, i) => [t, values[i]!])],
    };
    picture.setAttribute("tabindex", "0");
    picture.setAttribute("aria-valuemin", "0");
    picture.setAttribute("aria-valuemax", String(last));
    this.setFrame(0);
  }

  setFrame(frame: number): void {
    const x = String(this.x(this.times[frame]!));
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
    const value = this.values[frame]!;
    this.drawing.picture.setAttribute("aria-valuenow", String(frame));
    this.drawing.picture.setAttribute("aria-valuetext", Number.isFinite(value) ? value.toPrecision(4) : words.noValue);
  }
}
