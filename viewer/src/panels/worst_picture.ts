import { html } from "../dom";
import type { JointArrays } from "../core/protocol";
import type { MotionAnswer, ReportText, StoredPose } from "../report";
import { headlineMotion } from "../result";
import { JointScene } from "../scene/scene";
import { motionName } from "../words";
import type { Paper } from "./paper";
import { placeOf, sentenceOf } from "./strip";

/// The picture for paper waits until the page has answered and is idle.
const pictureAfter_ms = 1500;
const width_px = 1200;
/// Beyond so many triangles a second scene costs more than a picture is worth: paper shows the scene on the screen.
const most = 600_000;

/// Draws the limit that the sentence is about for this place on paper, while nobody waits, unless `closed` is aborted meanwhile. `drawn` takes
/// the picture and what it shows.
export function drawWorst(
  text: ReportText, arrays: JointArrays, within: Paper["pictureSize"], closed: AbortSignal, drawn: (picture: string, caption: string) => void): void {
  const headline = headlineMotion(text);
  const pose = headline && text.poses.find(({ name }) => name === headline.name);
  if (!headline || !pose || headline.reason !== "contact") return;
  window.setTimeout(() => {
    if (closed.aborted) return;
    const picture = pictureOf(text, arrays, pose, labelOf(headline, text), text.rom?.bearing?.head?.radius_mm ?? null, within);
    if (picture) drawn(picture, sentenceOf(headline, text));
  }, pictureAfter_ms);
}

function labelOf(motion: MotionAnswer, text: ReportText): string {
  return [motionName(motion.name), placeOf(motion, text)].filter(Boolean).join(": ");
}

/// A picture of the joint at one of the report's poses, drawn beside the page; null if it is too large or the browser draws no scene.
function pictureOf(
  text: ReportText, { fixed, mobile }: JointArrays, pose: StoredPose, label: string, radius_mm: number | null, within: Paper["pictureSize"]): string | null {
  if ((fixed.triangles.length + mobile.triangles.length) / 3 > most) return null;
  const place = html("div", { class: "beside-page", "aria-hidden": "true" });
  place.style.width = `${width_px}px`;
  place.style.height = `${(width_px * within.height) / within.width}px`;
  document.body.append(place);
  try {
    const scene = new JointScene(place, fixed, mobile, text.parts, "");
    scene.canvas.tabIndex = -1;
    scene.setJointRadius(radius_mm);
    scene.setPose(pose.pose);
    scene.arriveAt(pose.contact_point_mm, label, "mobile", "at once");
    const picture = scene.pictureCanvas("", null, 0, within).toDataURL("image/png");
    scene.canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context")?.loseContext();
    return picture;
  } catch {
    return null;
  } finally {
    place.remove();
  }
}
