import { named } from "./dom";
import { fixed, plain, signed } from "./numbers";
import type { Band, LimitDifference, MotionAnswer, ReportText, RomAnswer } from "./report";
import { noteGrades } from "./records";
import { motionName, words } from "./words";

/// What a note of the checks means for the numbers: docs/checks.md.
export function gradeOf({ code }: { code: string }): "wrong" | "finding" | "remark" {
  return noteGrades[code] ?? "finding";
}

/// The note by which no number of the joint is to be believed; null if there is none.
export function wrongOf(rom: RomAnswer | null): string | null {
  return rom?.notes.find((note) => gradeOf(note) === "wrong")?.text ?? null;
}

/// The notes beside the sentence, which has that of wrongOf().
export function notesBeside(rom: RomAnswer | null): RomAnswer["notes"] {
  const said = wrongOf(rom);
  return (rom?.notes ?? []).filter(({ text }) => text !== said);
}

/// What zero is if it is the pose of the scan, or not known to be neutral; null for another one.
export function zeroOf({ zero }: RomAnswer): string | null {
  return zero?.from === "as_given" ? words.zeroOfScan : zero?.is_neutral === false ? words.zeroUnknown : null;
}

/// Whether a motion cannot begin, so that it has no limit.
export function cannotBegin(reason: MotionAnswer["reason"]): boolean {
  return reason === "contact_at_start" || reason === "strained_at_start";
}

/// Whether contact or a ligament ends a motion within its range.
function endsWithin(reason: MotionAnswer["reason"]): boolean {
  return reason === "contact" || reason === "ligament";
}

/// Whether a joint has limits; one that was changed by hand, those of the report.
export function hasLimits({ rom, by_hand }: ReportText): boolean {
  return (by_hand?.before ?? rom?.motions ?? []).some(({ reason }) => !cannotBegin(reason));
}

/// Where the translation of a free joint is held while it turns; null of a joint that is not held.
export function heldOf({ rom, reference_mm }: ReportText): string | null {
  const held = rom?.held_translation_mm;
  return held ? words.held(fixed(Math.hypot(...held.map((mm, i) => mm - reference_mm[i]!)), 1)) : null;
}

/// "arc 161.0° with extension", from contact to contact: comparable wherever zero is.
function arcText({ vary, sense, start_deg, limit_deg, reason }: MotionAnswer, motions: readonly MotionAnswer[], isNarrow: boolean): string {
  const isSame = (start: Record<string, number>) => Object.entries(start_deg).every(([name, deg]) => start[name] === deg);
  const opposite = motions.find((each) => each.vary === vary && each.sense !== sense && isSame(each.start_deg));
  if (opposite?.reason !== "contact" || reason !== "contact") return "";
  const arc = words.arc(fixed(limit_deg + opposite.limit_deg, 1));
  return isNarrow ? arc : words.arcWith(arc, named(motionName(opposite.name.replace(/_at_.*/, ""))));
}

/// How much a motion lacks of its range in bone or in the clinic, or that range, or what is known of living hips; and the total arc by `zero`, which is zeroOf(). One of them only if `isNarrow`.
export function comparedText(motion: MotionAnswer, { motions, normal_range_source }: RomAnswer, zero: string | null, isNarrow = false): string {
  const lacks = deficitOf(motion), { normal_range_deg: clinical, bone_reference: bone, living } = motion;
  const range = bone ? String(bone.healthy_deg) : clinical === null ? null : clinical.toFixed(0);
  const isOfLiving = living && living.text !== "-" && (living.expected_deg !== null || living.people?.source !== normal_range_source);
  return [
    ...(lacks !== null ? [words.short(lacks.toFixed(0), range!)] : bone ? [words.healthyIs(range!)] : isOfLiving ? [words.livingIs(living.text)] :
      range === null ? [] : [words.clinicalIs(range)]),
    ...(zero && !(isNarrow && range !== null) ? [arcText(motion, motions, isNarrow || range !== null)] : []),
  ].filter(Boolean).join(" · ");
}

/// The headline of a joint's limits, and the rule that chooses it: docs/report.md, "The answer first".

/// By name, what is examined first of a hip.
const examinedFirst = ({ anatomy, kind }: ReportText["joint"]) =>
  (anatomy === "hip" && kind !== "hinge" ? ["flexion", "internal_rotation_at_90_flexion", "fadir"] : []);
const shownFirst = 4;

