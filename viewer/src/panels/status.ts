import { html } from "../dom";
import type { Depth } from "../core/protocol";
import { fixed } from "../numbers";

export interface Exit {
  vary: number;
  to_deg: number;
  turn_deg: number;
}

/// The state of the pose in one line, and in contact a button for the nearest exit. Its height never changes.
export class StatusChip {
  readonly element: HTMLElement;
  private readonly text = html("span", { id: "status-text", "aria-live": "polite" });
  private readonly out = html("button", { type: "button", id: "exit" });
  private exit: Exit | null = null;
  private announcedAt = 0;

  constructor(leave: (exit: Exit) => void) {
    this.out.addEventListener("click", () => this.exit && leave(this.exit));
    this.element = html("div", { id: "status" }, this.text, this.out);
    this.setExit(null, "");
  }

  /// `how` names the contact; `depth` comes once the joint is idle.
  inContact(how: string, depth: Depth | null): void {
    const area = depth && Math.max(depth.area_mm2.fixed ?? 0, depth.area_mm2.mobile ?? 0);
    this.say("contact", [how, [
      ...(depth?.deepest ? [`${fixed(depth.deepest.depth_mm, 1)} mm`] : []), ...(area ? [`${fixed(area, 0)} mm²`] : []),
      ...(depth?.volume_mm3 ? [`${fixed(depth.volume_mm3, 0)} mm³`] : []),
    ].join(", ")].filter(Boolean).join(" · "));
  }

  setExit(exit: Exit | null, said: string): void {
    this.exit = exit;
    this.out.textContent = said;
    this.out.style.visibility = exit ? "" : "hidden";
  }

  /// Contact keeps its exit until another one is known.
  say(state: "free" | "limit" | "bearing" | "contact", text: string): void {
    if (state !== "contact") this.setExit(null, "");
    this.element.dataset["state"] = state;
    // A screen reader is not interrupted at every step of a slider.
    const now = performance.now();
    this.text.setAttribute("aria-live", now - this.announcedAt > 1000 ? "polite" : "off");
    if (this.text.textContent !== text) this.announcedAt = now;
    this.text.textContent = text;
  }
}
