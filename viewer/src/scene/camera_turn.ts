import { Spherical, Vector3 } from "three";

/// A camera's rotation about its target, upright throughout.
export interface Viewpoint {
  towards: Vector3;
  target: Vector3;
  distance: number;
}

/// Ends within 0.4 s, with a margin of one frame.
const duration_ms = 340;

export function prefersStill(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/// Moves a camera from one viewpoint to another; one move at a time.
export class CameraTurn {
  private frame = 0;
  private begun = 0;

  constructor(private readonly show: (at: Viewpoint) => void, private readonly ended: () => void) {}

  get isUnderWay(): boolean {
    return this.frame !== 0;
  }

  stop(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }

  /// At once if motion is not wanted. A move in progress continues to the new end in its remaining time.
  go(from: Viewpoint, to: Viewpoint): void {
    const first = this.isUnderWay ? this.begun : performance.now();
    this.stop();
    this.begun = first;
    if (prefersStill()) {
      this.show(to);
      this.ended();
      return;
    }
    const begin = new Spherical().setFromVector3(from.towards), end = new Spherical().setFromVector3(to.towards);
    // The shorter arc.
    end.theta = begin.theta + Math.atan2(Math.sin(end.theta - begin.theta), Math.cos(end.theta - begin.theta));
    const begun = performance.now(), left_ms = Math.max(1, duration_ms - (begun - first));
    const step = () => {
      const share = Math.min(1, (performance.now() - begun) / left_ms), eased = share * share * (3 - 2 * share);
      const between = (a: number, b: number) => a + eased * (b - a);
      this.frame = share < 1 ? requestAnimationFrame(step) : 0;
      this.show(share === 1 ? to : {
        towards: new Vector3().setFromSpherical(new Spherical(1, between(begin.phi, end.phi), between(begin.theta, end.theta)).makeSafe()),
        target: from.target.clone().lerp(to.target, eased), distance: between(from.distance, to.distance),
      });
      if (share === 1) this.ended();
    };
    this.frame = requestAnimationFrame(step);
  }
}
