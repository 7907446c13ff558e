import type { Coordinates } from "./core/protocol";
import type { ReportText } from "./report";
import { readViewState, writeViewState, type ViewState } from "./view_state";

const translationNames = ["x", "y", "z"];

/// The view at hand: the joint's coordinates and the rest of what a shared link restores.
export interface View extends Omit<ViewState, "coordinates"> {
  at: Coordinates;
}

/// The address as a link to the page's view.
export class ViewAddress {
  private timer = 0;

  /// Once `closed` is aborted, the address is that of another page.
  constructor(private readonly text: ReportText, private readonly view: () => View, private readonly closed: AbortSignal) {}

  /// The view in the address; `values` are angles and translation, those of the reference pose unless the address gives others.
  read(): ViewState & { values: number[] } {
    const reference = this.referencePose(), state = readViewState(location.hash, Object.keys(reference));
    return { ...state, values: Object.entries(reference).map(([name, value]) => state.coordinates[name] ?? value) };
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
    history.replaceState(null, "", writeViewState({ coordinates, ...rest }));
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
