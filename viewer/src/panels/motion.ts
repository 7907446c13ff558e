import { button, html, named, namesOf, spaced, svg } from "../dom";
import type { Coordinates, Depth, Nearest, Screw, Shown, Standing } from "../core/protocol";
import { atMost, fixed, plain } from "../numbers";
import type { Interval, MotionAnswer, ReportText } from "../report";
import { hasLimits, heldOf, shownBand } from "../result";
import { prefersStill } from "../scene/camera_turn";
import { words } from "../words";
import { NumberField } from "./angle_field";
import { intervalAt, near_deg, nearestExit } from "./free_angles";
import { ManoeuvreGrid } from "./manoeuvres";
import { StatusChip, type Exit } from "./status";
import { nearestText, placeOf } from "./strip";
import { ligamentTable } from "./ligaments";

const usualRange_deg = 120, translationRange_mm = 20;
export const farthest_deg = 180;
/// The steps of one drag are one gesture, and those of one control within so long.
const gesture_ms = 800;
const axes = ["x", "y", "z"] as const;

/// From where to where the joint is shifted along an axis, by its place there in the reference pose.
export const shiftRange = (at_mm: number): [number, number] => [Math.min(0, at_mm) - translationRange_mm, Math.max(0, at_mm) + translationRange_mm];

interface Slider {
  name: string;
  input: HTMLInputElement;
  field: NumberField;
  track: SVGSVGElement;
  readout: HTMLElement;
  low: number;
  high: number;
  /// Free intervals at the pose shown; null until they are known.
  free: Interval[] | null;
}

export interface MotionHooks {
  moved: (at: Coordinates) => void;
  /// A gesture begins, which undo takes back.
  begins: () => void;
  undo: () => void;
  /// The joint is at the end of a motion: one that was requested, or the one that ends in this pose, wherever the pose came from.
  arrived: (motion: MotionAnswer, requested: boolean) => void;
  /// For a page that cannot compute: the joint takes the poses that the report holds, by their names, and none in between.
  showStored: ((name: string) => void) | null;
}

/// The pose, sliders of the joint's coordinates with their free intervals, and the end of each motion.
export class MotionPanel {
  readonly element: HTMLElement;
  /// The pose in full, among the details.
  readonly answer = html("p", { id: "answer" });
  readonly depth = html("p", { id: "depth" });
  readonly ligaments = html("div", { id: "ligaments" });
  readonly took = html("p", { class: "small no-print", "aria-hidden": "true" });
  private readonly status: StatusChip;
  private readonly sliders: Slider[];
  private readonly translations: NumberField[] = [];
  private grid: ManoeuvreGrid | null;
  private readonly undoButton: HTMLButtonElement;
  private readonly refusal = html("p", { id: "refusal", role: "status" });
  private readonly lastMovement = html("span", { id: "last-movement", class: "small" });
  private angles: [number, number, number];
  private translation: [number, number, number];
  private animation = 0;
  private remembered: { by: unknown; at: number } | null = null;
  private isWarm = false;
  private aboutLast = "";
  private shownLast: Coordinates | null = null;
  /// Where the joint's last movement came from; null until it has moved.
  before: Coordinates | null = null;
  private touches: boolean | null = null;  // null until it is known of this pose
  private standing: Standing | null = null;
  private hasLimits = true;  // without them the page knows only whether the bodies meet
  private nearest: Nearest[] | null = null;
  private lastDepth: Depth | null = null;
  /// Names of those at their end or past it.
  private ligamentsAtEnd: string[] = [];
  /// The motion at whose end the joint is.
  private end: MotionAnswer | null = null;

