import { zipSync } from "fflate";
import { button, checkbox, choice, html, named, section } from "../dom";
import { fixed, plain } from "../numbers";
import { CurveStack, curveOf, shownAtOnce, valueText, usualCurves, type Curve, type CurveKind } from "../plots/curves";
import { figure, type Drawing } from "../plots/figure";
import type { RecordedMotion } from "../recorded_motion";
import { saveBlob } from "../save";
import { words } from "../words";
import type { Extreme } from "./strip";

/// A file without times plays its frames one by one at this rate, slow enough to follow.
const untimedFrames_per_s = 20;

/// One frame of a recorded motion; X_FM row by row.
export interface Frame {
  angles: number[];
  translation: number[];
  X_FM: number[];
}

/// What a joint under load answers first, and the frame that it is of.
export interface Loaded {
  frame: number;
  figures: Extreme[];
  sentence: string;
}

const isGap = ({ name }: Curve) => name === "smallest_gap_mm";

/// The frame with the largest value, of a gap the smallest; -1 if there is none.
function extremeOf(curve: Curve): number {
  const { values } = curve, goes = (value: number, than: number) => (isGap(curve) ? value < than : Math.abs(value) > Math.abs(than));
  return values.reduce((best, value, i) => (Number.isFinite(value) && (best < 0 || goes(value, values[best]!)) ? i : best), -1);
}

/// A recorded motion that plays, with its curves under it.
export class RecordedPanel {
  readonly element: HTMLElement;
  private readonly times: Float64Array;
  private readonly curves: Curve[];
  private readonly stack: CurveStack;
  private readonly slider: HTMLInputElement;
  private readonly playButton: HTMLButtonElement;
  private readonly time = html("span", { class: "time" });
  private speed = 1;
  private loops = false;
  private playing = 0;
  private isSaving = false;
  private playback = { frame: 0, begun: 0 };

  /// `drawn` is the picture of the frame shown, once it is answered; null if nothing is drawn.
  constructor(
    private readonly recorded: RecordedMotion, private readonly go: (frame: Frame) => void,
    drawn: ((said: string) => Promise<Blob>) | null) {
    this.times = recorded.times;
    this.curves = recorded.curves.map((curve) => curveOf(curve, curve.values));
    this.stack = new CurveStack(recorded.axis, this.times, (frame) => this.show(frame));
    const last = this.times.length - 1;
    this.slider = html("input", { type: "range", min: 0, max: last, step: 1, value: 0, "aria-label": words.frame });
    this.slider.addEventListener("input", () => this.show(this.slider.valueAsNumber));
    this.playButton = button(words.play, () => this.toggle(), { class: "play" });
    const span = recorded.axis === "frame" ? words.recordedFrames(last + 1)
      : words.recordedOver(last + 1, plain(this.times[0]!, 3), plain(this.times[last]!, 3));
    const chosen = usualCurves(this.curves);
    const drawing = figure(this.stack.drawing(), html("p", { class: "small silent" }, [`${named(recorded.name)}: ${span}`, ...this.silent()].join("; ")));
    if (drawn) drawing.querySelector(".under .row")!.prepend(this.picturesButton(drawn));
    this.element = section(words.recorded,
      html("div", { class: "row no-print playing" }, this.playButton, this.slider, this.time,
        choice(words.speed, words.speeds, "1", (speed) => this.setSpeed(Number(speed))), checkbox(words.loop, false, (on) => (this.loops = on)),
        ...this.chooser(chosen)),
      drawing);
    this.stack.show(chosen);
    this.showTime(0);
  }

  /// The largest values of the curves shown first, and their times.
  extremes(): Extreme[] {
    return usualCurves(this.curves).flatMap((curve) => {
      const frame = extremeOf(curve), { title, values, unit } = curve;
      if (frame < 0) return [];
      return [this.figureAt(frame, isGap(curve) ? title : words.largest(title), valueText(values[frame]!, unit))];
    });
  }

  /// The answer of a joint with layers: the largest pressure, and area, force and what the regions carry of it then. Null without pressure.
  loaded(): Loaded | null {
    const of = (name: string) => this.curves.find((curve) => curve.name === name), pressure = of("max_pressure_mpa");
    if (pressure?.kind !== "changes") return null;
    const frame = extremeOf(pressure), at = (name: string) => of(name)?.values[frame] ?? Number.NaN;
    const force = this.curves.filter(({ name }) => /^force_in_(fixed|mobile)_[xyz]_n$/.test(name)).map(({ values }) => values[frame]!);
    const shares = this.curves.filter(({ name }) => name.endsWith("_share_percent")),
      regions = shares.map(({ title }) => title.replace(/ share$/, ""));
    const figures = [
      [words.peakPressure, valueText(pressure.values[frame]!, pressure.unit)], [words.areaThen, valueText(at("area_mm2"), "mm²")],
      [words.forceThen, valueText(Math.hypot(...force), "N")],
      ...(shares.length > 1 ? [[regions.join(" : "), shares.map(({ values }) => fixed(values[frame]!, 0)).join(" : ")]] : []),
    ].map(([name, value]) => this.figureAt(frame, name!, value!));
    return { frame, figures, sentence: words.loadSentence(figures, figures[0]!.at) };
  }

