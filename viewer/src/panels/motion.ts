import { scaleLinear } from "d3-scale";
import { button, html, named, section, shortened, spaced, svg } from "../dom";
import type { Coordinates, Depth, LiveLimit, Shown } from "../core/protocol";
import { toldBand } from "../plots/limits";
import type { MotionAnswer, ReportText } from "../report";
import { words } from "../words";

const stripWidth = 400, stripHeight = 18;
const usualRange_deg = 120, translationRange_mm = 20, farthest_deg = 180;
const axes = ["x", "y", "z"] as const;

interface Slider {
  name: string;
  input: HTMLInputElement;
  number: HTMLInputElement;
  strip: SVGSVGElement;
  told: HTMLElement;
  low: number;
  high: number;
  limits: { negative: LiveLimit | null; positive: LiveLimit | null };
}

/// Sliders of the joint's coordinates with the limits from where it is, and what the pose shows.
export class MotionPanel {
  readonly element: HTMLElement;
  private readonly sliders: Slider[];
  private readonly translations: HTMLInputElement[] = [];
  private readonly answer = html("p", { id: "answer", "aria-live": "polite" });
  private readonly depth = html("p", { id: "depth", "aria-live": "polite" });
  private readonly took = html("p", { class: "small no-print", "aria-hidden": "true" });
  private animation = 0;
  private toldAt = 0;
  private isWarm = false;

  /// `arrived` where a motion that was asked for has come to its end. `showStored` where the page cannot compute: the joint then
  /// takes the poses that the report holds, by their names, and none in between.
  constructor(
    private readonly report: ReportText, private readonly moved: (at: Coordinates) => void,
    private readonly arrived: (motion: MotionAnswer) => void, private readonly showStored: ((name: string) => void) | null) {
    const count = report.joint.kind === "hinge" ? 1 : 3;
    this.sliders = report.coordinates.slice(0, count).map((_, angle) => this.slider(angle));
    const rows = this.sliders.map(({ name, input, number, strip, told }) =>
      html("div", { class: "slider" }, html("label", { for: `angle-${name}` }, spaced(name)), number, input, strip, told));
    if (report.joint.kind === "free") rows.push(html("div", { class: "row" }, ...axes.map((axis) => this.translation(axis))));
    const manoeuvres = (report.rom?.motions ?? []).map((motion) =>
      button(shortened(spaced(motion.name)), () => this.goToEnd(motion), { class: "manoeuvre", disabled: !this.hasPose(motion.name) }));
    this.element = section(words.motion, ...rows, this.answer, this.depth, this.took,
      html("div", { class: "row no-print" },
        button(words.reset, () => (showStored ? showStored("reference") : this.goTo([...report.reference_deg])),
          { disabled: !this.hasPose("reference") }),
        ...(manoeuvres.length ? [html("span", {}, words.manoeuvres)] : []), ...manoeuvres));
  }

  get coordinates(): Coordinates {
    const angles: [number, number, number] = [0, 0, 0];
    this.sliders.forEach(({ number }, i) => (angles[i] = number.valueAsNumber || 0));
    const translation: [number, number, number] = [...this.report.reference_mm];
    this.translations.forEach((input, i) => (translation[i] = input.valueAsNumber || 0));
    return { angles, translation };
  }

  /// As said, at once.
  set(angles: readonly number[], translation?: readonly number[]): void {
    this.sliders.forEach((slider, i) => this.write(slider, angles[i]!));
    if (translation) this.translations.forEach((input, i) => (input.value = String(translation[i]!)));
    this.moved(this.coordinates);
  }

  /// To where a motion ends: the angle that varies to its last bit, the others as they were given.
  goToEnd(motion: MotionAnswer): void {
    if (this.showStored) return this.showStored(motion.name);
    const angles = this.report.coordinates.map(({ name }) =>
      (name === motion.vary ? motion.at_limit_deg : motion.start_deg)[name] ?? 0);
    this.goTo(angles, () => this.arrived(motion), motion.translation_mm ?? this.report.rom?.held_translation_mm);
  }

