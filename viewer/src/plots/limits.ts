import { scaleLinear } from "d3-scale";
import { named, spaced, svg } from "../dom";
import type { Band, MotionAnswer } from "../report";
import { words } from "../words";
import { pressable, type Drawing } from "./figure";

const width = 460, rowHeight = 24, left = 206, right = 20, top = 6, bottom = 30;
/// Labels of four digits stay apart from each other.
const tickCount = 4;

/// The band that says something: where nothing ends a motion in its range, nothing does so in most displaced joints either.
export function toldBand({ band, reason }: MotionAnswer): Band | null {
  return band && (reason === "contact" || band.p5_deg.toFixed(0) !== band.p95_deg.toFixed(0)) ? band : null;
}

/// Without its band.
export function limitAlone({ reason, limit_deg, translation_ends, translation_mm }: MotionAnswer): string {
  if (translation_ends && !translation_mm) return "–";
  const number = `${limit_deg.toFixed(1)}°`;
  return reason === "end_of_range" ? words.over(number) : number;
}

function limitText(motion: MotionAnswer): string {
  if (motion.reason === "contact_at_start") return words.reasons.contact_at_start;
  const band = toldBand(motion);
  return limitAlone(motion) + (band ? ` ${words.bandOf(band.p5_deg.toFixed(0), band.p95_deg.toFixed(0))}` : "");
}

/// A bar for each motion, with band and normal range; one pressed goes to its end.
export function limitsDrawing(motions: readonly MotionAnswer[], go: ((motion: MotionAnswer) => void) | null): Drawing {
  const height = top + motions.length * rowHeight + bottom;
  const most = Math.max(10, ...motions.map((m) => Math.max(m.limit_deg, m.band?.p95_deg ?? 0, m.normal_range_deg ?? 0)));
  const x = scaleLinear([0, most], [left, width - right]).nice(tickCount);
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot" });
  const axisY = height - bottom;
  for (const tick of x.ticks(tickCount))
    picture.append(
      svg("line", { x1: x(tick), x2: x(tick), y1: top, y2: axisY, class: "grid" }),
      svg("text", { x: x(tick), y: axisY + 15, "text-anchor": "middle" }, `${tick}°`));
  motions.forEach((motion, i) => {
    const y = top + i * rowHeight, middle = y + rowHeight / 2;
    const name = named(spaced(motion.name));
    const row = svg("g", {},
      svg("rect", { x: 0, y, width, height: rowHeight, class: "row-back" }),
      svg("text", { x: left - 8, y: middle + 4, "text-anchor": "end" }, name),
      svg("rect", { x: x(0), y: y + 6, width: Math.max(0, x(motion.limit_deg) - x(0)), height: rowHeight - 12, class: "bar" }));
    const band = toldBand(motion);
    if (band)
      row.append(
        svg("line", { x1: x(band.p5_deg), x2: x(band.p95_deg), y1: middle, y2: middle, class: "whisker" }),
        ...[band.p5_deg, band.p95_deg].map((end) =>
          svg("line", { x1: x(end), x2: x(end), y1: middle - 5, y2: middle + 5, class: "whisker" })));
    if (motion.normal_range_deg !== null)
      row.append(svg("line", {
        x1: x(motion.normal_range_deg), x2: x(motion.normal_range_deg), y1: y + 2, y2: y + rowHeight - 2, class: "normal",
      }));
    row.append(svg("title", {}, `${name}: ${limitText(motion)}`));
    picture.append(pressable(row, `${words.goThere(name)}: ${limitText(motion)}`, go && (() => go(motion))));
  });
  return {
    name: "limits",
    caption: words.limitsCaption,
    picture,
    data: () => [
      ["motion", "limit_deg", "reason", "contact_kind", "bearing_contact_deg", "normal_range_deg", "p5_deg", "median_deg", "p95_deg"],
      ...motions.map((m) => [
        m.name, m.limit_deg, m.reason, m.contact_kind, m.bearing_contact_deg, m.normal_range_deg, m.band?.p5_deg ?? null,
        m.band?.median_deg ?? null, m.band?.p95_deg ?? null,
      ]),
    ],
  };
}