  constructor(private report: ReportText, private readonly hooks: MotionHooks) {
    const { showStored } = hooks;
    this.angles = [...report.reference_deg];
    this.translation = [...report.reference_mm];
    this.status = new StatusChip((exit) => this.leave(exit));
    const count = report.joint.kind === "hinge" ? 1 : 3;
    this.sliders = report.coordinates.slice(0, count).map((_, angle) => this.slider(angle));
    const rows = this.sliders.map(({ name, input, field, track, readout }) =>
      html("div", { class: "slider" }, html("label", { for: `angle-${name}` }, spaced(name)), readout, field.input,
        html("div", { class: "track-place" }, track, input)));
    if (report.joint.kind === "free") rows.push(html("div", { class: "row translations" }, ...axes.map((axis) => this.moveAlong(axis))));
    this.sliders.forEach((slider, i) => this.write(slider, this.angles[i]!));
    this.grid = this.gridOf(report);
    const held = heldOf(report);
    this.undoButton = button(words.undo, hooks.undo, { disabled: true, title: words.undoKey });
    this.element = html("section", { "aria-label": words.motion }, this.status.element, html("div", { class: "sliders" }, ...rows),
      html("div", { class: "row motion-row no-print" },
        button(words.reset, () => (showStored ? showStored("reference") : this.goTo([...report.reference_deg], () => undefined, report.reference_mm)),
          { disabled: !this.hasPose("reference") }), this.undoButton, this.lastMovement, this.refusal),
      ...(this.grid ? [...(held === null ? [] : [html("h3", {}, words.heldLimits(held))]), this.grid.element] : []));
  }

  /// The joint is another one now.
  setReport(report: ReportText): void {
    const grid = this.gridOf(report);
    if (grid) this.grid?.element.replaceWith(grid.element);
    this.report = report;
    this.grid = grid;
    this.end = null;
    this.drawStatus();
  }

  setUndo(can: boolean): void {
    this.undoButton.disabled = !can;
  }

  get coordinates(): Coordinates {
    return { angles: [...this.angles], translation: [...this.translation] };
  }

  /// The coordinates of an earlier step, or of a later one.
  step(angles: readonly number[], translation: readonly number[]): void {
    cancelAnimationFrame(this.animation);
    this.remembered = null;
    this.set(angles, translation);
  }

  /// Takes these coordinates at once, as a movement from `before` if that is not the pose shown.
  set(angles: readonly number[], translation?: readonly number[], before?: Coordinates): void {
    this.sliders.forEach((slider, i) => {
      this.angles[i] = angles[i]!;
      this.write(slider, angles[i]!);
    });
    if (translation) this.translation = [translation[0]!, translation[1]!, translation[2]!];
    this.translations.forEach((field, i) => field.show(this.translation[i]!));
    this.hasMoved(before);
  }

  /// Coordinates while a map's cross is dragged.
  drag(angles: readonly number[], translation: readonly number[]): void {
    cancelAnimationFrame(this.animation);
    this.remember(this.sliders);
    this.set(angles, translation);
  }

  /// Goes to the end of a motion: its varied angle to the last bit, the others as given.
  goToEnd(motion: MotionAnswer): void {
    if (this.hooks.showStored) return this.hooks.showStored(motion.name);
    const angles = this.report.coordinates.map(({ name }) =>
      (name === motion.vary ? motion.at_limit_deg : motion.start_deg)[name] ?? 0);
    this.goTo(angles, () => {
      this.markEnd(motion);
      this.hooks.arrived(motion, true);
    }, motion.translation_mm ?? this.report.rom?.held_translation_mm);
  }

  /// The joint turns there, at once if its user asked for less motion.
  goTo(angles: readonly number[], there: () => void = () => undefined, given?: readonly number[] | null): void {
    cancelAnimationFrame(this.animation);
    this.remember(null);
    const from = this.coordinates;  // the whole way is one movement
    const translation = given ?? from.translation;
    if (prefersStill()) {
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
      this.set(between(from.angles, angles), between(from.translation, translation), from);
      if (share < 1) this.animation = requestAnimationFrame(step);
      else there();
    };
    step();
  }

  /// The motion at whose end the joint is; null for none.
  markEnd(motion: MotionAnswer | null): void {
    this.end = motion;
    this.grid?.mark(motion);
    this.drawStatus();
  }

  /// Null: the core does not know it.
  setStanding(at: Coordinates, standing: Standing | null): void {
    if (!this.isHere(at)) return;
    this.hasLimits = standing !== null;
    this.standing = standing;
    this.drawStatus();
  }