  private figureAt(frame: number, name: string, value: string): Extreme {
    return { name, value, at: this.timeText(frame), go: () => this.show(frame) };
  }

  /// The curves shown first, for paper.
  drawing(): Drawing {
    const stack = new CurveStack(this.recorded.axis, this.times, () => undefined);
    stack.show(usualCurves(this.curves));
    return stack.drawing();
  }

  show(frame: number): void {
    // Playback resumes from a frame that was chosen by hand.
    this.playback = { frame, begun: performance.now() };
    this.put(frame);
  }

  stop(): void {
    cancelAnimationFrame(this.playing);
  }

  toggle(): void {
    cancelAnimationFrame(this.playing);
    const starts = this.playing === 0;
    this.playing = 0;
    this.playButton.textContent = starts ? words.pause : words.play;
    if (!starts) return;
    this.playback = { frame: this.slider.valueAsNumber < this.times.length - 1 ? this.slider.valueAsNumber : 0, begun: performance.now() };
    const step = () => {
      const perSecond = this.speed * (this.recorded.axis === "frame" ? untimedFrames_per_s : 1);
      const time = this.times[this.playback.frame]! + (perSecond * (performance.now() - this.playback.begun)) / 1000;
      let { frame } = this.playback;
      while (frame + 1 < this.times.length && this.times[frame + 1]! <= time) ++frame;
      this.put(frame);
      if (frame + 1 === this.times.length && this.loops) this.playback = { frame: 0, begun: performance.now() };
      if (frame + 1 < this.times.length || this.loops) this.playing = requestAnimationFrame(step);
      else this.toggle();
    };
    this.playing = requestAnimationFrame(step);
  }

  private picturesButton(drawn: (said: string) => Promise<Blob>): HTMLElement {
    const made = button(words.saveFrames, () => void this.savePictures(made, drawn), { class: "quiet-button no-print" });
    return made;
  }

  /// Every frame as a picture, in one ZIP; nothing if the button is pressed again before the last.
  private async savePictures(made: HTMLButtonElement, drawn: (said: string) => Promise<Blob>): Promise<void> {
    if (this.isSaving) return void (this.isSaving = false);
    this.isSaving = true;
    const files: Record<string, Uint8Array> = {}, count = this.times.length;
    try {
      for (let frame = 0; frame < count && this.isSaving; ++frame) {
        made.textContent = words.stopFrames(frame + 1, count);
        this.show(frame);
        files[`frame_${String(frame).padStart(5, "0")}.png`] = new Uint8Array(await (await drawn(this.timeText(frame))).arrayBuffer());
      }
      // Pictures are compressed already, and the file has no date.
      if (this.isSaving) saveBlob("frames.zip", new Blob([zipSync(files, { level: 0, mtime: new Date(1980, 0, 1, 12) }) as BlobPart], { type: "application/zip" }));
    } finally {
      this.isSaving = false;
      made.textContent = words.saveFrames;
    }
  }

  private put(frame: number): void {
    this.slider.value = String(frame);
    this.stack.setFrame(frame);
    this.showTime(frame);
    const of = (numbers: Float64Array, each: number) => Array.from(numbers.subarray(each * frame, each * frame + each));
    this.go({ angles: of(this.recorded.angles, 3), translation: of(this.recorded.translations, 3), X_FM: of(this.recorded.poses, 16) });
  }

  private showTime(frame: number): void {
    this.time.textContent = this.timeText(frame);
    this.slider.setAttribute("aria-valuetext", this.timeText(frame));
  }

  private timeText(frame: number): string {
    return this.recorded.axis === "frame" ? words.frameNumber(plain(this.times[frame]!)) : words.seconds(this.times[frame]!.toFixed(2));
  }

  private setSpeed(speed: number): void {
    this.speed = speed;
    this.playback = { frame: this.slider.valueAsNumber, begun: performance.now() };
  }

  /// Which quantities are drawn, a few at once.
  private chooser(usual: readonly Curve[]): HTMLElement[] {
    let chosen = new Set(usual);
    const boxes = this.curves.filter(({ kind }) => kind === "changes").map((curve) => {
      const label = checkbox(curve.unit ? `${curve.title}, ${curve.unit}` : curve.title, chosen.has(curve), (on) => {
        if (on) chosen.add(curve);
        else chosen.delete(curve);
        // As many as can be read: the one chosen first is removed.
        if (chosen.size > shownAtOnce + 1) chosen = new Set([...chosen].slice(1));
        boxes.forEach(({ of, box }) => (box.checked = chosen.has(of)));
        this.stack.show(this.curves.filter((each) => chosen.has(each)));
      });
      return { of: curve, box: label.querySelector("input")!, label };
    });
    return [html("details", { class: "popup" }, html("summary", {}, words.quantities), html("div", {}, ...boxes.map(({ label }) => label)))];
  }

  /// Curves without information.
  private silent(): string[] {
    const line = (kind: CurveKind, said: (names: string) => string) => {
      const names = this.curves.filter((curve) => curve.kind === kind).map(({ title }) => title);
      return names.length ? [said(names.join(", "))] : [];
    };
    return [...line("zero", words.zeroCurves), ...line("empty", words.emptyCurves)];
  }
}
