import { checkbox, html } from "../dom";
import { fixed } from "../numbers";
import type { BodyName } from "../scene/body_names";
import type { Picked } from "../scene/picking";
import type { JointScene } from "../scene/scene";
import { words } from "../words";
import { listenToPresses, vertexByNumber } from "./vertex_choice";

/// Values at the pointer, or at a vertex's number: the vertex and its value, and the distance between two vertices.
export class PointerPanel {
  readonly element: HTMLElement;
  /// Over the scene, where the pointer is.
  readonly readout = html("p", { id: "hover", "aria-live": "polite" });
  private measures = false;
  private first: Picked | null = null;

  /// `unit`: that of the values shown now.
  constructor(
    private readonly scene: JointScene, private readonly names: Record<BodyName, string>, private readonly unit: () => string) {
    this.element = html("div", {}, html("div", { class: "row" },
      checkbox(words.measure, false, (on) => {
        this.measures = on;
        this.first = null;
        scene.annotations.showDistance(null);
        this.readout.textContent = on ? words.measureFirst : "";
      }), ...Object.values(vertexByNumber({ body: words.vertexOf, number: words.vertexNumber, button: words.showVertex }, names,
        (body) => scene.bodies[body].surface.vertices.length / 3 - 1, (picked) => this.take(picked), (why) => (this.readout.textContent = why)))));
    let asked = false;
    scene.canvas.addEventListener("pointermove", (event) => {
      if (asked || event.buttons !== 0) return;
      asked = true;
      requestAnimationFrame(() => {
        asked = false;
        if (!this.measures) this.report(scene.pick(event));
      });
    });
    listenToPresses(scene.canvas, (event) => this.take(scene.pick(event)));
  }

  private take(picked: Picked | null): void {
    if (this.measures) this.choose(picked);
    else this.report(picked);
  }

  private report(picked: Picked | null): void {
    if (!picked) return void (this.readout.textContent = "");
    const value = this.scene.bodies[picked.body].valueOf(picked.vertex);
    const text = value ? `${value.isBound ? `${words.bound} ` : ""}${fixed(value.amount, 2)} ${this.unit()}` : words.noValue;
    this.readout.textContent = words.hover(this.names[picked.body], picked.vertex, text);
  }

  private choose(picked: Picked | null): void {
    if (!picked) return;
    if (!this.first) {
      this.first = picked;
      this.scene.annotations.showDistance(null);
      this.readout.textContent = words.measureSecond;
      return;
    }
    const ends = [this.scene.vertexPoint(this.first), this.scene.vertexPoint(picked)] as const;
    this.scene.annotations.showDistance([...ends]);
    this.readout.textContent = words.measured(ends[0].distanceTo(ends[1]));
    this.first = null;
  }
}
