import { fold, html, named, namesOf, shortened, spaced } from "../dom";
import { fixed } from "../numbers";
import type { MeshSource, MotionAnswer, PartParameter, ReportText, RomAnswer } from "../report";
import { hasLimits, limitAlone, shownBand } from "../result";
import { motionName, words } from "../words";
import { lines, longestLine, table } from "./table";

/// The joint file, if there is one, and the meshes.
export function filesOf({ joint_file, fixed_mesh, mobile_mesh }: NonNullable<RomAnswer["provenance"]>): MeshSource[] {
  return [...(joint_file ? [joint_file] : []), ...[fixed_mesh, mobile_mesh].flatMap((mesh) => ("files" in mesh ? mesh.files : [mesh]))];
}

/// All numbers of the report with their units, sources and limits of use, each group under a title that opens it.
export function numberFolds(
  report: ReportText, counts: { fixed: [number, number]; mobile: [number, number] }, ofPose: readonly HTMLElement[]): HTMLDetailsElement[] {
  const { joint, rom } = report;
  const folds = [fold(words.thisPose, true, ...ofPose)];
  if (rom) {
    if (hasLimits(report)) folds.push(fold(words.limits, false, limitsTable(rom, joint)));
    if (hasLimits(report)) folds.at(-1)!.classList.add("of-report");
    const notes = fold(words.notes, rom.notes.length > 0,
      rom.notes.length ? lines(rom.notes.map(({ code, text }) => `${text} (${code})`)) : html("p", {}, words.noNotes));
    notes.id = "checks";
    folds.push(notes);
  }
  folds.push(fold(words.method, false, ...methodOf(report, counts)));
  if (rom?.provenance) folds.push(fold(words.sourceFiles, false, ...sourcesOf(rom.provenance)));
  return folds;
}

/// How the report's numbers were computed, and their caveats.
export function methodOf(report: ReportText, counts: { fixed: [number, number]; mobile: [number, number] }): HTMLElement[] {
  const { joint, rom } = report, caveats = rom ? caveatsOf(rom) : [];
  return [
    ...(report.note ? [html("p", {}, report.note)] : []),
    table(["", words.vertices, words.triangles], (["fixed", "mobile"] as const).map((body) => [namesOf(joint)[body], ...counts[body].map(String)]),
      words.ofBodies(words.sides[joint.side], words.kinds[joint.kind])),
    ...(rom ? [html("h3", {}, words.how), lines(howFound(rom))] : [html("p", { class: "warning" }, words.noLimits + (report.rom_error ?? ""))]),
    ...(caveats.length ? [html("h3", {}, words.caveats), lines(caveats)] : []),
    ...(rom?.caveats.length ? [html("h3", {}, words.readWith), lines(rom.caveats)] : []),
  ];
}

export function sourcesOf(provenance: NonNullable<RomAnswer["provenance"]>, title: string = words.files): HTMLElement[] {
  const { version, command, units_of_meshes } = provenance, files = filesOf(provenance);
  return [
    html("p", {}, shortened(command?.length ? words.madeBy(version, command.join(" ")) : words.madeHere(version), longestLine)),
    ...((units_of_meshes ?? "mm") === "mm" ? [] : [html("p", {}, words.meshesIn(units_of_meshes!))]),
    table([words.file, words.bytes, words.sha256], files.map(({ path, bytes, sha256 }) => [path, String(bytes), sha256]), title),
  ];
}

/// A line for each text, with its motions.
function grouped(said: readonly { name: string; text: string; source: string | null }[]): string[] {
  const about = new Map<string, { names: string[]; source: string | null }>();
  for (const { name, text, source } of said) {
    const known = about.get(text) ?? { names: [], source };
    known.names.push(named(motionName(name)));
    about.set(text, known);
  }
  return [...about].map(([text, { names, source }]) => words.caveat(names.join(", "), text, source));
}

/// What usually ends a motion, but where the lines on living hips say more.
function caveatsOf({ motions }: RomAnswer): string[] {
  return grouped(motions.flatMap(({ name, living, caveats }) =>
    (caveats ?? []).filter(({ code }) => !living?.gap || code === "labrum_not_modelled").map((caveat) => ({ name, ...caveat }))));
}

const degrees = (value: number | null) => (value === null ? "–" : `${fixed(value, 1)}°`);

