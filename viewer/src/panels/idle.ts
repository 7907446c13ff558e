import type { CoreClient } from "../core/client";
import type { Coordinates, Nearest } from "../core/protocol";

/// The joint is idle when it has not been moved for so long.
const rest_ms = 250;

/// Asks about a pose once the joint is idle, and reports the answer unless it has moved meanwhile.
export class Idle {
  private timer = 0;
  private asked = 0;

  ask<Answer>(question: () => Promise<Answer>, report: (answer: Answer) => void): void {
    this.drop();
    const { asked } = this;
    this.timer = window.setTimeout(() => void question().then((answer) => asked === this.asked && report(answer)).catch(() => undefined), rest_ms);
  }

  drop(): void {
    clearTimeout(this.timer);
    ++this.asked;
  }
}

/// Where the bodies are nearest to each other: the whole surfaces, and if those are a head and its socket, the parts whose contact ends motions;
/// of an implant, whose head lies in its liner in every pose, only these.
export async function clearance(core: CoreClient, at: Coordinates, isImplant: boolean): Promise<Nearest[]> {
  const whole = await core.query({ of: "nearest", at, counted: false });
  const counted = whole.isBearing ? [await core.query({ of: "nearest", at, counted: true })] : [];
  return isImplant && counted.length ? counted : [whole, ...counted];
}
