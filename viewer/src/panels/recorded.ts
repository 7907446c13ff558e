import { button, html, section } from "../dom";
import { CurvePlot } from "../plots/curves";
import { figure } from "../plots/figure";
import type { Report, Recorded } from "../report";
import { words } from "../words";

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

  constructor(report: Report, recorded: Recorded, private readonly go: (frame: Frame) => void) {
    this.times = report.array(recorded.times_s, "f64");
    this.angles = report.array(recorded.coordinates_deg, "f64");
    this.translations = report.array(recorded.coordinates_mm, "f64");
    this.poses = report.array(recorded.poses, "f64");
    this.plots = recorded.curves.map(({ name, unit, values }) =>
      new CurvePlot(name, unit, this.times, report.array(values, "f64"), (frame) => this.show(frame)));
    this.slider = html("input", { type: "range", min: 0, max: this.times.length - 1, step: 1, value: 0, "aria-label": words.frame });
    this.slider.addEventListener("input", () => this.show(this.slider.valueAsNumber));
    this.playButton = button(words.play, () => this.toggle());
    this.element = section(`${words.recorded}: ${recorded.name}`,
      html("div", { class: "row no-print" }, this.playButton, this.slider), ...this.plots.map((plot) => figure(plot.drawing)));
  }

  private show(frame: number): void {
    this.slider.value = String(frame);
    this.plots.forEach((plot) => plot.setTime(this.times[frame]!));
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
    const begun = performance.now();
    const step = () => {
      const time = this.times[first]! + (performance.now() - begun) / 1000;
      let frame = first;
      while (frame + 1 < this.times.length && this.times[frame + 1]! <= time) ++frame;
      this.show(frame);
      if (frame + 1 < this.times.length) this.playing = requestAnimationFrame(step);
      else this.toggle();
    };
    this.playing = requestAnimationFrame(step);
  }
}
