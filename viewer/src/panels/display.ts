import { button, checkbox, choice, html, named, section, spaced } from "../dom";
import type { ShownQuantity } from "../core/protocol";
import type { Marked, Part } from "../scene/body";
import { bodyNames, type BodyName } from "../scene/body_names";
import type { ClipAxis, JointScene } from "../scene/scene";
import type { View } from "../scene/views";
import { colourScale } from "../scene/colour_scale";
import type { DisplayState } from "../view_state";
import { words } from "../words";

const usualEnds = { gap: 8, depth: 4, nearest: 8, pressure: 5 };
const clipRange_mm = 150;

/// Parts of a joint that can be shown.
export interface Showable {
  names: Record<BodyName, string>;
  /// Empty for a body that is one mesh.
  parts: Record<BodyName, readonly Part[]>;
  quantities: readonly ShownQuantity[];
  /// Deepest cut of a plan, at which the scale of the removed bone ends.
  removed_mm: number;
  marks: readonly Exclude<Marked, "zone">[];
}

/// A check box for a body or a part of one, by its name in a shared link.
interface Shown {
  box: HTMLInputElement;
  set: (on: boolean) => void;
}

/// Controls of the scene's display; the colour scale with it.
export class DisplayPanel {
  readonly element: HTMLElement;
  /// The meaning of the colours; their scale stands within the scene.
  readonly legend = html("p", { class: "small" });
  private chosen: ShownQuantity;
  private readonly usualEnds;
  private readonly ends;
  private readonly scaleEnd = html("input", { type: "number", min: 0.1, step: 0.5 });
  private readonly unit = html("span", {});
  private readonly colour: HTMLSelectElement;
  private readonly shown = new Map<string, Shown>();
  private readonly opacity: Record<BodyName, HTMLInputElement>;
  private readonly clipAxis: HTMLSelectElement;
  private readonly clipAt = html("input", {
    type: "range", min: -clipRange_mm, max: clipRange_mm, step: 1, value: 0, "aria-label": words.clipAt,
  });

  /// `recoloured` when another quantity is chosen, `changed` on any change.
  constructor(
    private readonly scene: JointScene | null, private readonly showable: Showable, private readonly recoloured: () => void,
    private readonly changed: () => void) {
    const { names, parts, quantities, marks, removed_mm } = showable;
    this.usualEnds = { ...usualEnds, removed: Math.max(0.5, Math.ceil(2 * removed_mm) / 2) };
    this.ends = { ...this.usualEnds };
    this.chosen = this.usualQuantity;
    this.scaleEnd.addEventListener("input", () => {
      if (this.chosen === "none" || !(this.scaleEnd.valueAsNumber > 0)) return;
      this.ends[this.chosen] = this.scaleEnd.valueAsNumber;
      this.drawScale();
      changed();
    });
    this.opacity = { fixed: this.opacityOf("fixed"), mobile: this.opacityOf("mobile") };
    const bodies = bodyNames.map((body) => html("div", { class: "row" },
      this.shownBox(body, names[body], (on) => scene?.setVisible(body, on)), this.opacity[body],
      ...parts[body].map((part, i) => this.shownBox(`${body}.${i}`, spaced(named(part.name)), (on) => scene?.bodies[body].setPartVisible(part, on)))));
    const colour = choice(words.colour, only(words.quantity, quantities), this.chosen, (key) => {
      this.choose(key);
      changed();
    });
    const clipAxis = choice<ClipAxis>(words.clip, words.clipAxis, "none", () => this.cut());
    this.colour = colour.querySelector("select")!;
    this.clipAxis = clipAxis.querySelector("select")!;
    this.clipAt.addEventListener("input", () => this.cut());
    this.element = section(words.scene,
      html("div", { class: "row views" }, html("span", {}, words.views), ...(Object.keys(words.view) as View[]).map((view) =>
        button(words.view[view], () => {
          scene?.look(view);
          changed();
        }))),
      html("div", { class: "row" }, colour, html("label", {}, `${words.scaleEnd} `, this.scaleEnd, " ", this.unit)),
      ...bodies,
      html("div", { class: "row" }, clipAxis, this.clipAt),
      html("div", { class: "row" },
        ...marks.map((as) => checkbox(as === "contact" ? words.pairs : words.bearing, as === "contact", (on) => scene?.showMarked(as, on))),
        checkbox(words.shading, true, (on) => scene?.setShading(on))));
    this.element.classList.add("no-print");
    this.drawScale();
  }

