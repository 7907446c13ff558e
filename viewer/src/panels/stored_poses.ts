import type { BothValues, Values } from "../core/protocol";
import { choice, html } from "../dom";
import type { Report, StoredPose } from "../report";
import { motionName, words } from "../words";

/// Poses that the report holds, for pages that cannot compute.
export class StoredPoses {
  /// A choice among them.
  readonly element: HTMLElement;
  readonly names: readonly string[];
  private readonly select: HTMLSelectElement;
  /// The pose shown; null for a frame of a recorded motion.
  private shown: StoredPose | null = null;

  constructor(private readonly report: Report, chosen: (name: string) => void) {
    const names = report.text.poses.map(({ name }) => name);
    const poses = choice<string>(words.precomputed, Object.fromEntries(names.map((name) => [name, motionName(name)])), names[0] ?? "", chosen);
    this.names = names;
    this.select = poses.querySelector("select")!;
    this.element = html("div", { class: "row" }, poses);
  }

  /// The pose of that name, which is shown from now on; null if the report has none.
  take(name: string): StoredPose | null {
    const pose = this.report.text.poses.find((stored) => stored.name === name);
    if (!pose) return null;
    this.select.value = name;
    this.shown = pose;
    return pose;
  }

  /// Another pose is shown, which the report does not hold among these.
  leave(): void {
    this.shown = null;
  }

  /// Gaps of the pose shown.
  get gaps(): BothValues | null {
    return this.shown && { fixed: this.gapsOf(this.shown.fixed_gaps), mobile: this.gapsOf(this.shown.mobile_gaps) };
  }

  private gapsOf(name: string): Values {
    const hundredths = this.report.array(name, "i16"), none = 32767;
    return {
      shown: Float32Array.from(hundredths, (gap) => gap / 100), marks: Uint8Array.from(hundredths, (gap) => (gap === none ? 0 : 1)),
    };
  }
}
