import type { ReportText, StoredPart, StoredPosed } from "./report";
import type { Surface } from "./core/protocol";
import type { Part } from "./scene/body";
import { bodyNames, type BodyName } from "./scene/body_names";

/// Files of a joint that was changed on the page: meshes in the joint frame, and a joint file that names them.

/// A mesh of a body and its file; one for each mesh of a body.
interface MeshFile {
  name: string;
  part: Part | null;
}

/// Begins with what became of the meshes.
export type Became = "brushed" | "given";

export function meshFilesOf(body: BodyName, parts: readonly Part[], became: Became): MeshFile[] {
  if (parts.length === 0) return [{ name: `${became}_${body}.stl`, part: null }];
  return parts.map((part, i) => ({ name: `${became}_${body}_${i + 1}.stl`, part }));
}

const headBytes = 80, triangleBytes = 50;

/// Binary STL: coordinates in single precision, 80 bytes of text before them.
export function stlOf({ vertices, triangles }: Surface, part: Part | null, text: string): Blob {
  const first = part?.first_vertex ?? 0, last = part ? first + part.vertices : vertices.length / 3;
  const chosen: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) if (triangles[t]! >= first && triangles[t]! < last) chosen.push(t);
  const bytes = new DataView(new ArrayBuffer(headBytes + 4 + triangleBytes * chosen.length));
  new TextEncoder().encodeInto(text, new Uint8Array(bytes.buffer, 0, headBytes));
  bytes.setUint32(headBytes, chosen.length, true);
  chosen.forEach((t, i) => writeTriangle(bytes, headBytes + 4 + triangleBytes * i, [0, 1, 2].map((k) => 3 * triangles[t + k]!), vertices));
  return new Blob([bytes.buffer as ArrayBuffer], { type: "model/stl" });
}

function writeTriangle(bytes: DataView, at: number, corners: readonly number[], vertices: Float64Array): void {
  const [a, b, c] = corners.map((v) => [vertices[v]!, vertices[v + 1]!, vertices[v + 2]!] as const) as [Three, Three, Three];
  [...normalOf(a, b, c), ...a, ...b, ...c].forEach((value, i) => bytes.setFloat32(at + 4 * i, value, true));
}

type Three = readonly [number, number, number];

function normalOf(a: Three, b: Three, c: Three): Three {
  const u = b.map((value, i) => value - a[i]!) as [number, number, number], v = c.map((value, i) => value - a[i]!) as [number, number, number];
  const [x, y, z] = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(x, y, z) || 1;
  return [x / length, y / length, z / length];
}

/// A text in quotes, as TOML has it.
function quoted(text: string): string {
  return JSON.stringify(text.replaceAll(/[\u0000-\u001f\u007f]/g, " "));
}

function meshLines(body: BodyName, parts: readonly Part[], became: Became): string[] {
  return meshFilesOf(body, parts, became).flatMap(({ name, part }) => (part === null ? [`mesh = ${quoted(name)}`]
    : ["", `[[${body}.meshes]]`, `name = ${quoted(part.name)}`, `mesh = ${quoted(name)}`, `contact = ${quoted(part.contact)}`]));
}

/// Head and socket keep their fits from before: a fit to a bone that was cut would move them. A known one goes with the meshes as given.
function sphereLines({ rom, parts }: ReportText, posed: StoredPosed | null): string[] {
  const { head, socket, margin_mm } = rom?.bearing ?? {}, bears = !posed && parts.mobile.some(({ contact }) => contact === "bearing");
  const table = (name: string, sphere: typeof head, margin?: number | null) => (sphere?.centre_mm
    ? ["", `[${name}]${posed ? "" : "  # before the cut"}`, `centre = [${sphere.centre_mm.join(", ")}]`, `radius = ${sphere.radius_mm}`,
      ...(margin != null ? [`margin = ${margin}`] : [])] : []);
  return [
    ...table("fixed.socket", posed ? posed.fixed.head : socket),
    ...(bears ? [] : table("mobile.head", posed ? posed.mobile.head : head, posed ? posed.mobile.bearing_margin_mm : margin_mm)),
  ];
}

