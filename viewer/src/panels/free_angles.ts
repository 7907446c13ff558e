import type { CoreClient } from "../core/client";
import { latestOnly } from "../core/latest";
import type { Coordinates, MapQuestion } from "../core/protocol";
import type { Interval } from "../report";

/// All free intervals of each of `count` angles, the others held as they are, as the core is asked for them at a pose and its translation in F.
export function freeAngles(core: CoreClient, count: number, report: (vary: number, at: Coordinates, intervals: Interval[] | null) => void) {
  return latestOnly<{ at: Coordinates; held: [number, number, number] }>(async ({ at, held }) => {
    try {
      for (let vary = 0; vary < count; ++vary) report(vary, at, await core.query({ of: "mapPoint", question: questionOf(at, held, vary), point: 0 }));
    } catch {
      report(0, at, null);
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

/// A pose by the rule of the limits: free, at an end that contact or a ligament makes, with contact that ends no motion, or past one that does:
/// in contact, or with a ligament strained beyond its end.
export type PoseState = { is: "free" | "bearing" | "impinging" | "strained" } | { is: "limit"; vary: number; isHigh: boolean; byLigament: boolean };

/// `free` are the intervals of each angle in this pose; `touches` if any triangles of the bodies meet, `strains` if a ligament is at its end or past it.
export function stateOf(free: readonly (readonly Interval[])[], angles: readonly number[], touches: boolean, strains: boolean): PoseState {
  const ends = free.flatMap((intervals, vary) => intervals.flatMap(([low, high, atLow, atHigh]) => [
    { vary, isHigh: false, byLigament: atLow === 2, off_deg: atLow ? Math.abs(angles[vary]! - low) : Infinity },
    { vary, isHigh: true, byLigament: atHigh === 2, off_deg: atHigh ? Math.abs(angles[vary]! - high) : Infinity },
  ]));
  const [nearest] = ends.filter(({ off_deg }) => off_deg <= near_deg).sort((a, b) => a.off_deg - b.off_deg);
  if (nearest) return { is: "limit", ...nearest };
  if (free.some((intervals, vary) => !intervalAt(intervals, angles[vary]!))) return { is: strains ? "strained" : "impinging" };
  return { is: touches ? "bearing" : "free" };
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
