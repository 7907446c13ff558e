import { button, checkbox, choice, html, named, section } from "../dom";
import type { Quantity } from "../core/protocol";
import type { Part } from "../scene/body";
import type { BodyName, ClipAxis, JointScene, View } from "../scene/scene";
import { colourScale } from "../scene/colour_scale";
import { words } from "../words";

const usualEnd = { gap: 8, depth: 4, nearest: 8, pressure: 5 };
const clipRange_mm = 150;

/// What the scene shows and how; the colour scale with it.
export class DisplayPanel {
  readonly element: HTMLElement;
  readonly legend = html("div", { id: "legend" });
  private chosen: Quantity;
  private readonly ends = { ...usualEnd };
  private readonly scaleEnd = html("input", { type: "number", min: 0.1, step: 0.5 });
  private clipAxis: ClipAxis = "none";
  private clipAt = 0;
  private readonly unit = html("span", {});

  /// `parts` of a body that is one mesh: none. `quantities` that can be shown; `marks` of triangles too.
  constructor(
    private readonly scene: JointScene | null, names: Record<BodyName, string>, parts: Record<BodyName, readonly Part[]>,
    quantities: readonly Quantity[], quantity: Quantity, marks: readonly ("contact" | "bearing")[], changed: () => void) {
    this.chosen = quantity;
    this.scaleEnd.addEventListener("input", () => {
      if (this.chosen === "none" || !(this.scaleEnd.valueAsNumber > 0)) return;
      this.ends[this.chosen] = this.scaleEnd.valueAsNumber;
      this.drawScale();
    });
    const bodies = (["fixed", "mobile"] as const).map((body) => {
      const opacity = html("input", { type: "range", min: 0.1, max: 1, step: 0.05, value: 1, "aria-label": words.opacity(names[body]) });
      opacity.addEventListener("input", () => scene?.setOpacity(body, opacity.valueAsNumber));
      return html("div", { class: "row" },
        checkbox(words.shown(names[body]), true, (on) => scene?.setVisible(body, on)), opacity,
        ...parts[body].map((part) => checkbox(words.shown(named(part.name)), true, (on) => scene?.setPartVisible(body, part, on))));
    });
    const clipAt = html("input", { type: "range", min: -clipRange_mm, max: clipRange_mm, step: 1, value: 0, "aria-label": words.clipAt });
    clipAt.addEventListener("input", () => {
      this.clipAt = clipAt.valueAsNumber;
      scene?.clip(this.clipAxis, this.clipAt);
    });
    this.element = section(words.scene,
      html("div", { class: "row" }, html("span", {}, words.views), ...(Object.keys(words.view) as View[]).map((view) =>
        button(words.view[view], () => {
          scene?.look(view);
          changed();
        }))),
      html("div", { class: "row" },
        choice(words.colour, only(words.quantity, quantities), quantity, (key) => {
          this.chosen = key;
          this.drawScale();
          changed();
        }),
        html("label", {}, `${words.scaleEnd} `, this.scaleEnd, " ", this.unit)),
      ...bodies,
      html("div", { class: "row" },
        choice(words.clip, words.clipAxis, "none", (axis) => {
          this.clipAxis = axis;
          scene?.clip(axis, this.clipAt);
        }), clipAt),
      html("div", { class: "row" },
        ...marks.map((as) => checkbox(as === "contact" ? words.pairs : words.bearing, as === "contact", (on) => scene?.showMarked(as, on))),
        checkbox(words.shading, true, (on) => scene?.setShading(on))));
    this.element.classList.add("no-print");
    this.drawScale();
  }

  get quantity(): Quantity {
    return this.chosen;
  }

  private drawScale(): void {
    const quantity = this.chosen;
    this.legend.replaceChildren();
    this.scaleEnd.disabled = quantity === "none";
    if (quantity === "none") return;
    const end = this.ends[quantity];
    this.unit.textContent = words.unit[quantity];
    this.scaleEnd.value = String(end);
    const scale = colourScale(quantity, end);
    this.scene?.setScale(scale);
    const canvas = html("canvas", { width: 256, height: 1, "aria-hidden": "true" });
    const context = canvas.getContext("2d")!;
    for (let i = 0; i < canvas.width; ++i) {
      context.fillStyle = scale.colour(scale.low + ((scale.high - scale.low) * i) / (canvas.width - 1));
      context.fillRect(i, 0, 1, 1);
    }
    const ticks = scale.low === 0 ? [0, end / 2, end] : [-end, 0, end];
    this.legend.append(
      html("span", {}, `${words.quantity[quantity]}, ${words.unit[quantity]}`), canvas,
      html("span", { class: "ticks" }, ...ticks.map((tick) => html("span", {}, String(Number(tick.toFixed(2)))))),
      html("span", { class: "small" }, words.quantityHelp[quantity]));
  }
}

function only<Key extends string>(texts: Record<Key, string>, keys: readonly Key[]): Record<Key, string> {
  return Object.fromEntries(keys.map((key) => [key, texts[key]])) as Record<Key, string>;
}
