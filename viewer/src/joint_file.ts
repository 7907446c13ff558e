import type { ReportText } from "./report";
import type { Surface } from "./core/protocol";
import type { Part } from "./scene/body";
import { bodyNames, type BodyName } from "./scene/scene";

/// Files of a joint whose bones were changed on the page: meshes in the joint frame, and a joint file that names them.

/// A mesh of a body and its file; one for each mesh of a body.
interface MeshFile {
  name: string;
  part: Part | null;
}

export function meshFilesOf(body: BodyName, parts: readonly Part[]): MeshFile[] {
  if (parts.length === 0) return [{ name: `brushed_${body}.stl`, part: null }];
  return parts.map((part, i) => ({ name: `brushed_${body}_${i + 1}.stl`, part }));
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

function meshLines(body: BodyName, parts: readonly Part[]): string[] {
  return meshFilesOf(body, parts).flatMap(({ name, part }) => (part === null ? [`mesh = ${quoted(name)}`]
    : ["", `[[${body}.meshes]]`, `name = ${quoted(part.name)}`, `mesh = ${quoted(name)}`, `contact = ${quoted(part.contact)}`]));
}

/// Head and socket keep their fits from before: a fit to a bone that was cut would move them.
function sphereLines({ rom, parts }: ReportText): string[] {
  const { head, socket, margin_mm } = rom?.bearing ?? {};
  const table = (name: string, sphere: typeof head) => (sphere?.centre_mm
    ? ["", `[${name}]  # before the cut`, `centre = [${sphere.centre_mm.join(", ")}]`, `radius = ${sphere.radius_mm}`] : []);
  const bears = parts.mobile.some(({ contact }) => contact === "bearing");
  return [
    ...table("fixed.socket", socket), ...(bears ? [] : table("mobile.head", head)),
    ...(!bears && head?.centre_mm && margin_mm != null ? [`margin = ${margin_mm}`] : []),
  ];
}

/// `X_FM` of the reference pose, row by row.
export function jointFileOf(text: ReportText, X_FM: readonly number[], version: string): string {
  const { joint, reference_deg, coordinates, parts } = text;
  const turned = reference_deg.some((deg) => deg !== 0);
  const body = (name: BodyName) => ["", `[${name}]`, `name = ${quoted(joint[name])}`,
    ...(name === "mobile" && turned ? [`pose = [${X_FM.join(", ")}]`] : []), ...meshLines(name, parts[name])];
  return [
    `# Written by a page of condyle ${version}: ${quoted(joint.name)} with bones changed by a brush.`, "condyle = 1", `name = ${quoted(joint.name)}`,
    `kind = "${joint.kind}"`, ...(joint.kind === "hinge" && joint.anatomy === "hip" ? [] : [`joint = "${joint.anatomy}"`]),
    `side = "${joint.side}"`, `units = "mm"`, ...bodyNames.flatMap(body), ...sphereLines(text), "",
    "[frame]  # the meshes are in the joint frame", "centre = [0, 0, 0]", "anterior = [1, 0, 0]", "superior = [0, 1, 0]",
    ...(turned ? ["", "[reference_pose]", ...coordinates.flatMap(({ name }, i) => (reference_deg[i] ? [`${name} = ${reference_deg[i]}`] : []))] : []), "",
  ].join("\n");
}
