import type { Coordinates } from "../core/protocol";
import { shortened, spaced } from "../dom";
import { fixed } from "../numbers";
import { ribbonOf } from "../planned";
import type { ReportText } from "../report";
import { saveBlob } from "../save";
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

export async function saveSurfaces(scene: JointScene, text: ReportText): Promise<void> {
  saveBlob(`${fileName(text)}.glb`, await scene.exportGlb());
}