  /// The joint turns there, at once where its user asked for less motion.
  goTo(angles: readonly number[], there: () => void = () => undefined, given?: readonly number[] | null): void {
    cancelAnimationFrame(this.animation);
    const from = this.coordinates, translation = given ?? from.translation;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.set(angles, translation);
      there();
      return;
    }
    const begun = performance.now(), duration_ms = 450;
    const step = () => {
      const share = Math.min(1, (performance.now() - begun) / duration_ms);
      const eased = share * share * (3 - 2 * share);
      const between = (first: readonly number[], last: readonly number[]) =>
        share === 1 ? last : first.map((value, i) => value + eased * (last[i]! - value));
      this.set(between(from.angles, angles), between(from.translation, translation));
      if (share < 1) this.animation = requestAnimationFrame(step);
      else there();
    };
    step();
  }

  /// How far each angle is searched for its limits, back and forth.
  ranges(): [number, number][] {
    return this.sliders.map(() => [farthest_deg, farthest_deg]);
  }

  setLimit(at: Coordinates, limit: LiveLimit): void {
    const slider = this.sliders[limit.vary]!;
    slider.limits[limit.positive ? "positive" : "negative"] = limit;
    this.drawStrip(slider, at.angles[limit.vary]!);
  }

  /// Comes once the joint rests, as `condyle depth` answers.
  showDepth({ deepest, withoutDepth, area_mm2, volume_mm3, volumeError_mm3, coveredAgain_mm3 }: Depth): void {
    const bodies = { fixed: named(this.report.joint.fixed), mobile: named(this.report.joint.mobile) };
    const lines: string[] = [];
    if (deepest) {
      const along = deepest.about === null ? words.theRay
        : words.theArc(spaced(this.report.coordinates[deepest.about]!.name), deepest.depth_deg!);
      lines.push(words.depthAlong(deepest.depth_mm, along, deepest.vertex, bodies[deepest.body], deepest.nearest_mm));
    }
    if (withoutDepth > 0) lines.push(words.withoutDepth(withoutDepth));
    const areas = (["mobile", "fixed"] as const).flatMap((body) => {
      const area = area_mm2[body];
      return area ? [words.contactArea(area, bodies[body])] : [];
    });
    if (areas.length) lines.push(words.contactAreas(areas.join(", ")));
    if (volume_mm3 !== null) lines.push(words.penetrationVolume(volume_mm3, volumeError_mm3!));
    if (coveredAgain_mm3) lines.push(words.coveredAgain(coveredAgain_mm3));
    this.depth.textContent = lines.join("; ");
  }

  show(shown: Shown, roundTrip_ms: number): void {
    // That of another pose is nobody's.
    this.depth.textContent = "";
    const fixed = named(this.report.joint.fixed), mobile = named(this.report.joint.mobile);
    const inside = ([["mobile", mobile], ["fixed", fixed]] as const)
      .filter(([key]) => shown.inside[key].count > 0)
      .map(([key, name]) => words.inside(name, shown.inside[key]));
    const text = [
      shown.inContact ? words.inContact : words.notInContact, ...inside,
      ...(shown.pairs.length ? [words.pairsCount(shown.pairs.length / 2)] : []),
    ].join("; ");
    // A reader that speaks is not interrupted at every step of a slider.
    const now = performance.now();
    if (this.answer.textContent !== text || now - this.toldAt > 1000) {
      this.answer.textContent = text;
      this.toldAt = now;
    }
    this.answer.classList.toggle("contact", shown.inContact);
    // The first answer waits for tables that are made once.
    if (this.isWarm) this.took.textContent = words.stepTook(roundTrip_ms);
    this.isWarm = true;
  }

  private hasPose(name: string): boolean {
    return !this.showStored || this.report.poses.some((pose) => pose.name === name);
  }

  private slider(angle: number): Slider {
    const { name } = this.report.coordinates[angle]!;
    const [low, high] = this.rangeOf(angle);
    const input = html("input", {
      type: "range", id: `angle-${name}`, min: low, max: high, step: 0.1, value: 0, "aria-label": words.coordinate(spaced(name)),
      disabled: this.showStored !== null,
    });
    const number = html("input", { type: "number", min: -farthest_deg, max: farthest_deg, step: 0.1, value: 0,
      "aria-label": words.coordinate(spaced(name)), disabled: this.showStored !== null });
    const slider: Slider = {
      name, input, number, low, high, limits: { negative: null, positive: null },
      strip: svg("svg", { viewBox: `0 0 ${stripWidth} ${stripHeight}`, class: "strip", preserveAspectRatio: "none",
        "aria-hidden": "true" }),
      told: html("span", { class: "small told" }),
    };
    input.addEventListener("input", () => {
      cancelAnimationFrame(this.animation);
      number.value = input.value;
      this.moved(this.coordinates);
    });
    number.addEventListener("input", () => {
      input.value = number.value;
      this.moved(this.coordinates);
    });
    return slider;
  }

  private translation(axis: (typeof axes)[number]): HTMLLabelElement {
    const input = html("input", { type: "number", min: -translationRange_mm, max: translationRange_mm, step: 0.1,
      value: this.report.reference_mm[axes.indexOf(axis)]!, disabled: this.showStored !== null });
    input.addEventListener("input", () => this.moved(this.coordinates));
    this.translations.push(input);
    return html("label", {}, `${words.translation(axis)} `, input);
  }

  private write({ input, number }: Slider, angle: number): void {
    // A limit is quoted to its last bit; the slider shows what it can.
    number.value = String(angle);
    input.value = String(angle);
  }

  /// From where motions start to where they may end.
  private rangeOf(angle: number): [number, number] {
    const { name } = this.report.coordinates[angle]!;
    let [low, high] = [0, 0];
    for (const { vary, sense, range_deg, start_deg } of this.report.rom?.motions ?? []) {
      if (vary !== name) continue;
      const start = start_deg[name] ?? 0;
      if (sense === "positive") high = Math.max(high, start + range_deg);
      else low = Math.min(low, start - range_deg);
    }
    return [Math.max(-farthest_deg, low || -usualRange_deg), Math.min(farthest_deg, high || usualRange_deg)];
  }

  /// Free from here, and the bands of the motions that start at zero.
  private drawStrip(slider: Slider, at: number): void {
    const { negative, positive } = slider.limits;
    if (!negative || !positive) return;
    const x = scaleLinear([slider.low, slider.high], [0, stripWidth]).clamp(true);
    const low = at - negative.turned_deg, high = at + positive.turned_deg;
    const startsInContact = positive.reason === "contact_at_start";
    const marks: SVGElement[] = [svg("rect", { x: 0, y: 7, width: stripWidth, height: 4, class: "track" })];
    if (!startsInContact)
      marks.push(svg("rect", { x: x(low), y: 4, width: Math.max(1, x(high) - x(low)), height: 10, class: "free" }));
    for (const motion of this.report.rom?.motions ?? []) {
      if (motion.vary !== slider.name || Object.values(motion.start_deg).some((start) => start !== 0)) continue;
      const sign = motion.sense === "positive" ? 1 : -1;
      const band = toldBand(motion);
      if (band) {
        const ends = [sign * band.p5_deg, sign * band.p95_deg].sort((a, b) => a - b);
        marks.push(svg("rect", { x: x(ends[0]!), y: 0, width: Math.max(1, x(ends[1]!) - x(ends[0]!)), height: stripHeight,
          class: "band" }));
      }
      // Where the range ends nothing meets.
      if (motion.reason !== "end_of_range")
        marks.push(svg("rect", { x: x(sign * motion.limit_deg) - 1, y: 0, width: 2, height: stripHeight, class: "limit" }));
    }
    slider.strip.replaceChildren(...marks);
    const end = (deg: number, { reason }: LiveLimit) =>
      `${deg.toFixed(1)}° (${words.reasons[reason]})`;
    slider.told.textContent = startsInContact ? words.startsInContact
      : words.free(spaced(slider.name), end(low, negative), end(high, positive));
  }
}
