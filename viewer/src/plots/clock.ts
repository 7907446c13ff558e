import { named, svg } from "../dom";
import type { MotionAnswer, RomAnswer } from "../report";
import { clockTime } from "../numbers";
import { roving } from "../roving";
import { motionName, words } from "../words";
import { pressable, type Drawing } from "./figure";

/// Between dial and labels, and the room that these need beside and above.
const out = 26, lineHeight = 15, beside = 62, most = 150;

/// The end of each motion at its hour on the clock face; null where none has one. `socket` is a picture as wide as the dial.
export function clockDrawing(
  motions: readonly MotionAnswer[], plane: RomAnswer["clock_plane"], go: ((motion: MotionAnswer) => void) | null,
  socket: string | null = null): Drawing | null {
  const placed = motions.filter((motion) => motion.clock_hour !== null);
  const without = motions.filter(({ reason, clock_hour }) => reason === "contact" && clock_hour === null);
  if (placed.length === 0) return null;
  const sorted = [...placed].sort((a, b) => a.clock_hour! - b.clock_hour!), nameOf = ({ name }: MotionAnswer) => named(motionName(name));
  const names = (of: readonly MotionAnswer[]) => of.map((m) => `${abbreviated(m.name)}: ${nameOf(m)}`).join("; ");
  const picture = svg("svg", { class: "plot clock" });
  return {
    name: "clock",
    caption: [
      words.clockCaption[plane ?? "sagittal"], `${names(sorted)}.`,
      ...(without.length ? [words.withoutHour(without.map(nameOf).join(", "))] : []),
    ].join(" "),
    picture,
    data: () => [["motion", "clock_hour", "limit_deg"], ...[...sorted, ...without].map((m) => [m.name, m.clock_hour, m.limit_deg])],
    lay: (width, height) => {
      const middle = { x: width / 2, y: height / 2 }, radius = Math.max(40, Math.min(most, width / 2 - out - beside, height / 2 - out - lineHeight / 2));
      const at = (hour: number, r: number): [number, number] => {
        const angle = (hour / 12) * 2 * Math.PI;
        return [middle.x + r * Math.sin(angle), middle.y - r * Math.cos(angle)];
      };
      const box = { x: middle.x - radius, y: middle.y - radius, width: 2 * radius, height: 2 * radius };
      picture.replaceChildren(
        ...(socket ? [svg("image", { href: socket, ...box, class: "socket" })] : []), svg("circle", { cx: middle.x, cy: middle.y, r: radius, class: "dial" }),
        ...[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12].map((hour) => {
          const [x, y] = at(hour, radius - 14);
          return svg("text", { x, y: y + 4, "text-anchor": "middle", class: "hour" }, String(hour));
        }));
      for (const side of [sorted.filter(({ clock_hour }) => clock_hour! < 6), sorted.filter(({ clock_hour }) => clock_hour! >= 6).reverse()]) {
        const heights = spread(side.map(({ clock_hour }) => at(clock_hour!, radius + out)[1]), middle.y + radius + out);
        side.forEach((motion, i) => {
          const [x, y] = at(motion.clock_hour!, radius), sign = motion.clock_hour! >= 6 ? -1 : 1, labelY = heights[i]!;
          const labelX = middle.x + sign * Math.sqrt(Math.max(0, (radius + out) ** 2 - (labelY - middle.y) ** 2)), name = nameOf(motion);
          const mark = svg("g", {},
            svg("line", { x1: x, y1: y, x2: labelX, y2: labelY, class: "leader" }), svg("circle", { cx: x, cy: y, r: 5, class: "mark" }),
            svg("text", { x: labelX + 3 * sign, y: labelY + 4, "text-anchor": sign < 0 ? "end" : "start" }, abbreviated(motion.name)),
            svg("title", {}, `${name}: ${clockTime(motion.clock_hour!)}`));
          picture.append(
            pressable(mark, `${abbreviated(motion.name)}, ${words.goThere(name)}: ${clockTime(motion.clock_hour!)}`, go && (() => go(motion))));
        });
      }
      if (go) roving([...picture.querySelectorAll<SVGElement>(".pressable")]);
    },
  };
}

/// Ascending heights moved no nearer than a line of text, and not below the lowest label of the dial.
function spread(heights: readonly number[], lowest: number): number[] {
  const moved: number[] = [];
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