  /// End of the scale.
  get end(): number {
    return this.chosen === "none" ? 1 : this.ends[this.chosen];
  }

  get quantity(): ShownQuantity {
    return this.chosen;
  }

  /// A page of a plan first shows the bone that goes, one with layers their pressure.
  private get usualQuantity(): ShownQuantity {
    return (["removed", "pressure"] as const).find((key) => this.showable.quantities.includes(key)) ?? "gap";
  }

  get state(): DisplayState {
    const scale = this.chosen === "none" || this.ends[this.chosen] === this.usualEnds[this.chosen] ? null : this.ends[this.chosen];
    return {
      colour: this.chosen, scale, hidden: [...this.shown].filter(([, { box }]) => !box.checked).map(([name]) => name),
      opacity: { fixed: this.opacity.fixed.valueAsNumber, mobile: this.opacity.mobile.valueAsNumber },
      clip: this.clipAxis.value as ClipAxis, clipAt_mm: this.clipAt.valueAsNumber,
    };
  }

  /// A box that stands elsewhere and has that name in a shared link.
  remember(key: string, box: HTMLInputElement, set: (on: boolean) => void): void {
    this.shown.set(key, { box, set });
  }

  /// Applies a shared link; anything it does not mention keeps its default.
  apply(state: DisplayState): void {
    const quantity = this.showable.quantities.find((key) => key === state.colour) ?? this.usualQuantity;
    if (quantity !== "none") this.ends[quantity] = state.scale ?? this.usualEnds[quantity];
    for (const [name, { box, set }] of this.shown) {
      box.checked = !state.hidden.includes(name);
      set(box.checked);
    }
    for (const body of bodyNames) {
      this.opacity[body].valueAsNumber = state.opacity[body];
      this.scene?.setOpacity(body, state.opacity[body]);
    }
    this.clipAxis.value = state.clip;
    this.clipAt.valueAsNumber = state.clipAt_mm;
    this.scene?.clip(state.clip, state.clipAt_mm);
    this.colour.value = quantity;
    this.choose(quantity);
  }

  private choose(quantity: ShownQuantity): void {
    this.chosen = quantity;
    this.drawScale();
    this.recoloured();
  }

  private shownBox(key: string, name: string, set: (on: boolean) => void): HTMLElement {
    const label = checkbox(words.shown(name), true, (on) => {
      set(on);
      this.changed();
    });
    this.shown.set(key, { box: label.querySelector("input")!, set });
    return label;
  }

  private opacityOf(body: BodyName): HTMLInputElement {
    const input = html("input", {
      type: "range", min: 0.1, max: 1, step: 0.05, value: 1, "aria-label": words.opacity(this.showable.names[body]),
    });
    input.addEventListener("input", () => {
      this.scene?.setOpacity(body, input.valueAsNumber);
      this.changed();
    });
    return input;
  }

  private cut(): void {
    this.scene?.clip(this.clipAxis.value as ClipAxis, this.clipAt.valueAsNumber);
    this.changed();
  }

  private drawScale(): void {
    const quantity = this.chosen;
    this.legend.textContent = words.quantityHelp[quantity];
    this.scaleEnd.disabled = quantity === "none";
    if (quantity === "none") {
      this.scene?.setScale(null);
      return;
    }
    const end = this.ends[quantity];
    this.unit.textContent = words.unit[quantity];
    this.scaleEnd.value = String(end);
    this.scene?.setScale(colourScale(quantity, end));
  }
}

function only<Key extends string>(texts: Record<Key, string>, keys: readonly Key[]): Record<Key, string> {
  return Object.fromEntries(keys.map((key) => [key, texts[key]])) as Record<Key, string>;
}
