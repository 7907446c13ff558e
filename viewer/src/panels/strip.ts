import { button, html, markCurrent, named, namesOf, shortened, spaced } from "../dom";
import { clockTime, fixed } from "../numbers";
import { fromBefore, isPlanned } from "../planned";
import type { Nearest } from "../core/protocol";
import type { MotionAnswer, ReportText, RomAnswer } from "../report";
import { bandText, comparedText, deficitOf, firstFigures, gradeOf, hasLimits, headlineMotion, heldOf, limitAlone, notesBeside, worstOf, wrongOf, zeroOf } from "../result";
import type { BodyName } from "../scene/body_names";
import { motionName, words } from "../words";

/// A figure of the strip that is not a limit: the largest value of a curve.
export interface Extreme {
  name: string;
  value: string;
  at: string;
  go: () => void;
}

/// In head radii from the joint centre: a rim lies 1.1 to 1.4 from it, a trochanter farther.
const farthestRim = 1.6;

/// Whether a point of F is at the rim of a hip, which has an hour.
function isAtRim(point: readonly number[] | null, { rom }: ReportText): boolean {
  const head = rom?.bearing?.head;
  return Boolean(rom?.clock_plane) && point !== null && (!head || Math.hypot(...point) <= farthestRim * head.radius_mm);
}

/// "0.4 mm, head to socket · 12.3 mm, neck to rim": what is how far from what.
export function nearestText(nearest: readonly Nearest[], text: ReportText): string {
  const partOf = (body: BodyName, triangle: number) => (text.parts[body].length > 1
    ? text.parts[body].find(({ first_triangle, triangles }) => triangle < first_triangle + triangles)?.name : undefined);
  const isHip = text.joint.anatomy === "hip", names = namesOf(text.joint);
  const said = nearest.map(({ distance_mm, triangle, isBearing, point }) => {
    const mobile = partOf("mobile", triangle.mobile), fixedPart = partOf("fixed", triangle.fixed);
    return words.nearest(fixed(distance_mm, 1), mobile || fixedPart || !isHip ? words.meshTo(mobile ? spaced(named(mobile)) : names.mobile, fixedPart ? spaced(named(fixedPart)) : names.fixed)
      : isBearing ? words.headToSocket : isAtRim(point, text) ? words.neckToRim : words.meshTo(names.mobile, names.fixed));
  });
  // Where all contact ends motions, both are one.
  return [...new Set(said)].join(" · ");
}

/// The contact at the end of a motion and its hour, if known.
export function placeOf(motion: MotionAnswer, text: ReportText): string {
  if (motion.reason === "ligament") return words.ligamentEnds(named(motion.ligament!));
  if (motion.reason !== "contact") return "";
  const { features, clock_hour, contact_side, contact_point_mm } = motion, { joint, rom } = text, isRim = clock_hour !== null || isAtRim(contact_point_mm, text);
  const fixedPart = features?.fixed.part, mobilePart = features?.mobile.part, isHip = joint.anatomy === "hip";
  const meets = !fixedPart && !mobilePart && isHip && isRim ? words.neckOnRim
    : words.meshOn(spaced(named(mobilePart ?? joint.mobile)), spaced(named(fixedPart ?? joint.fixed)));
  if (clock_hour !== null) return words.atHour(meets, clockTime(clock_hour));
  return [meets, contact_side, isHip && rom?.bearing?.head && !isRim ? words.awayFromRim : null].filter(Boolean).join(", ");
}

/// "1:08, neck on rim"
export function pinOf(motion: MotionAnswer, text: ReportText): string {
  const place = placeOf(motion, text);
  return motion.clock_hour === null ? place : `${clockTime(motion.clock_hour)}, ${place.replace(` at ${clockTime(motion.clock_hour)}`, "")}`;
}

/// One sentence about a motion: where it ends, its band, how much it lacks, and where contact is, and whether it is of a planned joint; or
/// what is wrong, if the joint is set up wrongly.
export function sentenceOf(motion: MotionAnswer, report: ReportText): string {
  const sentence = sentenceOnEnd(motion, report), wrong = wrongOf(report.rom);
  if (wrong !== null) return words.wrongSentence(shortened(wrong, 300));
  return isPlanned(report) ? words.plannedSentence(sentence) : sentence;
}

function sentenceOnEnd(motion: MotionAnswer, report: ReportText): string {
  const name = capital(named(motionName(motion.name)));
  if (motion.reason === "contact_at_start") return words.startsInContactSentence(name);
  if (motion.reason === "strained_at_start") return words.startsStrainedSentence(name, named(motion.ligament!));
  if (motion.translation_ends) return words.translationSentence(name, limitAlone(motion));
  if (motion.reason === "end_of_range") return words.freeSentence(name, fixed(motion.limit_deg, 0), namesOf(report.joint));
  const limit = [fromBefore(report, motion), bandText(motion)].filter(Boolean).join(" "), held = heldOf(report);
  return words.endsSentence(name, limit, held, placeOf(motion, report), livingOf(motion), compared(motion, report.rom!));
}