/// A point of a body in the frame of the file, which is that of the fixed one.
function inFile(body: BodyName, [x, y, z]: Three, X_FM: readonly number[]): Three {
  if (body === "fixed") return [x, y, z];
  return [0, 1, 2].map((i) => X_FM[4 * i]! * x + X_FM[4 * i + 1]! * y + X_FM[4 * i + 2]! * z + X_FM[4 * i + 3]!) as unknown as Three;
}

function partLines({ name, body, meshes, centre_mm, definition, parameters }: StoredPart, values: ReadonlyMap<string, number>, X_FM: readonly number[]): string[] {
  const isCup = parameters.some(({ kind }) => kind.startsWith("cup_"));
  return ["", "[[part]]", `name = ${quoted(name)}`, `body = "${body}"`, ...(meshes.length ? [`meshes = [${meshes.map(quoted).join(", ")}]`] : []),
    `centre = [${inFile(body, centre_mm, X_FM).join(", ")}]`, ...(isCup ? [`definition = "${definition}"`] : []),
    ...parameters.flatMap(({ name: parameter, kind, as_given, range, sigma, along, value }) => [
      "", "[[part.parameter]]", `name = ${quoted(parameter)}`, `kind = "${kind}"`, `as_given = ${as_given}`, `range = [${range.join(", ")}]`,
      `value = ${values.get(`${name}.${parameter}`) ?? value}`, ...(sigma > 0 ? [`sigma = ${sigma}`] : []),
      ...(kind === "translation" ? [`along = [${along.join(", ")}]`] : []),
    ])];
}

function personLines({ person }: ReportText["joint"]): string[] {
  const { age, sex, species } = person ?? {};
  return person ? ["", "[person]", ...(age === undefined ? [] : [`age = ${age}`]), ...(sex ? [`sex = "${sex}"`] : []), ...(species ? [`species = ${quoted(species)}`] : [])] : [];
}

/// Parts that were turned, and their values.
export interface TurnedParts {
  posed: StoredPosed;
  values: ReadonlyMap<string, number>;
}

/// `X_FM` of the reference pose, row by row. Of a joint whose bones a brush changed, or with parts that were turned.
export function jointFileOf(text: ReportText, X_FM: readonly number[], version: string, turned: TurnedParts | null): string {
  const { joint, reference_deg, coordinates, parts } = text, became = turned ? "given" : "brushed";
  const isPosed = reference_deg.some((deg) => deg !== 0), isStated = (text.rom?.zero?.from ?? "as_given") !== "as_given";
  const body = (name: BodyName) => ["", `[${name}]`, `name = ${quoted(joint[name])}`,
    ...(name === "mobile" && isPosed ? [`pose = [${X_FM.join(", ")}]`] : []), ...meshLines(name, parts[name], became)];
  // The values of turned parts stand in their own lines.
  const planned = turned ? text.rom?.provenance?.planned : [joint.planned, "changed by strokes"].filter(Boolean).join(", ");
  return [
    `# Written by a page of condyle ${version}: ${quoted(joint.name)} with ${turned ? "parts turned" : "bones changed by a brush"}.`, "condyle = 1",
    `name = ${quoted(joint.name)}`, ...(planned ? [`planned = ${quoted(planned)}`] : []),
    `kind = "${joint.kind}"`, ...(joint.kind === "hinge" && joint.anatomy === "hip" ? [] : [`joint = "${joint.anatomy}"`]),
    `side = "${joint.side}"`, `units = "mm"`, ...bodyNames.flatMap(body), ...sphereLines(text, turned?.posed ?? null), "",
    "[frame]  # the meshes are in the joint frame", "centre = [0, 0, 0]", "anterior = [1, 0, 0]", "superior = [0, 1, 0]",
    ...(isPosed || isStated ? ["", "[reference_pose]", ...coordinates.flatMap(({ name }, i) => (reference_deg[i] ? [`${name} = ${reference_deg[i]}`] : []))] : []),
    ...personLines(joint), ...(joint.ligaments ? [joint.ligaments] : []), ...(turned?.posed.parts ?? []).flatMap((part) => partLines(part, turned!.values, X_FM)), "",
  ].join("\n");
}
