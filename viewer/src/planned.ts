import type { LiveLimit } from "./core/protocol";
import { named, spaced } from "./dom";
import { filesOf } from "./panels/numbers";
import type { MotionAnswer, ReportText } from "./report";
import { endText, limitAlone } from "./result";
import { words } from "./words";

/// By what the joint of the page is another one than was measured, or to which it is compared, in a line; null for a joint as it is.
export function ribbonOf(text: ReportText): string | null {
  const { planned } = text.joint, compared = comparedFiles(text);
  const said = [
    ...(text.by_hand ? [text.by_hand.done] : planned ? [words.planned(spaced(named(planned)).replaceAll("mm3", "mm³"))] : []),
    ...(compared ? [words.comparedTo(compared.before)] : []),
  ];
  return said.length ? said.join(" · ") : null;
}

/// Whether limits are those of a plan, of parts that were set, or after a change by hand.
export function isPlanned({ joint, by_hand }: ReportText): boolean {
  return Boolean(joint.planned ?? by_hand);
}

/// The report of a joint that was changed by hand. Limits that the change leaves are kept, with their bands; until any are known, all are those before.
export function changedByHand(text: ReportText, done: string, limits: readonly { motion: MotionAnswer; limit: LiveLimit }[] | null): ReportText {
  const now = (motion: MotionAnswer): MotionAnswer => {
    const live = limits?.find((each) => each.motion === motion)?.limit;
    if (!live || (live.turned_deg === motion.limit_deg && live.reason === motion.reason)) return motion;
    const bone = motion.bone_reference, is_short = live.reason !== "end_of_range" && live.turned_deg <= (bone?.cam_without_complaints_deg ?? 0);
    const start = motion.start_deg[motion.vary] ?? 0, end = start + (live.positive ? 1 : -1) * live.turned_deg;
    return {
      ...motion, limit_deg: live.turned_deg, reason: live.reason, ligament: live.ligament, contact_kind: live.kind, contact_point_mm: live.point, band: null, features: null,
      clock_hour: null, contact_side: null, bearing_contact_deg: live.bearing_deg, at_limit_deg: { ...motion.at_limit_deg, [motion.vary]: end },
      bone_reference: bone && { ...bone, is_short },
      living: undefined,  // of the joint before
    };
  };
  return {
    ...text, rom: text.rom && { ...text.rom, motions: text.rom.motions.map(now) },
    by_hand: { done, before: text.rom?.motions ?? [] },
  };
}

/// "34.3 →" if the limit is another one than before a plan, a change by hand, or in the joint that this one is compared with; else empty.
export function beforeText({ plan, before, by_hand }: ReportText, motion: MotionAnswer): string {
  const planned = plan?.limits.find((each) => each.motion === motion.name)?.before;
  const then = planned ?? (by_hand?.before ?? before?.rom?.motions)?.find(({ name }) => name === motion.name);
  return then && endText(then) !== limitAlone(motion) ? words.from(endText(then).replace(/°$/, "")) : "";
}

/// "34.3 → 45.0°", or the limit if it is no other one.
export function fromBefore(text: ReportText, motion: MotionAnswer): string {
  return `${beforeText(text, motion)} ${limitAlone(motion)}`.trim();
}

/// Names of the joints of a comparison. If both have one name, the digest of the first file that differs stands beside it, or what was changed.
export function comparedFiles({ rom, joint, before }: ReportText): { before: string; after: string } | null {
  if (!before) return null;
  const [then, now] = [before.rom, rom].map((each) => (each?.provenance ? filesOf(each.provenance) : []));
  const names = { before: named(before.file ?? before.joint.name), after: named(rom?.provenance?.joint_file?.path ?? joint.name) };
  if (names.before !== names.after) return names;
  const i = now!.findIndex(({ sha256 }, at) => then![at]?.sha256 !== sha256), [old, young] = [then![i], now![i]];
  if (!old || !young) return { before: words.asInFile(names.before), after: `${names.after}, ${named(joint.planned ?? joint.name)}` };
  return { before: words.withDigest(names.before, named(old.path), old.sha256.slice(0, 8)), after: words.withDigest(names.after, named(young.path), young.sha256.slice(0, 8)) };
}
