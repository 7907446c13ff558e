import type { CoreClient } from "../core/client";
import type { Coordinates, Nearest } from "../core/protocol";

/// The joint is idle when it has not been moved for so long.
const rest_ms = 250;

/// Where the bodies are nearest to each other, once the joint is idle: the whole surfaces, and if those are a head and its socket, the parts
/// whose contact ends motions; of an implant, whose head lies in its liner in every pose, only these.
export class Clearance {
  private timer = 0;
  private asked = 0;

  constructor(private readonly core: CoreClient, private readonly isImplant: boolean, private readonly report: (at: Coordinates, nearest: Nearest[]) => void) {}

  ask(at: Coordinates): void {
    this.drop();
    const { asked } = this, nearest = (counted: boolean) => this.core.query({ of: "nearest", at, counted });
    this.timer = window.setTimeout(() => void (async () => {
      const whole = await nearest(false), counted = whole.isBearing ? [await nearest(true)] : [];
      if (asked === this.asked) this.report(at, this.isImplant && counted.length ? counted : [whole, ...counted]);
    })().catch(() => undefined), rest_ms);
  }

  drop(): void {
    clearTimeout(this.timer);
    ++this.asked;
  }
}
