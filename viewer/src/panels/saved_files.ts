import type { CoreClient } from "../core/client";
import type { Coordinates, JointArrays } from "../core/protocol";
import { shortened, spaced } from "../dom";
import { jointFileOf, meshFilesOf, stlOf, type Became, type TurnedParts } from "../joint_file";
import { fixed } from "../numbers";
import { ribbonOf } from "../planned";
import type { ReportText } from "../report";
import { save, saveBlob } from "../save";
import { bodyNames, type BodyName } from "../scene/body_names";
import type { JointScene } from "../scene/scene";
import { headingOf } from "./header";

/// A saved picture is at least so wide, for print.
const picture_px = 2400;

/// Without its ending.
export function fileName({ title }: ReportText): string {
  return shortened(title, 40).replaceAll(/[^\p{L}\p{N}]+/gu, "_");
}

/// "flexion 90.0°, adduction 0.0°, internal rotation 20.0°"
export function poseLine({ coordinates, joint }: ReportText, { angles }: Coordinates): string {
  return coordinates.slice(0, joint.kind === "hinge" ? 1 : 3).map(({ name }, i) => `${spaced(name)} ${fixed(angles[i]!, 1)}°`).join(", ");
}

/// The scene under its heading and the joint's pose, and the ribbon.
export async function savePicture(scene: JointScene, text: ReportText, at: Coordinates): Promise<void> {
  const title = `${headingOf(text)} · ${poseLine(text, at)}`;
  const blob = await scene.picture(title, ribbonOf(text), picture_px);
  saveBlob(`${fileName(text)}.png`, blob);
}

/// The meshes of a joint that was changed by hand, with the vertices of each body.
export function saveMeshes({ parts, version }: ReportText, arrays: JointArrays, became: Became, verticesOf: (body: BodyName) => Float64Array): void {
  for (const body of bodyNames)
    for (const { name, part } of meshFilesOf(body, parts[body], became))
      saveBlob(name, stlOf({ vertices: verticesOf(body), triangles: arrays[body].triangles }, part, `condyle ${version} ${became} ${body}`));
}

/// The joint file that names them.
export async function saveJointFile(core: CoreClient, text: ReportText, turned: TurnedParts | null = null): Promise<void> {
  const { pose } = await core.query({ of: "pose", at: { angles: text.reference_deg, translation: text.reference_mm } });
  const file = jointFileOf(text, Array.from(pose), text.version || (text.rom?.provenance?.version ?? ""), turned);
  save(turned ? "turned.toml" : "brushed.toml", "application/toml", file);
}

export async function saveSurfaces(scene: JointScene, text: ReportText): Promise<void> {
  saveBlob(`${fileName(text)}.glb`, await scene.exportGlb());
}
