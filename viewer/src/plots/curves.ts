import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { spaced, svg } from "../dom";
import type { Drawing } from "./figure";

const width = 460, height = 130, left = 52, right = 8, top = 18, bottom = 26;

/// Where all of a curve is 0 its axis ends somewhere.
const nothing = 1e-3;

/// A curve over the frames of a motion, with a cursor; pressed, it goes to the nearest frame.
export class CurvePlot {
  readonly drawing: Drawing;
  private readonly cursor = svg("line", { y1: top, y2: height - bottom, class: "cursor" });
  private readonly x;

  constructor(name: string, unit: string, times: Float64Array, values: Float64Array, go: (frame: number) => void) {
    const finite = Array.from(values).filter(Number.isFinite);
    this.x = scaleLinear([times[0]!, times[times.length - 1]!], [left, width - right]);
    const y = scaleLinear([Math.min(0, ...finite), Math.max(...finite, nothing)], [height - bottom, top]).nice();
    const path = line<number>((_, i) => this.x(times[i]!)).y((value) => y(value)).defined(Number.isFinite);
    // Names of columns end in their units, letters and digits only.
    const title = unit ? `${spaced(name.replace(/_(mm2|mm3|mm|deg|nmm|n|mpa|mj)$/, ""))}, ${unit}` : spaced(name);
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot" },
      svg("text", { x: left, y: 11, class: "small" }, title),
      ...y.ticks(4).flatMap((tick) => [
        svg("line", { x1: left, x2: width - right, y1: y(tick), y2: y(tick), class: "grid" }),
        svg("text", { x: left - 6, y: y(tick) + 4, "text-anchor": "end" }, y.tickFormat(4)(tick)),
      ]),
      ...this.x.ticks(6).map((tick) => svg("text", { x: this.x(tick), y: height - 8, "text-anchor": "middle" }, String(tick))),
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
    this.drawing = {
      name, caption: title, picture, data: () => [["time_s", name], ...Array.from(times, (t, i) => [t, values[i]!])],
    };
  }

  setTime(time: number): void {
    this.cursor.setAttribute("x1", String(this.x(time)));
    this.cursor.setAttribute("x2", String(this.x(time)));
  }
}
