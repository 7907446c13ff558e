import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { svg } from "../dom";
import { plain } from "../numbers";
import type { Drawing } from "./figure";

const left = 44, right = 18, top = 28, bottom = 24;
const strokes = ["curve", "curve second"];

/// Angles by the hour of a clock, with 6 at both ends; null if no hour has one.
export function hoursDrawing(
  name: string, caption: string, axis: string, hours: readonly number[],
  series: readonly { name: string; values: readonly (number | null)[] }[]): Drawing | null {
  const known = series.flatMap(({ values }) => values).filter((value): value is number => value !== null);
  if (known.length === 0) return null;
  // From 6 through 12 to 6: the superior half is the one that matters.
  const order = hours.map((_, i) => i).sort((a, b) => (hours[a]! + 6) % 12 - (hours[b]! + 6) % 12);
  const picture = svg("svg", { class: "plot" });
  return {
    name, caption, picture,
    data: () => [["hour", ...series.map((each) => each.name)], ...order.map((i) => [hours[i]!, ...series.map(({ values }) => values[i] ?? null)])],
    lay: (width, height) => {
      const x = scaleLinear([0, 12], [left, width - right]), at = (i: number) => x((hours[i]! + 6) % 12);
      const y = scaleLinear([Math.min(0, ...known), Math.max(...known)], [height - bottom, top]).nice();
      picture.replaceChildren(
        svg("text", { x: left, y: 13 }, axis),
        ...y.ticks(5).flatMap((tick) => [
          svg("line", { x1: left, x2: width - right, y1: y(tick), y2: y(tick), class: "grid" }),
          svg("text", { x: left - 6, y: y(tick) + 4, "text-anchor": "end" }, `${plain(tick)}°`),
        ]),
        ...[6, 7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5].map((hour, i) => svg("text", { x: x(i), y: height - 7, "text-anchor": "middle" }, String(hour))),
        ...series.map(({ values }, s) => svg("path", {
          class: strokes[s]!,
          d: line<number>((i) => at(i)).y((i) => y(values[i]!)).defined((i) => values[i] !== null)(order) ?? "",
        })),
        ...(series.length > 1 ? series.flatMap(({ name: of }, s) => [
          svg("line", { x1: width - 98, x2: width - 78, y1: 8 + 13 * s, y2: 8 + 13 * s, class: strokes[s]! }),
          svg("text", { x: width - 73, y: 12 + 13 * s }, of),
        ]) : []));
    },
  };
}
