import type { Coordinates } from "./core/protocol";
import { shortened } from "./dom";
import type { ReportText } from "./report";
import { typed } from "./numbers";
import { refusalOf } from "./panels/angle_field";
import { farthest_deg, shiftRange } from "./panels/motion";
import { words } from "./words";
import { readViewState, writeViewState, type ViewState } from "./view_state";

const translationNames = ["x", "y", "z"];

/// The view at hand: the joint's coordinates and the rest of what a shared link restores.
export interface View extends Omit<ViewState, "coordinates"> {
  at: Coordinates;
}

/// The address as a link to the page's view. Each gesture is a step of the browser's history, by its number in the state of its entry.
export class ViewAddress {
  private timer = 0;
  private latest: number;

  /// Once `closed` is aborted, the address is that of another page.
  constructor(private readonly text: ReportText, private readonly view: () => View, private readonly closed: AbortSignal) {
    if (history.state === null) history.replaceState({ step: 0 }, "");
    this.latest = this.step;
  }

  /// How many steps lead back to where the page was opened.
  get step(): number {
    return (history.state as { step: number } | null)?.step ?? 0;
  }

  /// The present view stays as a step, and a gesture makes the next one.
  begin(): void {
    this.write();
    history.pushState({ step: (this.latest = this.step + 1) }, "");
  }

  /// Whether the address is a step that was there; another one, which was typed, is made the next.
  returned(): boolean {
    const isStep = history.state !== null;
    if (!isStep) history.replaceState({ step: this.latest + 1 }, "");
    this.latest = this.step;
    return isStep;
  }

  /// The view in the address; `values` are angles and translation, those of the reference pose unless the address gives others that a field
  /// would take. `refused` has a line for each that none would.
  read(): ViewState & { values: number[]; refused: string[] } {
    const fields = new URLSearchParams(location.hash.replace(/^#/, "")), refused: string[] = [], coordinates: Record<string, number> = {};
    const reference = Object.entries(this.referencePose()), { joint, rom, recorded, recorded_motion: file } = this.text;
    // Limits along a record, and frames, shift joints that are not free.
    const isHeld = joint.kind !== "free" && recorded === null && file === undefined && rom?.exact !== false && !rom?.held_translation_mm;
    for (const [name, value] of reference) {
      const said = fields.get(name);
      if (said === null) continue;
      const isShift = translationNames.includes(name), range: [number, number] = isShift ? shiftRange(value) : [-farthest_deg, farthest_deg];
      const why = isShift && isHeld ? words.centreIsHeld : refusalOf(said, ...range, isShift ? " mm" : "°");
      if (why === null) coordinates[name] = typed(said)!;
      else refused.push(words.inAddress(`${name}=${shortened(said, 20)}`, why));
    }
    return { ...readViewState(location.hash), coordinates, refused, values: reference.map(([name, value]) => coordinates[name] ?? value) };
  }

  /// Browsers refuse an address that changes at every frame.
  remember(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.write(), 300);
  }

  write(): void {
    if (this.closed.aborted) return;
    const { at: { angles, translation }, ...rest } = this.view();
    const values = [...angles, ...translation];
    const coordinates = Object.fromEntries(
      Object.entries(this.referencePose()).map(([name, reference], i) => [name, values[i]!, reference] as const)
        .filter(([, value, reference]) => value !== reference));
    history.replaceState(history.state, "", writeViewState({ coordinates, ...rest }));
  }

  /// Coordinates by their names in the address.
  private referencePose(): Record<string, number> {
    const { coordinates, reference_deg, reference_mm } = this.text;
    return Object.fromEntries([
      ...coordinates.map(({ name }, i) => [name, reference_deg[i]!] as const),
      ...translationNames.map((name, i) => [name, reference_mm[i]!] as const),
    ]);
  }
}
