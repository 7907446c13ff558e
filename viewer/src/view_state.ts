/// What a shared link brings back: coordinates of the joint, colours and the camera, as the fragment of the address.
export interface ViewState {
  coordinates: Record<string, number>;
  colour: string | null;
  camera: number[] | null;
}

const cameraNumbers = 6;

export function readViewState(fragment: string, names: readonly string[]): ViewState {
  const fields = new URLSearchParams(fragment.replace(/^#/, ""));
  const coordinates: Record<string, number> = {};
  for (const name of names) {
    const value = Number.parseFloat(fields.get(name) ?? "");
    if (Number.isFinite(value)) coordinates[name] = value;
  }
  const camera = (fields.get("camera") ?? "").split(",").map(Number);
  return {
    coordinates,
    colour: fields.get("colour"),
    camera: camera.length === cameraNumbers && camera.every(Number.isFinite) ? camera : null,
  };
}

export function writeViewState({ coordinates, colour, camera }: ViewState): string {
  const fields = new URLSearchParams();
  for (const [name, value] of Object.entries(coordinates)) if (value !== 0) fields.set(name, String(Number(value.toFixed(4))));
  if (colour) fields.set("colour", colour);
  if (camera) fields.set("camera", camera.map((n) => n.toFixed(1)).join(","));
  return `#${fields}`;
}
