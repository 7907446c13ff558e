import { CoreJoint } from "../../viewer/src/core/joint";
import { blockOfJoint } from "../../viewer/src/core/joint_file";
import type { Coordinates, Depth, NamedFile } from "../../viewer/src/core/protocol";
import { jointArraysOf } from "../../viewer/src/joint_arrays";
import { bytesOf, inflated } from "../../viewer/src/packed";
import { Report, type MotionAnswer, type RomAnswer } from "../../viewer/src/report";
import { filesBeside, template } from "./place";

export type { Depth, MotionAnswer, RomAnswer };

/** Files by their paths as the joint file has them, from its folder; the joint file itself among them. */
export type Files = Record<string, ArrayBuffer | Uint8Array | Blob>;

/** Degrees by names of coordinates, as the joint file has them; those left out are 0. `translation_mm` is that of a free joint. */
export interface Pose {
  [coordinate: string]: number | readonly [number, number, number];
}

/** What of two bodies is in the other one at a pose. */
export interface Contact {
  in_contact: boolean;
  /** Triangles that cross each other: of the mobile body, of the fixed one, and so on. */
  pairs: Uint32Array;
  /** Vertices inside the other body, and how deep along the ray, mm. */
  mobile_in_fixed: { vertices: Uint32Array; depths_mm: Float64Array };
  fixed_in_mobile: { vertices: Uint32Array; depths_mm: Float64Array };
}

/** A joint in memory: what its file says, and the core that answers. */
export class Joint {
  readonly #core: CoreJoint;

  /** By readJoint(). */
  constructor(
    core: CoreJoint, readonly name: string, readonly side: "right" | "left", readonly bodies: { fixed: string; mobile: string },
    readonly coordinates: readonly string[], readonly limits: RomAnswer | null) {
    this.#core = core;
  }

  /** Throws RangeError for a name that is no coordinate. */
  answer<Answer>(pose: Pose, ask: (core: CoreJoint, at: Coordinates) => Answer): Answer {
    const { translation_mm = [0, 0, 0], ...degrees } = pose;
    for (const [name, value] of Object.entries(degrees))
      if (!this.coordinates.includes(name) || typeof value !== "number" || !Number.isFinite(value))
        throw new RangeError(`${name}: ${String(value)}: a pose has finite degrees of ${this.coordinates.join(", ")}`);
    const angles = [0, 1, 2].map((i) => (degrees[this.coordinates[i] ?? ""] as number | undefined) ?? 0) as Coordinates["angles"];
    return ask(this.#core, { angles, translation: [...(translation_mm as readonly [number, number, number])] });
  }
}

/** The core as the page's template holds it: once in the package. */
let core: Promise<ArrayBuffer> | null = null;
async function wasm(): Promise<ArrayBuffer> {
  const page = await template();
  const text = /<script type="application\/octet-stream" id="core">([^<]*)</.exec(page)?.[1];
  if (!text) throw new Error("the package has no core: report_template.html is damaged");
  return inflated(bytesOf(text), "gzip");
}

/** Reads a joint file with its meshes: a path in node, else files by their paths, of which one ends with .toml. Limits are computed where it is read.
 * Rejects with the line of the command for a file that is not taken. */
export async function readJoint(files: string | URL | Files): Promise<Joint> {
  const isPath = typeof files === "string" || files instanceof URL, given = isPath ? await filesBeside(files) : files;
  const named: NamedFile[] = Object.entries(given).map(([path, bytes]) => ({
    path, file: ("arrayBuffer" in bytes ? bytes : new Blob([bytes as BlobPart])) as File,
  }));
  const joint = isPath ? named[0] : named.find(({ path }) => path.endsWith(".toml"));
  if (!joint) throw new Error("a joint file is needed, NAME.toml");
  const bytes = await (core ??= wasm());
  const report = Report.of(await blockOfJoint(bytes, joint, named));
  const { joint: { name, side, fixed, mobile }, coordinates, rom } = report.text;
  return new Joint(
    await CoreJoint.open(bytes, jointArraysOf(report)), name, side, { fixed, mobile }, coordinates.map((each) => each.name), rom);
}

/** Where the joint's motions end, with notes and caveats: `condyle rom --json`. Null for a joint that has none, and for one that is in contact where
 * motions start. */
export function rangeOfMotion(joint: Joint): RomAnswer | null {
  return joint.limits;
}

/** The deepest place and its depth along the ray or an arc, area and volume at a pose: `condyle depth`. */
export function depth(joint: Joint, pose: Pose = {}): Depth {
  return joint.answer(pose, (core, at) => core.depth(at));
}

/** What touches at a pose. */
export function contact(joint: Joint, pose: Pose = {}): Contact {
  return joint.answer(pose, (core, at) => {
    const { inContact, pairs, mobileInFixed, fixedInMobile } = core.details(at);
    return { in_contact: inContact, pairs, mobile_in_fixed: mobileInFixed, fixed_in_mobile: fixedInMobile };
  });
}
