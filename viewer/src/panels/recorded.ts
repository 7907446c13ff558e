import { button, html, named, section } from "../dom";
import { CurvePlot, type CurveKind } from "../plots/curves";
import { figure } from "../plots/figure";
import type { Report, Recorded } from "../report";
import { words } from "../words";

/// Where a file has no times its frames are played one by one, slow enough to be seen.
const untimedFrames_per_s = 20;

/// One frame of a recorded motion; X_FM row by row.
export interface Frame {
  angles: number[];
  translation: number[];
  X_FM: number[];
}

/// A recorded motion that plays, with its curves under it.
export class RecordedPanel {
  readonly element: HTMLElement;
  private readonly times: Float64Array;
  private readonly angles: Float64Array;
  private readonly translations: Float64Array;
  private readonly poses: Float64Array;
  private readonly plots: CurvePlot[];
  private readonly slider: HTMLInputElement;
  private readonly playButton: HTMLButtonElement;
  private playing = 0;

  constructor(report: Report, private readonly recorded: Recorded, private readonly go: (frame: Frame) => void) {
    this.times = report.array(recorded.times_s, "f64");
    this.angles = report.array(recorded.coordinates_deg, "f64");
    this.translations = report.array(recorded.coordinates_mm, "f64");
    this.poses = report.array(recorded.poses, "f64");
    this.plots = recorded.curves.map((curve) => new CurvePlot(
      curve, recorded.axis, this.times, report.array(curve.values, "f64"), (frame) => this.show(frame), () => this.slider.valueAsNumber));
    const last = this.times.length - 1;
    this.slider = html("input", { type: "range", min: 0, max: last, step: 1, value: 0, "aria-label": words.frame });
    this.slider.addEventListener("input", () => this.show(this.slider.valueAsNumber));
    this.playButton = button(words.play, () => this.toggle());
    const span = recorded.axis === "frame" ? words.recordedFrames(last + 1)
      : words.recordedOver(last + 1, String(this.times[0]!), String(this.times[last]!));
    this.element = section(words.recorded, html("p", {}, `${named(recorded.name)}: ${span}`),
      html("div", { class: "row no-print" }, this.playButton, this.slider), ...this.figuresOf("changes"),
      ...this.folded("zero", words.zeroCurves), ...this.folded("empty", words.emptyCurves));
  }

  private figuresOf(kind: CurveKind): HTMLElement[] {
    return this.plots.filter((plot) => plot.kind === kind).map((plot) => figure(plot.drawing));
  }

  /// Curves that say nothing, in one line that opens.
  private folded(kind: CurveKind, line: (names: string) => string): HTMLElement[] {
    const names = this.plots.filter((plot) => plot.kind === kind).map(({ title }) => title);
    if (names.length === 0) return [];
    return [html("details", { class: "folded" }, html("summary", {}, line(names.map(named).join(", "))), ...this.figuresOf(kind))];
  }

  private show(frame: number): void {
    this.slider.value = String(frame);
    this.plots.forEach((plot) => plot.setFrame(frame));
    const of = (numbers: Float64Array, each: number) => Array.from(numbers.subarray(each * frame, each * frame + each));
    this.go({ angles: of(this.angles, 3), translation: of(this.translations, 3), X_FM: of(this.poses, 16) });
  }

  private toggle(): void {
    cancelAnimationFrame(this.playing);
    const starts = this.playing === 0;
    this.playing = 0;
    this.playButton.textContent = starts ? words.pause : words.play;
    if (!starts) return;
    const first = this.slider.valueAsNumber < this.times.length - 1 ? this.slider.valueAsNumber : 0;
    const perSecond = this.recorded.axis === "frame" ? untimedFrames_per_s : 1;
    const begun = performance.now();
    const step = () => {
      const time = this.times[first]! + (perSecond * (performance.now() - begun)) / 1000;
      let frame = first;
      while (frame + 1 < this.times.length && this.times[frame + 1]! <= time) ++frame;
      this.show(frame);
      if (frame + 1 < this.times.length) this.playing = requestAnimationFrame(step);
      else this.toggle();
    };
    this.playing = requestAnimationFrame(step);
  }
}