  setFree(vary: number, at: Coordinates, intervals: Interval[]): void {
    if (!this.isHere(at)) return;
    const slider = this.sliders[vary]!;
    slider.free = intervals;
    this.drawTrack(slider, at.angles[vary]!);
    this.drawStatus();
  }

  /// Answers about another pose are dropped.
  private isHere({ angles, translation }: Coordinates): boolean {
    return angles.every((deg, i) => deg === this.angles[i]) && translation.every((mm, i) => mm === this.translation[i]);
  }

  setNearest(at: Coordinates, nearest: Nearest[]): void {
    if (this.touches || at.angles.some((deg, i) => deg !== this.angles[i])) return;
    this.nearest = nearest;
    this.drawStatus();
  }

  /// Comes once the joint is idle: the answer of `condyle depth`.
  showDepth(depth: Depth): void {
    const { deepest, withoutDepth, area_mm2, volume_mm3, volumeError_mm3, coveredAgain_mm3 } = depth;
    const bodies = namesOf(this.report.joint);
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
    if (volume_mm3 !== null) lines.push(words.penetrationVolume(volume_mm3, atMost(volumeError_mm3!)));
    if (coveredAgain_mm3) lines.push(words.coveredAgain(coveredAgain_mm3));
    this.depth.textContent = lines.join("; ");
    this.lastDepth = depth;
    this.drawStatus();
  }

  /// Comes once the joint is idle: how far it must turn about the axis of its last movement to be free.
  showScrew(at: Coordinates, { slides, axis, depth_deg, depth_mm }: Screw): void {
    if (!this.isHere(at)) return;
    const frees = depth_deg ? words.aboutLast(fixed(depth_deg, 1), fixed(depth_mm!, 1)) : "";
    this.aboutLast = slides ? words.lastSlides : axis && depth_deg === null ? words.lastFreesNever : frees;
    this.drawStatus();
  }

  show(shown: Shown, roundTrip_ms: number): void {
    // The depth of another pose is dropped.
    this.depth.textContent = this.aboutLast = "";
    this.lastDepth = null;
    this.touches = shown.inContact;
    this.ligamentsAtEnd = shown.ligaments.flatMap(({ name, is }) => (is === "at_end" ? [named(name)] : []));
    this.ligaments.replaceChildren(...(shown.ligaments.length ? [ligamentTable(shown.ligaments)] : []));
    this.forgetLimits();
    const names = namesOf(this.report.joint);
    const inside = (["mobile", "fixed"] as const).filter((body) => shown.inside[body] > 0).map((body) => words.inside(names[body], shown.inside[body]));
    this.answer.textContent = [
      shown.inContact ? words.inContact : words.notInContact, ...inside,
      ...(shown.pairs.length ? [words.pairsCount(shown.pairs.length / 2)] : []),
    ].join("; ");
    this.answer.classList.toggle("contact", shown.inContact);
    // The first answer waits for tables that are made once.
    if (this.isWarm) this.took.textContent = words.stepTook(roundTrip_ms);
    this.isWarm = true;
    this.drawStatus();
  }

  private hasMoved(before = this.shownLast): void {
    if (!this.shownLast || !this.isHere(this.shownLast)) [this.before, this.shownLast] = [before, this.coordinates];
    this.end = null;
    this.touches = null;
    this.refuse(null);
    this.nearest = null;
    this.forgetLimits();
    this.grid?.mark(null);
    this.hooks.moved(this.coordinates);
  }

  private forgetLimits(): void {
    this.standing = null;
    for (const slider of this.sliders) slider.free = null;
  }

  /// Null until it is known.
  private stateHere(): Pick<Standing, "is"> & Partial<Standing> | null {
    return this.standing ?? (this.touches === null || this.hasLimits ? null : { is: this.touches ? "contact" : "free" });
  }

