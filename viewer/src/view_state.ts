import { bodyNames, type BodyName } from "./scene/body_names";
import type { ClipAxis } from "./scene/scene";

/// State of the scene's display.
export interface DisplayState {
  colour: string | null;
  /// End of the colour scale; null for the quantity's default.
  scale: number | null;
  /// "fixed", "mobile", or the number of a part behind one of them: "mobile.1".
  hidden: string[];
  opacity: Record<BodyName, number>;
  clip: ClipAxis;
  clipAt_mm: number;
}

/// State that a shared link restores: coordinates of the joint, its display and the camera, as the fragment of the
/// address.
export interface ViewState {
  /// Coordinates that differ from the reference pose.
  coordinates: Record<string, number>;
  display: DisplayState;
  /// Motion whose impingement zone is marked; none if empty.
  zone: string;
  camera: number[] | null;
  /// Whether the joint was changed by hand, which no link carries.
  isByHand: boolean;
}

const cameraNumbers = 6;

/// All but the coordinates, which are checked as fields are.
export function readViewState(fragment: string): Omit<ViewState, "coordinates"> {
  const fields = new URLSearchParams(fragment.replace(/^#/, ""));
  const number = (text: string | null | undefined): number | null => {
    const value = Number.parseFloat(text ?? "");
    return Number.isFinite(value) ? value : null;
  };
  const camera = (fields.get("camera") ?? "").split(",").map(Number);
  const [axis, at] = (fields.get("clip") ?? "").split(":");
  const clip: ClipAxis = axis === "x" || axis === "y" || axis === "z" ? axis : "none";
  const scale = number(fields.get("scale"));
  const opacity = (body: BodyName) => Math.min(1, Math.max(0.1, number(fields.get(`${body}_opacity`)) ?? 1));
  return {
    display: {
      colour: fields.get("colour"), scale: scale !== null && scale > 0 ? scale : null,
      hidden: (fields.get("hidden") ?? "").split(",").filter((name) => name !== ""),
      opacity: { fixed: opacity("fixed"), mobile: opacity("mobile") },
      clip, clipAt_mm: clip === "none" ? 0 : (number(at) ?? 0),
    },
    zone: fields.get("zone") ?? "",
    camera: camera.length === cameraNumbers && camera.every(Number.isFinite) ? camera : null, isByHand: fields.has("by_hand"),
  };
}

/// Default values are left out. Coordinates keep all of their digits: the end of a motion is free, a hair beyond it
/// is not.
export function writeViewState({ coordinates, display, zone, camera, isByHand }: ViewState): string {
  const fields = new URLSearchParams();
  for (const [name, value] of Object.entries(coordinates)) fields.set(name, String(value));
  if (display.colour) fields.set("colour", display.colour);
  if (display.scale !== null) fields.set("scale", String(display.scale));
  if (display.hidden.length) fields.set("hidden", display.hidden.join(","));
  for (const body of bodyNames) if (display.opacity[body] < 1) fields.set(`${body}_opacity`, String(display.opacity[body]));
  if (display.clip !== "none") fields.set("clip", `${display.clip}:${display.clipAt_mm}`);
  if (zone) fields.set("zone", zone);
  if (camera) fields.set("camera", camera.map((n) => n.toFixed(1)).join(","));
  if (isByHand) fields.set("by_hand", "1");
  return `#${fields}`;
}