/// The contact that ended a motion: which meshes, if bodies have several, and which soft meshes it met before.
function endOf(motion: MotionAnswer, joint: ReportText["joint"]): string {
  const { reason, contact_kind, contact_side, features, soft_contact_deg, soft_contact_parts: soft } = motion;
  const fixedPart = features?.fixed.part, mobile = features?.mobile.part;
  const meeting = (moving?: string | null, other?: string | null) => words.meshOn(spaced(moving ?? joint.mobile), spaced(other ?? joint.fixed));
  const kind = contact_kind !== null && (words.contactKinds[contact_kind] ?? contact_kind);
  const how = [kind, contact_side, (fixedPart || mobile) && meeting(mobile, fixedPart),
    typeof soft_contact_deg === "number" && words.softFrom(
      degrees(soft_contact_deg), soft ? meeting(soft.mobile, soft.fixed) : null)].filter(Boolean).join(", ");
  const end = !motion.translation_ends ? [words.reasons[reason], motion.ligament && named(motion.ligament)].filter(Boolean).join(" ") : motion.translation_mm ? words.translationEnds : words.notCarried;
  return how ? words.endsBy(end, how) : end;
}

function limitsTable({ motions }: RomAnswer, joint: ReportText["joint"]): HTMLElement {
  return table(
    ["", words.limit, words.band, words.reason, words.bearingContact, words.livingHips, words.errorBound],
    motions.map((motion) => {
      const band = shownBand(motion);
      return [
        named(motionName(motion.name)), limitAlone(motion), band ? words.bandEnds(band.text) : "–",
        endOf(motion, joint),
        degrees(motion.bearing_contact_deg), motion.living?.text ?? "–",
        motion.reason !== "contact" || motion.error_bound_deg === undefined ? "–" : `${motion.error_bound_deg.toPrecision(2)}°`,
      ];
    }), words.limits);
}

function changedParameter({ name, value, unit, in_joint_file }: PartParameter): string {
  return words.changedTo(name, unit === "1" ? String(value) : `${value} ${unit}`, String(in_joint_file));
}

/// Sources of clinical ranges and of the column of living hips.
function livingSources({ motions, normal_range_source: clinical }: RomAnswer): string[] {
  const gaps = motions.flatMap(({ name, living }) => (living?.gap ? [{ said: words.livingGap(named(motionName(name)), living.gap), gap: living.gap }] : []));
  const people = grouped(motions.flatMap(({ name, living }) =>
    (living?.people && living.expected_deg === null && living.people.source !== clinical ? [{ name, text: living.people.who, source: living.people.source }] : [])));
  return [
    ...(gaps[0] ? [words.livingFrom(gaps.map(({ said }) => said), gaps[0].gap)] : []),
    ...(clinical ? [[words.normalFrom(clinical), ...(people.length ? [words.people(people.join("; "))] : [])].join(" ")] : []),
  ];
}

/// The rules and the uncertainty of the limits, a line each.
function howFound(rom: RomAnswer): string[] {
  const { exact, band, bearing, zero, motions, provenance } = rom, mm = (value: number) => value.toFixed(2);
  const surface = [
    bearing && words.bearingRules[bearing.rule], bearing?.why_none && words.bearingWhy(bearing.why_none),
    bearing?.head && words.bearingHead(mm(bearing.head.radius_mm)), bearing?.socket && words.bearingSocket(mm(bearing.socket.radius_mm)),
    typeof bearing?.margin_mm === "number" && words.bearingMargin(mm(bearing.margin_mm)),
  ].filter(Boolean).join(" ");
  const changed = (provenance?.parameters ?? []).filter(({ value, in_joint_file }) => value !== in_joint_file);
  return [
    ...(changed.length ? [words.notAsInFile(changed.map(changedParameter).join(", "))] : []),
    (exact === false ? words.bounded : words.guarantee) + (zero ? ` ${words.zeroAt(zero.text)}` : ""),
    band ? words.bandsFrom({ samples: band.samples, seed: band.seed, ...band.sigma }) : words.noBand,
    ...(surface ? [surface] : []),
    ...livingSources(rom),
    ...motions.flatMap(({ name, bone_reference: bone }) => (bone ? [words.boneFrom(motionName(name), bone)] : [])),
  ];
}