  private drawStatus(): void {
    const state = this.stateHere();
    this.lastMovement.textContent = state?.is === "impinging" || state?.is === "contact" ? this.aboutLast : "";
    if (state) this.findEnd(state.is);
    if (this.end?.reason === "contact") return this.status.say("limit", words.atLimit(placeOf(this.end, this.report)));
    if (this.end?.reason === "ligament") return this.status.say("limit", words.atLigament(named(this.end.ligament!)));
    // Until the state is known, what was said stays, unless nothing meets and no motion ends here.
    if (!state && !this.hooks.showStored && (this.touches !== false || this.motionHere())) return;
    if (!state || state.is === "free") return this.status.say("free", this.nearest ? words.freeClear(nearestText(this.nearest, this.report)) : words.isFree);
    if (state.is === "bearing") return this.status.say("bearing", words.bearingEndsNone);
    if (state.is === "at_limit" && state.byLigament) return this.status.say("limit", words.atLigament(this.ligamentsAtEnd.join(", ")));
    if (state.is === "at_limit") {
      const { name, opposite } = this.report.coordinates[state.vary!]!, names = namesOf(this.report.joint);
      return this.status.say("limit", words.atLimit(words.meshOn(names.mobile, names.fixed), spaced(state.isHigh ? name : opposite)));
    }
    if (state.is === "strained") this.status.say("contact", words.pastLigament(this.ligamentsAtEnd.join(", ")));
    else this.status.inContact(state.is === "impinging" ? words.impinging : words.inContact, this.lastDepth);
    this.drawExit();
  }

  /// The motion that ends here, if the joint as it is ends there too: a part or a bone may have changed since the report.
  private findEnd(state: Standing["is"]): void {
    const here = this.motionHere(), isSharp = (here?.reason === "contact" || here?.reason === "ligament") && this.report.rom?.exact !== false;
    const end = (isSharp ? state === "at_limit" : !["impinging", "strained", "contact"].includes(state)) ? here : null;
    if (end === this.end) return;
    this.grid?.mark(this.end = end);
    if (end) this.hooks.arrived(end, false);
  }

  /// A motion of the report whose end this pose is.
  private motionHere(): MotionAnswer | null {
    const { rom, coordinates } = this.report;
    const isHere = (motion: MotionAnswer) => motion.reason !== "contact_at_start" && this.startsHere(motion) &&
      Math.abs(this.angles[coordinates.findIndex(({ name }) => name === motion.vary)]! - motion.at_limit_deg[motion.vary]!) <= near_deg &&
      (motion.translation_mm ?? rom?.held_translation_mm ?? this.translation).every((mm, i) => Math.abs(mm - this.translation[i]!) < 1e-9);
    return this.end && isHere(this.end) ? this.end : (rom?.motions.find(isHere) ?? null);
  }

  /// The smallest rotation of one angle that leaves contact, once the intervals of all angles are known.
  private drawExit(): void {
    if (this.sliders.some(({ free }) => free === null)) return;
    const exits = this.sliders.flatMap(({ free }, vary): Exit[] => {
      const exit = nearestExit(free!, this.angles[vary]!);
      return exit ? [{ vary, ...exit }] : [];
    });
    const exit = exits.reduce<Exit | null>((least, each) => (least && Math.abs(least.turn_deg) <= Math.abs(each.turn_deg) ? least : each), null);
    if (!exit) return this.status.setExit(null, "");
    const { name, opposite } = this.report.coordinates[exit.vary]!, turn = Math.abs(exit.turn_deg);
    this.status.setExit(exit, words.freeAfter(plain(turn, turn < 10 ? 1 : 0), spaced(exit.turn_deg < 0 ? opposite : name)));
  }

  private leave({ vary, to_deg }: Exit): void {
    const angles = [...this.angles];
    angles[vary] = to_deg;
    this.goTo(angles);
  }

  /// The pose before a gesture is remembered, once; null: by a press. A page that is busy gets late what was pressed in time.
  private remember(by: unknown): void {
    const at = window.event?.timeStamp ?? performance.now(), last = this.remembered, isNew = !last || by === null || by !== last.by || at - last.at > gesture_ms;
    this.remembered = { by, at };
    if (isNew) this.hooks.begins();
  }

  private gridOf(report: ReportText): ManoeuvreGrid | null {
    const { rom } = report;
    return rom && hasLimits(report)
      ? new ManoeuvreGrid(report, rom, (motion) => this.goToEnd(motion), ({ name }) => this.hasPose(name)) : null;
  }

