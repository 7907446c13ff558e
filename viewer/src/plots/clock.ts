import { shortened, spaced, svg } from "../dom";
import type { MotionAnswer } from "../report";
import { words } from "../words";
import { pressable, type Drawing } from "./figure";

const size = 300, middle = size / 2, radius = 92;

/// The end of each motion at its hour on the socket; null where none has one.
export function clockDrawing(motions: readonly MotionAnswer[], go: ((motion: MotionAnswer) => void) | null): Drawing | null {
  const placed = motions.filter((motion) => motion.clock_hour !== null);
  if (placed.length === 0) return null;
  const at = (hour: number, r: number): [number, number] => {
    const angle = (hour / 12) * 2 * Math.PI;
    return [middle + r * Math.sin(angle), middle - r * Math.cos(angle)];
  };
  const picture = svg("svg", { viewBox: `0 0 ${size} ${size}`, class: "plot clock" },
    svg("circle", { cx: middle, cy: middle, r: radius, class: "dial" }));
  for (let hour = 1; hour <= 12; ++hour) {
    const [x, y] = at(hour, radius - 14);
    picture.append(svg("text", { x, y: y + 4, "text-anchor": "middle", class: "hour" }, String(hour)));
  }
  // Those near in hour are drawn one outside the other.
  const sorted = [...placed].sort((a, b) => a.clock_hour! - b.clock_hour!);
  sorted.forEach((motion, i) => {
    const before = sorted.slice(0, i).filter((other) => Math.abs(other.clock_hour! - motion.clock_hour!) < 0.5).length;
    const [x, y] = at(motion.clock_hour!, radius + 8 + 13 * before);
    const name = shortened(spaced(motion.name));
    const toLeft = x < middle;
    const mark = svg("g", {},
      svg("circle", { cx: x, cy: y, r: 5, class: "mark" }),
      svg("text", { x: x + (toLeft ? -8 : 8), y: y + 4, "text-anchor": toLeft ? "end" : "start", class: "small" },
        abbreviated(motion.name)),
      svg("title", {}, `${name}: ${motion.clock_hour!.toFixed(1)}`));
    picture.append(pressable(mark, `${abbreviated(motion.name)}, ${words.goThere(name)}: ${motion.clock_hour!.toFixed(1)}`, go && (() => go(motion))));
  });
  return {
    name: "clock",
    caption: `${words.clockCaption} ${sorted.map((m) => `${abbreviated(m.name)}: ${spaced(m.name)}`).join("; ")}.`,
    picture,
    data: () => [["motion", "clock_hour", "limit_deg"], ...sorted.map((m) => [m.name, m.clock_hour, m.limit_deg])],
  };
}

/// "internal_rotation_at_90_flexion" as "IR90".
function abbreviated(name: string): string {
  const [movement, held] = name.split("_at_");
  const letters = movement!.length <= 5 ? movement!.toUpperCase() : movement!.split("_").map((word) => word.slice(0, 1).toUpperCase()).join("");
  const unique = movement === "abduction" ? "Ab" : movement === "adduction" ? "Ad" : letters;
  return unique + (held ? held.split("_")[0]! : "");
}
