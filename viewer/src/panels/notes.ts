import type { JointArrays } from "../core/protocol";
import { button, checkbox, fold, html } from "../dom";
import { longestNotes, longestPinText, mostPins, type Pin, type UserNotes } from "../notes_block";
import { fixed } from "../numbers";
import type { BodyName } from "../scene/body_names";
import type { Picked } from "../scene/picking";
import type { JointScene } from "../scene/scene";
import { words } from "../words";
import { listenToPresses, vertexByNumber } from "./vertex_choice";

/// The user's text on the page, and pins on the bones it is about.
export class NotesPanel {
  readonly element: HTMLDetailsElement;
  private readonly list = html("ol", { class: "pins" });
  private readonly said = html("p", { role: "status", class: "small" });
  private readonly places = new Map<Pin, HTMLElement>();
  private readonly text: HTMLTextAreaElement;
  private readonly pins: Pin[];
  private isPinning = false;
  private X_FM: ArrayLike<number> = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

  /// `changed`: what is on paper and in a copy is other than before.
  constructor(
    private readonly scene: JointScene | null, private readonly names: Record<BodyName, string>, private readonly arrays: JointArrays,
    { text, pins }: UserNotes, private readonly changed: () => void) {
    this.pins = pins.map((pin) => ({ ...pin }));
    this.text = html("textarea", { id: "user-notes", rows: 4, maxlength: longestNotes, dir: "auto" });
    this.text.value = text;
    this.text.addEventListener("input", () => this.changed());
    this.element = fold(words.notesOfUser, pins.length > 0 || text !== "",
      html("p", { class: "small" }, words.notesOfUserHelp),
      html("label", { for: "user-notes" }, words.notesText), this.text,
      html("h3", {}, words.pins), html("div", { class: "row" }, ...(scene ? [checkbox(words.pinOnBones, false, (on) => (this.isPinning = on))] : []),
        ...Object.values(vertexByNumber({ body: words.pinBone, number: words.pinVertex, button: words.pinHere }, names,
          (body) => arrays[body].vertices.length / 3 - 1, (picked) => this.add(picked), (why) => (this.said.textContent = why)))),
      this.said, this.list);
    this.element.id = "notes-of-user";
    if (scene) listenToPresses(scene.canvas, (event) => {
      const picked = this.isPinning && this.element.checkVisibility() ? scene.pick(event) : null;
      if (picked) this.add(picked);
    });
    this.show();
  }

  get notes(): UserNotes {
    return { text: this.text.value, pins: this.pins };
  }

  /// Where pins of the mobile body stand.
  setPose(X_FM: ArrayLike<number>): void {
    this.X_FM = X_FM;
    for (const [pin, place] of this.places) place.textContent = this.placeOf(pin);
  }

  /// "femur, vertex 12: 1.00, 2.00, 3.00 mm in its own frame, ..."
  placeOf({ body, vertex }: Picked): string {
    const own = Array.from(this.arrays[body].vertices.subarray(3 * vertex, 3 * vertex + 3)), said = words.pinPlace(this.names[body], vertex, threeOf(own));
    return body === "fixed" ? said : `${said}, ${words.pinInFixed(this.names.fixed, threeOf(placed(this.X_FM, own)))}`;
  }

  private add({ body, vertex }: Picked): void {
    if (this.pins.length >= mostPins) return void (this.said.textContent = words.tooManyPins(mostPins));
    this.pins.push({ body, vertex, text: "" });
    this.said.textContent = words.pinSet(this.pins.length);
    this.show();
    this.changed();
  }

  private show(): void {
    this.places.clear();
    this.list.replaceChildren(...this.pins.map((pin, i) => this.item(pin, i + 1)));
    this.scene?.setPins(this.pins);
  }

  private item(pin: Pin, number: number): HTMLElement {
    const place = html("span", { class: "small" }, this.placeOf(pin));
    this.places.set(pin, place);
    const text = html("input", { type: "text", class: "pin-text", maxlength: longestPinText, dir: "auto", "aria-label": words.pinText(number) });
    text.value = pin.text;
    text.addEventListener("input", () => {
      pin.text = text.value;
      this.changed();
    });
    const remove = button("×", () => {
      this.pins.splice(number - 1, 1);
      this.show();
      this.changed();
    }, { "aria-label": words.removePin(number), class: "quiet-button" });
    return html("li", {}, html("div", { class: "row" }, text, remove), place);
  }
}

function threeOf(point: readonly number[]): string {
  return point.map((mm) => fixed(mm, 2)).join(", ");
}

function placed(X_FM: ArrayLike<number>, [x, y, z]: readonly number[]): number[] {
  return [0, 1, 2].map((row) => X_FM[4 * row]! * x! + X_FM[4 * row + 1]! * y! + X_FM[4 * row + 2]! * z! + X_FM[4 * row + 3]!);
}