/// How much earlier a living hip with this bone is expected to end.
function livingOf({ living, limit_deg }: MotionAnswer): string {
  return living?.expected_deg == null ? "" : words.livingEarlier(fixed(limit_deg - living.expected_deg, 0));
}

/// What a limit is short of, or that no limit of the joint is short. Soft tissue ends motions that bone leaves free: no limit is beyond a
/// clinical range.
function compared(motion: MotionAnswer, rom: RomAnswer): string {
  const { normal_range_deg: clinical, bone_reference: bone, limit_deg } = motion, lacks = deficitOf(motion);
  if (rom.zero?.is_neutral === false) return words.notFromNeutral(zeroOf(rom)!);
  if (bone && (lacks !== null || limit_deg < bone.healthy_deg)) return words.boneEnds(bone, lacks !== null);
  if (lacks !== null) return words.lacks(fixed(lacks, 0), fixed(clinical!, 0));
  if (!worstOf(rom.motions) && rom.motions.some((each) => each.normal_range_deg !== null))
    return words.noneShort(rom.motions.find((each) => each.limit_deg >= (each.bone_reference?.healthy_deg ?? Infinity))?.bone_reference);
  return clinical === null ? words.noClinical : words.clinicalIs(fixed(clinical, 0));
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/// The answer first: four figures, a sentence, and the notes from the checks. It stays in place, whatever is pressed.
export class ResultStrip {
  readonly element: HTMLElement;
  private readonly sentence = html("p", { id: "sentence", "aria-live": "polite" });
  private readonly cards = new Map<string, HTMLButtonElement>();

  constructor(
    private readonly report: ReportText, go: (motion: MotionAnswer) => void, canGo: (motion: MotionAnswer) => boolean, extremes: readonly Extreme[],
    showNotes: () => void, ofLoad: string | null) {
    const { rom } = report, isLimited = ofLoad === null && hasLimits(report), cards = rom && isLimited
      ? firstFigures(report).map((motion) => {
        const lacks = deficitOf(motion) !== null;
        const made = card(motionName(motion.name), fromBefore(report, motion), bandText(motion), comparedText(motion, rom, zeroOf(rom)), () => go(motion), !canGo(motion));
        made.classList.toggle("short", lacks);
        this.cards.set(motion.name, made);
        return made;
      })
      : extremes.map(({ name, value, at, go: show }) => card(name, value, "", at, show, false));
    const headline = isLimited ? headlineMotion(report) : null;
    this.sentence.classList.toggle("wrong", headline !== null && wrongOf(rom) !== null);
    this.say(ofLoad ??
      (headline ? sentenceOf(headline, report) : rom ? words.noLimitsInContact : words.noLimitsSentence(report.rom_error ?? "")));
    const notes = notesBeside(rom);
    this.element = html("section", { id: "strip", "aria-label": words.result },
      ...(cards.length ? [html("div", { id: "results" }, ...cards)] : []),
      html("div", { id: "said" }, this.sentence, ...(report.note ? [html("p", { id: "note", class: "quiet" }, shortened(report.note, 500))] : [])),
      ...(notes.length ? [this.noted(notes, showNotes)] : []));
  }

  /// Shows the sentence of the motion at whose end the joint is.
  describe(motion: MotionAnswer): void {
    this.say(sentenceOf(motion, this.report));
    markCurrent(this.cards, motion.name);
  }

  private say(sentence: string): void {
    this.sentence.textContent = sentence;
  }

  /// The sentence stays; no figure is marked once the joint leaves the end of a motion.
  unmark(): void {
    markCurrent(this.cards, null);
  }

  private noted(notes: readonly { code: string; text: string }[], showNotes: () => void): HTMLElement {
    const findings = notes.filter((note) => gradeOf(note) !== "remark"), remarks = notes.length - findings.length;
    return html("div", { id: "noted", ...(findings.length ? { class: "warning" } : {}) }, html("span", { class: "noted-text" },
      ...(findings.length ? [html("b", {}, words.noted(findings.length)), " ", findings.map(({ text }) => text).join("; "), remarks ? " · " : ""] : []),
      ...(remarks ? [html("span", { class: findings.length ? "" : "quiet" }, words.remarks(remarks))] : [])),
      button(words.readNotes, showNotes, { class: "quiet-button" }));
  }
}

function card(name: string, value: string, band: string, normal: string, go: () => void, disabled: boolean): HTMLButtonElement {
  const made = button("", go, { class: "result", disabled });
  made.append(html("span", { class: "result-name" }, shortened(named(name), 48)), " ",
    html("span", { class: "result-value" }, html("b", {}, value), " ", html("span", { class: "quiet" }, band)), " ",
    html("span", { class: "result-normal" }, normal));
  return made;
}
