import { button, checkbox, choice, html } from "../dom";
import { fixed } from "../numbers";
import type { BodyName } from "../scene/body_names";
import type { Picked } from "../scene/picking";
import type { JointScene } from "../scene/scene";
import { words } from "../words";

const clickTolerance_px = 4;

/// Values at the pointer, or at a vertex's number: the vertex and its value, and the distance between two vertices.
export class PointerPanel {
  readonly element: HTMLElement;
  /// Over the scene, where the pointer is.
  readonly readout = html("p", { id: "hover", "aria-live": "polite" });
  private measures = false;
  private first: Picked | null = null;
  private pressedAt: [number, number] = [0, 0];

  /// `unit`: that of the values shown now.
  constructor(
    private readonly scene: JointScene, private readonly names: Record<BodyName, string>, private readonly unit: () => string) {
    this.element = html("div", {}, html("div", { class: "row" },
      checkbox(words.measure, false, (on) => {
        this.measures = on;
        this.first = null;
        scene.showDistance(null);
        this.readout.textContent = on ? words.measureFirst : "";
      }), ...this.byNumber()));
    let asked = false;
    scene.canvas.addEventListener("pointermove", (event) => {
      if (asked || event.buttons !== 0) return;
      asked = true;
      requestAnimationFrame(() => {
        asked = false;
        if (!this.measures) this.report(scene.pick(event));
      });
    });
    scene.canvas.addEventListener("pointerdown", (event) => (this.pressedAt = [event.clientX, event.clientY]));
    scene.canvas.addEventListener("click", (event) => {
      const [x, y] = this.pressedAt;
      if (Math.hypot(event.clientX - x, event.clientY - y) > clickTolerance_px) return;
      this.take(scene.pick(event));
    });
  }

  /// A vertex by its number, for users without a pointer.
  private byNumber(): HTMLElement[] {
    let body: BodyName = "mobile";
    const most = (name: BodyName) => this.scene.bodies[name].surface.vertices.length / 3 - 1;
    const number = html("input", { type: "number", min: 0, max: most(body), step: 1, value: 0, "aria-label": words.vertexNumber });
    const bodies = choice<BodyName>(words.vertexOf, { mobile: this.names.mobile, fixed: this.names.fixed }, body, (chosen) => {
      body = chosen;
      number.max = String(most(body));
    });
    const submit = () => {
      const vertex = number.valueAsNumber;
      if (Number.isInteger(vertex) && vertex >= 0 && vertex <= most(body)) this.take({ body, vertex });
      else this.readout.textContent = words.noVertex(this.names[body], most(body));
    };
    number.addEventListener("keydown", ({ key }) => {
      if (key === "Enter") submit();
    });
    return [bodies, number, button(words.showVertex, submit)];
  }

  private take(picked: Picked | null): void {
    if (this.measures) this.choose(picked);
    else this.report(picked);
  }

  private report(picked: Picked | null): void {
    if (!picked) {
      this.readout.textContent = "";
      return;
    }
    const value = this.scene.bodies[picked.body].valueOf(picked.vertex);
    const text = value ? `${value.isBound ? `${words.bound} ` : ""}${fixed(value.amount, 2)} ${this.unit()}` : words.noValue;
    this.readout.textContent = words.hover(this.names[picked.body], picked.vertex, text);
  }

  private choose(picked: Picked | null): void {
    if (!picked) return;
    if (!this.first) {
      this.first = picked;
      this.scene.showDistance(null);
      this.readout.textContent = words.measureSecond;
      return;
    }
    const ends = [this.scene.vertexPoint(this.first), this.scene.vertexPoint(picked)] as const;
    this.scene.showDistance([...ends]);
    this.readout.textContent = words.measured(ends[0].distanceTo(ends[1]));
    this.first = null;
  }
}
