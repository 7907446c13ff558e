import { html, section } from "../dom";
import type { MotionAnswer, StoredSweep } from "../report";
import { SweepMap } from "../plots/sweep_map";
import { words } from "../words";
import { LiveLimits } from "./live_limits";

/// A sweep of a report and its arrays.
export interface ShownSweep {
  stored: StoredSweep;
  margins: Float64Array;
  least: Uint8Array;
}

/// The safe zone of a sweep with a point at the joint's values, which sets them, and the limits there, live.
export class SweepPanel {
  readonly element: HTMLElement;
  readonly limits: LiveLimits;
  private readonly map: SweepMap;

  /// `moved` to values by the names of parameters.
  constructor(private readonly sweep: ShownSweep, motions: readonly MotionAnswer[], moved: (values: ReadonlyMap<string, number>) => void) {
    const { stored, margins, least } = sweep;
    this.limits = new LiveLimits(words.sweepLimits, words.gained, motions);
    this.map = new SweepMap(stored, margins, least, (values) => moved(new Map(stored.parameters.map(({ name }, i) => [name, values[i]!]))));
    this.element = section(words.sweep, this.map.element, this.limits.element, html("p", { class: "small" }, words.sweepNote, ...stored.sweep_notes.map(({ text }) => ` ${words.sweepNoted(text)}`)));
  }

  show(values: ReadonlyMap<string, number>): void {
    this.map.show(this.sweep.stored.parameters.map(({ name }) => values.get(name) ?? NaN));
  }
}
