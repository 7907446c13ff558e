import { choice, html } from "../dom";
import type { Report, StoredZone } from "../report";
import type { JointScene } from "../scene/scene";
import { motionName, words } from "../words";

/// Marks the impingement zone of one motion: the one shown last or chosen.
export class ZonePanel {
  readonly element: HTMLElement;
  private readonly select: HTMLSelectElement;
  private readonly help = html("span", { class: "small" });

  constructor(
    private readonly scene: JointScene | null, private readonly report: Report, private readonly zones: readonly StoredZone[],
    private readonly changed: () => void) {
    const options = { "": words.noZone, ...Object.fromEntries(zones.map(({ motion }) => [motion, motionName(motion)])) };
    this.element = html("div", { class: "row" }, choice<string>(words.zones, options, "", (motion) => this.mark(motion)), this.help);
    this.select = this.element.querySelector("select")!;
  }

  /// Motion whose zone is marked; none if empty.
  get motion(): string {
    return this.select.value;
  }

  /// Nothing for a motion without a zone.
  show(motion: string): void {
    this.select.value = this.zones.some((zone) => zone.motion === motion) ? motion : "";
    this.mark(this.select.value);
  }

  private mark(motion: string): void {
    const zone = this.zones.find((known) => known.motion === motion);
    this.help.textContent = zone ? words.zoneHelp(String(zone.past_deg)) : "";
    this.scene?.setMarked("zone", zone ? this.report.array(zone.fixed, "u32") : [], zone ? this.report.array(zone.mobile, "u32") : []);
    this.changed();
  }
}
