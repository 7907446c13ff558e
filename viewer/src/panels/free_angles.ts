import type { CoreClient } from "../core/client";
import { latestOnly } from "../core/latest";
import type { Coordinates, MapQuestion } from "../core/protocol";
import type { Interval } from "../report";
import type { MotionPanel } from "./motion";

/// What a pose is to the limits, null if not known, and all free intervals of each of `count` angles, the others held, at its translation in F.
export function freeAngles(core: CoreClient, count: number, panel: MotionPanel) {
  return latestOnly<{ at: Coordinates; held: [number, number, number] }>(async ({ at, held }) => {
    try {
      panel.setStanding(at, await core.query({ of: "standing", angles: at.angles, held }));
      for (let vary = 0; vary < count; ++vary) panel.setFree(vary, at, await core.query({ of: "mapPoint", question: questionOf(at, held, vary), point: 0 }));
    } catch {
      panel.setStanding(at, null);
    }
  });
}

/// A map of one point.
function questionOf({ angles }: Coordinates, held: [number, number, number], vary: number): MapQuestion {
  const [columnAngle, rowAngle] = [0, 1, 2].filter((angle) => angle !== vary) as [number, number];
  return { columnAngle, rowAngle, vary, columns: [angles[columnAngle]!], rows: [angles[rowAngle]!], held };
}

/// A pose so near the end of a free interval is at it: a field shows a tenth of a degree.
export const near_deg = 0.05;

export function intervalAt(intervals: readonly Interval[], deg: number): Interval | null {
  return intervals.find(([low, high]) => low - near_deg <= deg && deg <= high + near_deg) ?? null;
}

/// The smallest rotation of this angle to where it is free; null if none does.
export function nearestExit(intervals: readonly Interval[], deg: number): { to_deg: number; turn_deg: number } | null {
  let least: { to_deg: number; turn_deg: number } | null = null;
  for (const [low, high] of intervals) {
    const to_deg = deg < low ? low : deg > high ? high : deg, turn_deg = to_deg - deg;
    if (least === null || Math.abs(turn_deg) < Math.abs(least.turn_deg)) least = { to_deg, turn_deg };
  }
  return least;
}
