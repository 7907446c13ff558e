import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { named, svg } from "../dom";
import { plain } from "../numbers";
import type { StoredPlan } from "../report";
import { motionName, words } from "../words";
import type { Drawing } from "./figure";

const left = 56, right = 18, top = 26, bottom = 40, keyLine = 14;
const strokes = ["curve", "curve second", "curve third"];

/// The cost of each degree: removed volume over the angle reached, a line for each target by itself; null without points.
export function planCurveDrawing(curve: StoredPlan["curve"]): Drawing | null {
  if (curve.length === 0) return null;
  const motions = [...new Set(curve.map(({ motion }) => motion))];
  const reached = curve.map(({ reached_deg }) => reached_deg);
  const stroke = (i: number) => strokes[i % strokes.length]!, picture = svg("svg", { class: "plot" });
  return {
    name: "plan_curve",
    caption: words.curveCaption(motions.map((motion) => named(motionName(motion))).join(", ")),
    picture,
    data: () => [["motion", "reached_deg", "volume_mm3", "deepest_mm"], ...curve.map((p) => [p.motion, p.reached_deg, p.volume_mm3, p.deepest_mm])],
    lay: (width, height) => {
      const x = scaleLinear([Math.min(...reached), Math.max(...reached)], [left, width - right]).nice();
      const y = scaleLinear([0, Math.max(1e-3, ...curve.map(({ volume_mm3 }) => volume_mm3))], [height - bottom, top + keyLine * (motions.length - 1)]).nice();
      picture.replaceChildren(
        svg("text", { x: left, y: 13 }, words.curveVolume),
        svg("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, words.curveReached),
        ...y.ticks(5).flatMap((tick) => [
          svg("line", { x1: left, x2: width - right, y1: y(tick), y2: y(tick), class: "grid" }),
          svg("text", { x: left - 6, y: y(tick) + 4, "text-anchor": "end" }, String(tick)),
        ]),
        ...x.ticks(6).map((tick) => svg("text", { x: x(tick), y: height - 24, "text-anchor": "middle" }, `${plain(tick)}°`)),
        ...motions.flatMap((motion, i) => {
          const points = curve.filter((point) => point.motion === motion);
          return [
            svg("path", {
              class: stroke(i),
              d: line<(typeof points)[number]>((point) => x(point.reached_deg)).y((point) => y(point.volume_mm3))(points) ?? "",
            }),
            ...points.map((point) => svg("circle", { cx: x(point.reached_deg), cy: y(point.volume_mm3), r: 3, class: "mark" },
              svg("title", {}, words.curvePoint(point.reached_deg.toFixed(1), point.volume_mm3.toFixed(1), point.deepest_mm.toFixed(2))))),
            ...(motions.length > 1 ? [
              svg("line", { x1: 180, x2: 200, y1: 9 + keyLine * i, y2: 9 + keyLine * i, class: stroke(i) }),
              svg("text", { x: 206, y: 13 + keyLine * i }, named(motionName(motion))),
            ] : []),
          ];
        }));
    },
  };
}
