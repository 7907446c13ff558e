import { scaleLinear } from "d3-scale";
import { named, svg } from "../dom";
import type { Band, MotionAnswer, StoredBefore } from "../report";
import { cannotBegin, limitText, shownBand } from "../result";
import { motionName, words } from "../words";
import type { Drawing } from "./figure";

const width = 460, rowHeight = 24, left = 206, right = 20, top = 6, bottom = 30;
/// Labels of four digits stay apart from each other.
const tickCount = 4;

/// The largest angle that a bar of these motions has to show.
export function mostOf(motions: readonly MotionAnswer[]): number {
  return Math.max(10, ...motions.map((m) => Math.max(m.limit_deg, m.band?.p95_deg ?? 0, m.normal_range_deg ?? 0)));
}

/// How far a motion goes as a bar, with its band and the clinical range, on a line as wide as its place.
export function limitBar(motion: MotionAnswer, most: number): SVGSVGElement {
  const x = (deg: number) => (100 * Math.min(most, Math.max(0, deg))) / most;
  const picture = svg("svg", { viewBox: "0 0 100 10", preserveAspectRatio: "none", class: "limit-bar", "aria-hidden": "true" },
    svg("rect", { x: 0, y: 3, width: 100, height: 4, class: "track" }));
  if (!cannotBegin(motion.reason)) picture.append(svg("rect", { x: 0, y: 3, width: x(motion.limit_deg), height: 4, class: "bar" }));
  const band = shownBand(motion);
  if (band) picture.append(svg("rect", { x: x(band.p5_deg), y: 1, width: Math.max(1, x(band.p95_deg) - x(band.p5_deg)), height: 8, class: "band" }));
  if (motion.normal_range_deg !== null) picture.append(svg("rect", { x: x(motion.normal_range_deg) - 0.75, y: 0, width: 1.5, height: 10, class: "normal-mark" }));
  return picture;
}

const bandColumns = (of: string) => [`${of}p5_deg`, `${of}median_deg`, `${of}p95_deg`];
const bandCells = (band: Omit<Band, "text"> | null | undefined) => [band?.p5_deg ?? null, band?.median_deg ?? null, band?.p95_deg ?? null];

/// Every limit with all of its digits, beside that of the joint before, if there is one.
export function limitRows(motions: readonly MotionAnswer[], before: StoredBefore | null = null): (string | number | null)[][] {
  return [
    ["motion", "limit_deg", "reason", "contact_kind", "bearing_contact_deg", "normal_range_deg", ...bandColumns(""), "clock_hour",
      ...(before ? ["before_limit_deg", "before_reason", ...bandColumns("before_"), "difference_deg", "difference_is", ...bandColumns("difference_"),
        "beyond_band"] : [])],
    ...motions.map((m) => [
      m.name, m.limit_deg, m.reason, m.contact_kind, m.bearing_contact_deg, m.normal_range_deg, ...bandCells(m.band), m.clock_hour,
      ...(before ? cellsBefore(before, m.name) : []),
    ]),
  ];
}

function cellsBefore({ rom, differences }: StoredBefore, name: string): (string | number | null)[] {
  const then = rom?.motions.find((motion) => motion.name === name), difference = differences.find(({ motion }) => motion === name);
  return [
    then?.limit_deg ?? null, then?.reason ?? null, ...bandCells(then?.band), difference?.difference_deg ?? null, difference?.difference_is ?? null,
    ...bandCells(difference?.band), difference?.beyond_band == null ? null : String(difference.beyond_band),
  ];
}

/// A bar for each motion, with band, number and clinical range: the limits on paper.
export function limitsDrawing(motions: readonly MotionAnswer[]): Pick<Drawing, "picture" | "caption"> {
  const height = top + motions.length * rowHeight + bottom, numbers = 92, axisY = height - bottom;
  const x = scaleLinear([0, mostOf(motions)], [left, width - right - numbers]).nice(tickCount);
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot" });
  const upright = (deg: number, from: number, to: number, kind: string) => svg("line", { x1: x(deg), x2: x(deg), y1: from, y2: to, class: kind });
  for (const tick of x.ticks(tickCount))
    picture.append(upright(tick, top, axisY, "grid"), svg("text", { x: x(tick), y: axisY + 15, "text-anchor": "middle" }, `${tick}°`));
  motions.forEach((motion, i) => {
    const y = top + i * rowHeight, middle = y + rowHeight / 2, band = shownBand(motion);
    picture.append(
      svg("text", { x: left - 8, y: middle + 4, "text-anchor": "end" }, named(motionName(motion.name))),
      svg("rect", { x: x(0), y: y + 6, width: Math.max(0, x(motion.limit_deg) - x(0)), height: rowHeight - 12, class: "bar" }),
      svg("text", { x: width - 4, y: middle + 4, "text-anchor": "end" }, cannotBegin(motion.reason) ? "–" : limitText(motion)));
    if (band)
      picture.append(svg("line", { x1: x(band.p5_deg), x2: x(band.p95_deg), y1: middle, y2: middle, class: "whisker" }),
        ...[band.p5_deg, band.p95_deg].map((end) => upright(end, middle - 5, middle + 5, "whisker")));
    if (motion.normal_range_deg !== null) picture.append(upright(motion.normal_range_deg, y + 2, y + rowHeight - 2, "normal"));
    if (motion.living?.expected_deg != null) picture.append(svg("circle", { cx: x(motion.living.expected_deg), cy: middle, r: 3, class: "living" }));
  });
  return { caption: words.limitsCaption, picture };
}
