import { html } from "../dom";
import type { Depth } from "../core/protocol";
import { fixed } from "../numbers";
import { words } from "../words";

export interface WayOut {
  vary: number;
  to_deg: number;
  turn_deg: number;
}

/// The state of the pose in one line, and from contact the shortest way out to press. It is as high as it ever gets.
export class StatusChip {
  readonly element: HTMLElement;
  private readonly text = html("span", { id: "status-text", "aria-live": "polite" });
  private readonly out = html("button", { type: "button", id: "way-out" });
  private way: WayOut | null = null;
  private toldAt = 0;

  constructor(leave: (way: WayOut) => void) {
    this.out.addEventListener("click", () => this.way && leave(this.way));
    this.element = html("div", { id: "status" }, this.text, this.out);
    this.setWay(null, "");
  }

  /// Not in contact; `clear_mm` comes later, and for some joints never.
  free(clear_mm: number | null): void {
    this.say("free", clear_mm === null ? words.isFree : words.freeClear(fixed(clear_mm, 1)));
    this.setWay(null, "");
  }

  atLimit(place: string): void {
    this.say("limit", words.atLimit(place));
    this.setWay(null, "");
  }

  /// `depth` comes once the joint rests.
  inContact(depth: Depth | null): void {
    const area = depth && Math.max(depth.area_mm2.fixed ?? 0, depth.area_mm2.mobile ?? 0);
    this.say("contact", [words.inContact, [
      ...(depth?.deepest ? [`${fixed(depth.deepest.depth_mm, 1)} mm`] : []), ...(area ? [`${fixed(area, 0)} mm²`] : []),
      ...(depth?.volume_mm3 ? [`${fixed(depth.volume_mm3, 0)} mm³`] : []),
    ].join(", ")].filter(Boolean).join(" · "));
  }

  setWay(way: WayOut | null, said: string): void {
    this.way = way;
    this.out.textContent = said;
    this.out.style.visibility = way ? "" : "hidden";
  }

  private say(state: "free" | "limit" | "contact", text: string): void {
    this.element.dataset["state"] = state;
    // A reader that speaks is not interrupted at every step of a slider.
    const now = performance.now();
    this.text.setAttribute("aria-live", now - this.toldAt > 1000 ? "polite" : "off");
    if (this.text.textContent !== text) this.toldAt = now;
    this.text.textContent = text;
  }
}
