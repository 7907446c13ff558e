import type { BodyName } from "../scene/body_names";
import type { PickedPoint } from "../scene/picking";
import type { JointScene } from "../scene/scene";

export interface PainterHooks {
  /// Whether the panel of the brush is seen: else the pointer turns the joint.
  isOpen: () => boolean;
  radius_mm: () => number;
  /// The vertices that a stroke has passed over so far; `rests` once the hand lets go.
  drawn: (body: BodyName, along: number[], isFirst: boolean, rests: boolean) => void;
}

/// The pointer as a brush: a drag that begins on a bone draws on it, one beside it turns the joint as ever.
export class Painter {
  private isActive = false;
  private stroke: { body: BodyName; along: number[]; pointer: number; said: number } | null = null;
  private frame = 0;

  constructor(private readonly scene: JointScene, private readonly hooks: PainterHooks) {
    const place = scene.canvas.parentElement!;
    // Before the canvas hears of it, and turns the joint.
    place.addEventListener("pointerdown", (event) => this.begin(event, place), { capture: true });
    place.addEventListener("pointermove", (event) => this.move(event), { capture: true });
    for (const end of ["pointerup", "pointercancel"] as const) place.addEventListener(end, (event) => this.end(event), { capture: true });
    place.addEventListener("pointerleave", () => this.scene.annotations.showRing(null));
  }

  setActive(on: boolean): void {
    this.isActive = on;
    if (!on) this.scene.annotations.showRing(null);
  }

  private get works(): boolean {
    return this.isActive && this.hooks.isOpen();
  }

  private begin(event: PointerEvent, place: HTMLElement): void {
    if (!this.works || event.button !== 0 || event.target !== this.scene.canvas) return;
    const picked = this.scene.pick(event);
    if (!picked) return;
    event.stopPropagation();
    place.setPointerCapture(event.pointerId);
    this.stroke = { body: picked.body, along: [picked.vertex], pointer: event.pointerId, said: 0 };
    this.showRing(picked);
    this.sayLater();
  }

  private move(event: PointerEvent): void {
    const { stroke } = this;
    if (!stroke) {
      if (!this.works || event.buttons !== 0) return;
      const picked = this.scene.pick(event);
      if (picked) this.showRing(picked);
      else this.scene.annotations.showRing(null);
      return;
    }
    if (event.pointerId !== stroke.pointer) return;
    event.stopPropagation();
    const picked = this.scene.pick(event);
    if (picked?.body !== stroke.body) return;
    this.showRing(picked);
    if (stroke.along.at(-1) === picked.vertex) return;
    stroke.along.push(picked.vertex);
    this.sayLater();
  }

  private end(event: PointerEvent): void {
    const { stroke } = this;
    if (stroke?.pointer !== event.pointerId) return;
    event.stopPropagation();
    cancelAnimationFrame(this.frame);
    this.stroke = null;
    this.hooks.drawn(stroke.body, stroke.along, stroke.said === 0, true);
  }

  /// Once a frame.
  private sayLater(): void {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => {
      const { stroke } = this;
      if (stroke) this.hooks.drawn(stroke.body, [...stroke.along], stroke.said++ === 0, false);
    });
  }

  private showRing({ point, normal, body }: PickedPoint): void {
    this.scene.annotations.showRing({ point, normal, body, radius_mm: this.hooks.radius_mm() });
  }
}
