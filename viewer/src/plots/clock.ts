import { named, spaced, svg } from "../dom";
import type { MotionAnswer, RomAnswer } from "../report";
import { clockTime } from "../numbers";
import { roving } from "../roving";
import { motionName, words } from "../words";
import { pressable, type Drawing } from "./figure";

const width = 300, radius = 92, labelRadius = radius + 26, lineHeight = 15, height = 2 * (labelRadius + lineHeight);
/// Centre of the dial; names stand beside it, so that the picture is wider than high.
const middle = { x: width / 2, y: height / 2 };

/// The end of each motion at its hour on the clock face; null where none has one.
export function clockDrawing(
  motions: readonly MotionAnswer[], plane: RomAnswer["clock_plane"], go: ((motion: MotionAnswer) => void) | null,
  socket: { href: string; radius: number } | null = null): Drawing | null {
  const placed = motions.filter((motion) => motion.clock_hour !== null);
  const without = motions.filter(({ reason, clock_hour }) => reason === "contact" && clock_hour === null);
  if (placed.length === 0) return null;
  const at = (hour: number, r: number): [number, number] => {
    const angle = (hour / 12) * 2 * Math.PI;
    return [middle.x + r * Math.sin(angle), middle.y - r * Math.cos(angle)];
  };
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot clock" },
    ...(socket ? [svg("image", {
      href: socket.href, x: middle.x - socket.radius * radius, y: middle.y - socket.radius * radius, width: 2 * socket.radius * radius,
      height: 2 * socket.radius * radius, class: "socket",
    })] : []),
    svg("circle", { cx: middle.x, cy: middle.y, r: radius, class: "dial" }));
  for (let hour = 1; hour <= 12; ++hour) {
    const [x, y] = at(hour, radius - 14);
    picture.append(svg("text", { x, y: y + 4, "text-anchor": "middle", class: "hour" }, String(hour)));
  }
  const sorted = [...placed].sort((a, b) => a.clock_hour! - b.clock_hour!);
  for (const side of [sorted.filter(({ clock_hour }) => clock_hour! < 6), sorted.filter(({ clock_hour }) => clock_hour! >= 6).reverse()]) {
    const heights = spread(side.map(({ clock_hour }) => at(clock_hour!, labelRadius)[1]));
    side.forEach((motion, i) => {
      const [x, y] = at(motion.clock_hour!, radius);
      const toLeft = motion.clock_hour! >= 6, labelY = heights[i]!;
      const out = Math.sqrt(Math.max(0, labelRadius ** 2 - (labelY - middle.y) ** 2)), labelX = middle.x + (toLeft ? -out : out);
      const name = named(spaced(motion.name));
      const mark = svg("g", {},
        svg("line", { x1: x, y1: y, x2: labelX, y2: labelY, class: "leader" }),
        svg("circle", { cx: x, cy: y, r: 5, class: "mark" }),
        svg("text", { x: labelX + (toLeft ? -3 : 3), y: labelY + 4, "text-anchor": toLeft ? "end" : "start", class: "small" },
          abbreviated(motion.name)),
        svg("title", {}, `${name}: ${clockTime(motion.clock_hour!)}`));
      picture.append(
        pressable(mark, `${abbreviated(motion.name)}, ${words.goThere(name)}: ${clockTime(motion.clock_hour!)}`, go && (() => go(motion))));
    });
  }
  if (go) roving([...picture.querySelectorAll<SVGElement>(".pressable")]);
  const names = (of: readonly MotionAnswer[]) => of.map((m) => `${abbreviated(m.name)}: ${named(spaced(m.name))}`).join("; ");
  return {
    name: "clock",
    caption: [
      words.clockCaption[plane ?? "sagittal"], `${names(sorted)}.`,
      ...(without.length ? [words.withoutHour(without.map(({ name }) => named(motionName(name))).join(", "))] : []),
    ].join(" "),
    picture,
    data: () => [["motion", "clock_hour", "limit_deg"], ...[...sorted, ...without].map((m) => [m.name, m.clock_hour, m.limit_deg])],
  };
}

/// Ascending heights moved no nearer than a line of text, and not below the lowest label of the dial.
function spread(heights: readonly number[]): number[] {
  const lowest = middle.y + labelRadius, moved: number[] = [];
  for (const height of heights) moved.push(Math.max(height, (moved.at(-1) ?? -Infinity) + lineHeight));
  for (let i = moved.length - 1; i >= 0; --i) moved[i] = Math.min(moved[i]!, i + 1 < moved.length ? moved[i + 1]! - lineHeight : lowest);
  return moved;
}

/// "internal_rotation_at_90_flexion" as "IR90".
function abbreviated(name: string): string {
  const [movement, held] = named(name).split("_at_");
  const letters = movement!.length <= 5 ? movement!.toUpperCase() : movement!.split("_").map((word) => word.slice(0, 1).toUpperCase()).join("");
  const unique = movement === "abduction" ? "Ab" : movement === "adduction" ? "Ad" : letters;
  return unique + (held ? held.split("_")[0]! : "");
}
