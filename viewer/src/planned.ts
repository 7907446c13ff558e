import { named } from "./dom";
import { fixed } from "./numbers";
import { filesOf } from "./panels/numbers";
import type { MotionAnswer, ReportText } from "./report";
import { endText } from "./result";
import { bodyNames, type BodyName } from "./scene/body_names";
import { words } from "./words";

/// What a plan did to the joint of the page: "without 164.1 mm³ of femur"; null for a joint as it was measured.
export function plannedOf({ joint }: ReportText): string | null {
  return joint.planned ? named(joint.planned).replaceAll("mm3", "mm³") : null;
}

/// What strokes of the brush did to the bones of the page; nothing while no bone is gone.
export function plannedByHand(joint: ReportText["joint"], gone: Partial<Record<BodyName, { volume_mm3: number }>>): string | undefined {
  const said = bodyNames.flatMap((body) => (gone[body]?.volume_mm3 ? [words.volumeOf(fixed(gone[body].volume_mm3, 1), joint[body])] : []));
  return said.length ? words.without(said.join(", ")) : undefined;
}

/// The limit before the plan, if the page knows it: "now 32.6°". In a comparison it is that of the joint before.
export function nowOf({ plan, before, joint }: ReportText, { name }: MotionAnswer): string | null {
  const known = plan ? plan.limits.find(({ motion }) => motion === name)?.before : joint.planned ? before?.rom?.motions.find((each) => each.name === name) : null;
  return known ? words.nowIs(endText(known)) : null;
}

/// Names of the joints of a comparison. Two of one name are told apart by the digests of the first file that differs, or else by what was changed.
export function comparedFiles({ rom, joint, before }: ReportText): { before: string; after: string } | null {
  if (!before) return null;
  const [then, now] = [before.rom, rom].map((each) => (each?.provenance ? filesOf(each.provenance) : []));
  const names = { before: named(before.file ?? before.joint.name), after: named(rom?.provenance?.joint_file?.path ?? joint.name) };
  if (names.before !== names.after) return names;
  const i = now!.findIndex(({ sha256 }, at) => then![at]?.sha256 !== sha256), [old, young] = [then![i], now![i]];
  if (!old || !young) return { before: words.asInFile(names.before), after: `${names.after}, ${named(joint.planned ?? joint.name)}` };
  return { before: words.withDigest(names.before, named(old.path), old.sha256.slice(0, 8)), after: words.withDigest(names.after, named(young.path), young.sha256.slice(0, 8)) };
}
