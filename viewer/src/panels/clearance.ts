import type { CoreClient } from "../core/client";
import type { BothValues, Coordinates, Surface, Values } from "../core/protocol";

/// The joint is idle when it has not been moved for so long.
const rest_ms = 250;

/// How far apart the bodies are where contact would count, once the joint is idle: from the vertices of either to the nearest point of
/// the other. If the bearing surface is left out, only vertices of the mobile body beside it are measured.
export class Clearance {
  private counted: Uint8Array | null = null;
  private timer = 0;
  private asked = 0;

  constructor(private readonly core: CoreClient, private readonly mobile: Surface, private readonly report: (at: Coordinates, clear_mm: number | null) => void) {}

  /// Per triangle of the mobile body, not 0 where its contact ends no motion.
  leaveOut(triangles: ArrayLike<number>): void {
    this.counted = null;
    if (!Array.from(triangles).some((role) => role !== 0)) return;
    this.counted = new Uint8Array(this.mobile.vertices.length / 3);
    for (let t = 0; t < triangles.length; ++t)
      if (triangles[t] === 0) for (let k = 0; k < 3; ++k) this.counted[this.mobile.triangles[3 * t + k]!] = 1;
  }

  ask(at: Coordinates): void {
    clearTimeout(this.timer);
    const asked = ++this.asked;
    this.timer = window.setTimeout(() => {
      this.core.query({ of: "values", at, quantity: "nearest" }).then((values) => {
        if (asked === this.asked) this.report(at, this.least(values as BothValues));
      }, () => undefined);
    }, rest_ms);
  }

  drop(): void {
    clearTimeout(this.timer);
    ++this.asked;
  }

  private least({ mobile, fixed }: BothValues): number | null {
    const counted = this.counted;
    const of = ({ shown, marks }: Values, counts: (vertex: number) => boolean) =>
      shown.reduce((least, mm, vertex) => (marks[vertex] === 1 && counts(vertex) && mm < least ? mm : least), Infinity);
    const least = counted ? of(mobile, (vertex) => counted[vertex] === 1) : Math.min(of(mobile, () => true), of(fixed, () => true));
    return Number.isFinite(least) ? Math.max(0, least) : null;
  }
}
