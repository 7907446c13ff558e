import type { CoreClient } from "../core/client";
import type { Coordinates, MapQuestion } from "../core/protocol";
import type { Interval } from "../report";

interface Request {
  at: Coordinates;
  held: [number, number, number];
}

/// All free intervals of each angle, the others held as they are. The core is queried one pose at a time; of poses that come
/// meanwhile, only the latest.
export class FreeAngles {
  private waiting: Request | null = null;
  private isBusy = false;

  constructor(
    private readonly core: CoreClient, private readonly count: number,
    private readonly report: (vary: number, at: Coordinates, intervals: Interval[]) => void) {}

  ask(at: Coordinates, X_FM: ArrayLike<number>): void {
    this.waiting = { at, held: [X_FM[3]!, X_FM[7]!, X_FM[11]!] };
    if (!this.isBusy) void this.work();
  }

  private async work(): Promise<void> {
    this.isBusy = true;
    while (this.waiting) {
      const { at, held } = this.waiting;
      this.waiting = null;
      try {
        for (let vary = 0; vary < this.count; ++vary)
          this.report(vary, at, (await this.core.query({ of: "mapPoint", question: questionOf(at, held, vary), point: 0 })) as Interval[]);
      } catch {
        // Without computable free angles a pose shows none.
      }
    }
    this.isBusy = false;
  }
}

/// A map of one point.
function questionOf({ angles }: Coordinates, held: [number, number, number], vary: number): MapQuestion {
  const [columnAngle, rowAngle] = [0, 1, 2].filter((angle) => angle !== vary) as [number, number];
  return { columnAngle, rowAngle, vary, columns: [angles[columnAngle]!], rows: [angles[rowAngle]!], held };
}

/// An end of a free interval is free itself, short of contact by less than this.
const hair_deg = 1e-6;

export function intervalAt(intervals: readonly Interval[], deg: number): Interval | null {
  return intervals.find(([low, high]) => low - hair_deg <= deg && deg <= high + hair_deg) ?? null;
}

/// The smallest rotation of this angle that leaves contact; null if none does.
export function nearestExit(intervals: readonly Interval[], deg: number): { to_deg: number; turn_deg: number } | null {
  let least: { to_deg: number; turn_deg: number } | null = null;
  for (const [low, high] of intervals) {
    const to_deg = deg < low ? low : deg > high ? high : deg, turn_deg = to_deg - deg;
    if (least === null || Math.abs(turn_deg) < Math.abs(least.turn_deg)) least = { to_deg, turn_deg };
  }
  return least;
}