/// By how much a motion ends before its clinical range, or before bone of healthy hips if it is as short as with a cam, in degrees; null if it
/// is not short, or is compared with neither.
export function deficitOf({ reason, limit_deg, normal_range_deg, bone_reference, translation_ends }: MotionAnswer): number | null {
  const compared = bone_reference?.is_short ? bone_reference.healthy_deg : normal_range_deg;
  if (compared === null || reason === "end_of_range" || translation_ends) return null;
  const lacks = compared - (cannotBegin(reason) ? 0 : limit_deg);
  return lacks > 0 ? lacks : null;
}

/// The motion that lacks most; null if none lacks anything.
export function worstOf(motions: readonly MotionAnswer[]): MotionAnswer | null {
  return motions.reduce<MotionAnswer | null>(
    (worst, motion) => ((deficitOf(motion) ?? 0) > (worst ? deficitOf(worst)! : 0) ? motion : worst), null);
}

/// The motion that lacks most, or, if none lacks anything, the one nearest to its clinical range; null if none has one.
function nearestToNormal(motions: readonly MotionAnswer[]): MotionAnswer | null {
  const beyond = ({ limit_deg, normal_range_deg }: MotionAnswer) => limit_deg - normal_range_deg!;
  const compared = motions.filter(({ normal_range_deg, reason }) => normal_range_deg !== null && endsWithin(reason));
  return worstOf(motions) ?? compared.reduce<MotionAnswer | null>(
    (nearest, motion) => (nearest && beyond(nearest) <= beyond(motion) ? nearest : motion), null);
}

/// The four of the strip: those of a hip examination, or else the first ones; and among the others the one that lacks most of its
/// clinical range, or is nearest to it, or else the next one.
export function firstFigures({ rom, joint }: ReportText): MotionAnswer[] {
  const motions = rom?.motions ?? [], named = examinedFirst(joint).flatMap((name) => motions.find((motion) => motion.name === name) ?? []);
  const shown = [...named, ...motions.filter((motion) => !named.includes(motion))].slice(0, shownFirst - 1);
  const others = motions.filter((motion) => !shown.includes(motion));
  const last = nearestToNormal(others) ?? others[0];
  return last ? [...shown, last] : shown;
}

/// The motion of the sentence: the one that lacks most; if none does, internal rotation at 90° flexion for a hip, and for other joints
/// the first of the strip that contact or a ligament ends. Null for a joint without limits.
export function headlineMotion(text: ReportText): MotionAnswer | null {
  const motions = text.rom?.motions ?? [], figures = firstFigures(text), ends = ({ reason }: MotionAnswer) => endsWithin(reason);
  const rotation = figures.find(({ name }) => name === examinedFirst(text.joint)[1]);
  return worstOf(motions) ?? (rotation && ends(rotation) ? rotation : figures.find(ends) ?? motions[0] ?? null);
}

/// The band if it is informative: a motion that nothing ends in its range ends in few varied joints either.
export function shownBand({ band, reason }: MotionAnswer): Band | null {
  return band && (endsWithin(reason) || !band.text.startsWith(">")) ? band : null;
}

/// "134.8°", ">120°" if the range ends without contact.
export function endText({ limit_deg, reason }: { limit_deg: number; reason: MotionAnswer["reason"] }): string {
  if (cannotBegin(reason)) return words.reasons[reason];
  return reason === "end_of_range" ? words.over(`${plain(limit_deg)}°`) : `${fixed(limit_deg, 1)}°`;
}

/// Without its band. If the record or load that a translation follows ends, the motion is known to there, not free beyond.
export function limitAlone(motion: MotionAnswer): string {
  if (motion.translation_ends) return motion.translation_mm ? `${fixed(motion.limit_deg, 1)}°` : "–";
  return endText(motion);
}

export function bandText(motion: MotionAnswer): string {
  const band = shownBand(motion);
  return band ? words.bandOf(band.text) : "";
}

export function limitText(motion: MotionAnswer): string {
  return [limitAlone(motion), bandText(motion)].filter(Boolean).join(" ");
}

/// "+12.3°", ">+12.3°" if the range ends without contact after, "<−12.3°" before.
export function differenceText({ difference_deg, difference_is }: LimitDifference): string {
  if (difference_deg === null) return "–";
  const bound = { exact: "", at_least: ">", at_most: "<" }[difference_is ?? "exact"];
  return `${bound}${signed(difference_deg, 1)}°`;
}