  /// Whether the joint can go to a pose of the report: always, if the page computes.
  hasPose(name: string): boolean {
    return !this.hooks.showStored || this.report.poses.some((pose) => pose.name === name);
  }

  private slider(angle: number): Slider {
    const { name } = this.report.coordinates[angle]!;
    const [low, high] = this.rangeOf(angle);
    const label = words.coordinate(spaced(name)), disabled = this.hooks.showStored !== null;
    const input = html("input", { type: "range", id: `angle-${name}`, min: low, max: high, step: 0.1, value: 0, "aria-label": label, disabled });
    const taken = (value: number) => {
      cancelAnimationFrame(this.animation);
      this.remember(input);
      this.angles[angle] = value;
    };
    const field = new NumberField(label, -farthest_deg, farthest_deg, 0.1, "°", disabled, (value) => {
      taken(value);
      input.value = String(value);
      this.hasMoved();
    }, (why) => this.refuse(why));
    input.addEventListener("input", () => {
      taken(input.valueAsNumber);
      field.show(input.valueAsNumber);
      this.hasMoved();
    });
    return {
      name, input, field, low, high, free: null,
      track: svg("svg", { viewBox: "0 0 100 10", class: "track-strip", preserveAspectRatio: "none", "aria-hidden": "true" }),
      readout: html("span", { class: "small slider-readout" }),
    };
  }

  private moveAlong(axis: (typeof axes)[number]): HTMLLabelElement {
    const i = axes.indexOf(axis);
    const field = new NumberField(words.translation(axis), ...shiftRange(this.report.reference_mm[i]!), 0.1, " mm", this.hooks.showStored !== null, (value) => {
        this.remember(axis);
        this.translation[i] = value;
        this.hasMoved();
      }, (why) => this.refuse(why));
    field.show(this.report.reference_mm[i]!);
    this.translations.push(field);
    return html("label", {}, `${words.translation(axis)} `, field.input);
  }

  private refuse(why: string | null): void {
    this.refusal.textContent = why ?? "";
  }

  private write({ input, field }: Slider, angle: number): void {
    // A limit is kept to its last bit; slider and field show what they can.
    field.show(angle);
    input.value = String(angle);
    input.setAttribute("aria-valuetext", `${fixed(angle, 1)}°`);
  }

  /// The interval from where motions start to where they may end.
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

  /// The free intervals of this angle, the others as they are; and the band of a motion that starts from here.
  private drawTrack(slider: Slider, at: number): void {
    const { low, high, free } = slider;
    if (!free) return;
    const x = (deg: number) => (100 * (Math.min(high, Math.max(low, deg)) - low)) / (high - low);
    const bar = (from: number, to: number, kind: string, y: number, height: number) =>
      svg("rect", { x: x(from), y, width: Math.max(0.3, x(to) - x(from)), height, class: kind });
    const marks = [bar(low, high, "blocked", 3, 4)];
    for (const [from, to] of free) if (to >= low && from <= high) marks.push(bar(from, to, "free", 2, 6));
    for (const motion of this.report.rom?.motions ?? []) {
      const band = shownBand(motion);
      if (!band || motion.vary !== slider.name || !this.startsHere(motion)) continue;
      const start = motion.start_deg[slider.name] ?? 0, sign = motion.sense === "positive" ? 1 : -1;
      const ends = [start + sign * band.p5_deg, start + sign * band.p95_deg].sort((a, b) => a - b) as [number, number];
      marks.push(bar(...ends, "band", 0, 10));
    }
    slider.track.replaceChildren(...marks);
    const here = intervalAt(free, at), exit = here ? null : nearestExit(free, at);
    slider.readout.textContent = here ? words.free(`${fixed(here[0], 1)}°`, `${fixed(here[1], 1)}°`)
      : exit ? words.freeOnlyFrom(`${fixed(exit.to_deg, 1)}°`) : words.nowhereFree;
  }

  /// Whether a motion's other angles are those of the pose.
  private startsHere({ vary, start_deg }: MotionAnswer): boolean {
    return this.report.coordinates.every(({ name }, i) => name === vary || Math.abs((start_deg[name] ?? 0) - this.angles[i]!) < 1e-9);
  }
}
