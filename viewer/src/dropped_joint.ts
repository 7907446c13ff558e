import { CoreClient } from "./core/client";
import { lineOf } from "./core/error_line";
import type { NamedFile, Proposal } from "./core/protocol";
import { named } from "./dom";
import { bytesOf, inflated } from "./packed";
import { isJointFile } from "./panels/drop";
import { Report, type ReportText } from "./report";
import { isCoreDamage, wasmBytes } from "./stored_core";
import { words } from "./words";

/// The report text of a joint that was dropped on the page.
export function textOfProposal(proposal: Proposal): ReportText {
  const side = proposal.joint.side === 0 ? "right" : "left", { fixed, mobile } = proposal.bodies;
  return {
    version: "", title: words.dropped(named(fixed), named(mobile)),
    joint: { name: words.dropped(named(fixed), named(mobile)), kind: "ball", anatomy: "hip", side, fixed, mobile, translation_frame: "fixed" },
    coordinates: [
      { name: "flexion", opposite: "extension" }, { name: "adduction", opposite: "abduction" },
      { name: "internal_rotation", opposite: "external_rotation" },
    ],
    reference_deg: [0, 0, 0], reference_mm: [0, 0, 0],
    scope: proposal.rom.scope, rom: proposal.rom,
    map: null, zones: [], layers: null, parts: { fixed: [], mobile: [] }, arrays: {}, poses: [], recorded: null, measures: null,
    plan: null,
  };
}

/// The joint of a joint file and its meshes. Rejects with the line of a file that is not taken.
export async function readJoint(files: readonly NamedFile[]): Promise<Report> {
  const [joint, other] = files.filter(({ path }) => isJointFile(path));
  if (other) throw new Error(words.dropOneJoint(named(joint!.path), named(other.path)));
  const paths = new Set<string>();
  for (const { path } of files) {
    if (paths.has(path)) throw new Error(words.dropSameName(named(path)));
    paths.add(path);
  }
  // A browser that is given two files of one name may number the second one.
  for (const path of paths) {
    const first = path.replace(/ \(\d+\)(\.[^./]*)$/, "$1");
    if (!path.includes("/") && first !== path && paths.has(first)) throw new Error(words.dropMaybeSameName(named(first), named(path)));
  }
  const wasm = await wasmBytes(), { core, answer } = await CoreClient.begin("jointFile", { wasm, file: joint!, files }, [wasm]);
  core.close();
  return Report.of(answer);
}

/// The files of the sample hip that the page without a joint has; null on other pages.
export function sampleFiles(): (() => Promise<NamedFile[]>) | null {
  const stored = [...document.querySelectorAll<HTMLElement>("[data-sample]")];
  const fileOf = async ({ dataset: { sample: path = "" }, textContent }: HTMLElement) =>
    ({ path, file: new File([await inflated(bytesOf(textContent!), "deflate")], path) });
  return stored.length ? () => Promise.all(stored.map(fileOf)) : null;
}

/// Reason why files were not taken, in a line.
export function reasonOf(error: unknown): string {
  return isCoreDamage(error) ? words.coreDamagedToRead : lineOf(error);
}
