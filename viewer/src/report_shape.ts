import {
  count, each, flag, ifThere, isObject, list, number, object, oneOf, orNull, ReportError, text, three, wrong, type Check, type Passed,
} from "./checks";
import { limitRecord, shapeRecord } from "./records";
import type { ArrayPlace } from "./report";
import { words } from "./words";

const meshFile = object({ path: text, bytes: number, sha256: text });
const severalFiles = object({ files: list(meshFile) });
const meshFiles: Check<Passed<typeof meshFile> | Passed<typeof severalFiles>> = (value, key) =>
  (isObject(value) && "files" in value ? severalFiles : meshFile)(value, key);

const sphere = object({ radius_mm: number, centre_mm: ifThere(three) });
const rom = object({
  implant: ifThere(object({ fixed_part: text, mobile_part: text })),
  exact: ifThere(flag), clock_plane: ifThere(orNull(oneOf("sagittal", "rim"))),
  held_translation_mm: ifThere(orNull(three)), motions: list(limitRecord), notes: list(object({ code: text, text })), caveats: list(text),
  zero: ifThere(object({ from: text, is_neutral: ifThere(orNull(flag)), text })), normal_range_source: ifThere(orNull(text)), scope: text, bearing: ifThere(object({
    rule: oneOf("count", "leave_out"), why_none: ifThere(text), head: ifThere(orNull(sphere)), socket: ifThere(orNull(sphere)),
    margin_mm: ifThere(orNull(number)),
  })),
  band: ifThere(orNull(object({
    samples: count, seed: number, sigma: object({ centre_mm: number, axes_deg: number, surface_mm: number, surface_voxels: ifThere(number), parameters: ifThere(each(number)) }),
  }))),
  provenance: ifThere(object({
    version: text, command: list(text), joint_file: meshFile, fixed_mesh: meshFiles, mobile_mesh: meshFiles, planned: ifThere(text),
    units_of_meshes: ifThere(text),
    parameters: ifThere(list(object({ name: text, value: number, unit: text, in_joint_file: number }))),
  })),
});

/// low, high, and what makes either end: 0 the range, 1 contact, 2 a ligament
const interval = list(number, 4) as Check<[number, number, number, number]>;
export type Interval = Passed<typeof interval>;
const turningAxis = object({ angle: text, opposite: text, values_deg: list(number) });
const slidingAxis = object({ translation: oneOf("x", "y", "z"), opposite: text, values_mm: list(number) });
type MapAxis = Passed<typeof turningAxis> | Passed<typeof slidingAxis>;
const mapAxis: Check<MapAxis> = (value, key) => (isObject(value) && "translation" in value ? slidingAxis : turningAxis)(value, key);

/// The held coordinate of a map's axis.
export function heldOn(axis: MapAxis): { name: string; unit: "deg" | "mm"; values: number[] } {
  return "translation" in axis ? { name: axis.translation, unit: "mm", values: axis.values_mm } : { name: axis.angle, unit: "deg", values: axis.values_deg };
}
const surface = object({
  first_vertex: count, vertices: count, first_triangle: count, triangles: count, youngs_modulus_mpa: ifThere(number),
  poisson_ratio: ifThere(number), thickness_mm: ifThere(text),
});
const part = object({ name: text, first_vertex: count, vertices: count, first_triangle: count, triangles: count, contact: oneOf("ends", "bearing", "soft") });

const geometry = object({
  geometry: object({
    neck: orNull(object({ head_centre_mm: three, direction: three })), shaft: orNull(object({ first_mm: three, last_mm: three })),
    condyles: orNull(object({ medial_mm: three, lateral_mm: three })),
    rim_plane: orNull(object({ centre_mm: three, normal: three, radius_mm: number })),
  }),
});

const measures: Check<Passed<typeof shapeRecord> & Passed<typeof geometry>> = (value, key) => [shapeRecord, geometry].forEach((check) => check(value, key));

const bodyName = oneOf("fixed", "mobile");
const end = object({ limit_deg: number, reason: oneOf("contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start") });
const cutSurface = orNull(object({ lowered: text, before: text, depth_mm: text }));
const plan = object({
  margin_mm: number,
  targets: list(object({
    motion: text, reach_deg: number, planned_deg: number, before: end, after: end, text,
    blocked: orNull(object({ kept_by: oneOf("bearing", "depth", "zone", "marked"), body: bodyName, point_mm: three })),
  })),
  cuts: list(object({
    body: bodyName, volume_mm3: number, least_volume_mm3: number, burr_volume_mm3: number, area_mm2: number, deepest_mm: number,
    deepest_hour: orNull(number),
  })),
  limits: list(object({ motion: text, before: end, after: end, gain_deg: number })),
  measures: orNull(list(object({ key: text, unit: text, before: orNull(number), after: orNull(number) }))),
  curve: list(object({ motion: text, reached_deg: number, volume_mm3: number, deepest_mm: number })),
  resection_notes: list(object({ code: text, text })), caveats: list(text),
  surfaces: object({ fixed: cutSurface, mobile: cutSurface }),
});

const bodyBefore = orNull(object({ vertices: text, triangles: text }));
const before = object({
  file: orNull(text), joint: object({ name: text, fixed: text, mobile: text }), rom: orNull(rom), rom_error: ifThere(text),
  differences: list(object({
    motion: text, difference_deg: orNull(number), difference_is: orNull(oneOf("exact", "at_least", "at_most")),
    band: orNull(object({ p5_deg: number, median_deg: number, p95_deg: number })), beyond_band: orNull(flag),
  })),
  surfaces: object({ fixed: bodyBefore, mobile: bodyBefore }),
});

const nameOrNull = orNull(text);
const givenBody = object({
  as_given: nameOrNull, head: orNull(object({ centre_mm: three, radius_mm: number })), fitted_head: nameOrNull, bearing_margin_mm: orNull(number),
  cut_triangles: list(count),
});
const posed = object({
  parts: list(object({
    name: text, body: bodyName, meshes: list(text), centre_mm: three, definition: text, is_cut: flag,
    parameters: list(object({
      name: text, kind: text, unit: text, range: list(number, 2) as Check<[number, number]>, value: number, in_joint_file: number,
      as_given: number, sigma: number, along: three,
    })),
  })),
  bearing_margin_mm: orNull(number), fixed: givenBody, mobile: givenBody,
});

const targetOrNull = orNull(count);
const sweep = object({
  parameters: list(object({ name: text, unit: text, first: number, last: number, step: number, count })),
  targets: list(object({ name: text, motion: text, reach_deg: number })), designs: count, safe_designs: count, safe_measure: number,
  window_measure: number, best: orNull(object({ values: each(number), margin_deg: number })), margin_deg: text, least_target: text,
  safe: list(object({ line: count, low: number, high: number, low_target: targetOrNull, high_target: targetOrNull })),
  sweep_notes: list(object({ code: text, text })), caveats: list(text),
});

const report = object({
  version: text, title: text, case: ifThere(orNull(text)), note: ifThere(orNull(text)), date: ifThere(orNull(text)),
  joint: object({
    name: text, kind: oneOf("ball", "hinge", "free"), anatomy: oneOf("hip", "knee", "ankle", "elbow", "shoulder"),
    side: oneOf("right", "left"), fixed: text, mobile: text, translation_frame: oneOf("fixed", "joint_axes"),
    planned: ifThere(text), person: ifThere(object({ age: ifThere(number), sex: ifThere(oneOf("female", "male")), species: ifThere(text) })), ligaments: ifThere(text),
  }),
  coordinates: list(object({ name: text, opposite: text }), 3), reference_deg: three, reference_mm: three,
  scope: ifThere(text), rom: orNull(rom), rom_error: ifThere(text),
  map: orNull(object({
    columns: mapAxis, rows: mapAxis, vary: text, vary_opposite: text, start_deg: ifThere(number), start_mm: ifThere(number), held_deg: ifThere(three),
    held_mm: ifThere(three), intervals: list(list(interval)),
  })),
  zones: list(object({ motion: text, past_deg: number, fixed: text, mobile: text })),
  layers: orNull(object({
    casting: oneOf("fixed", "mobile", "both"), law: oneOf("linear", "logarithmic"), rule: oneOf("face_centre", "cut_faces"),
    reach_mm: number, fixed: surface, mobile: surface,
  })),
  parts: object({ fixed: list(part), mobile: list(part) }),
  arrays: each(object({ type: oneOf("f64", "u32", "i16", "u8"), offset: count, length: count })),
  poses: list(object({
    name: text, coordinates_deg: three, pose: list(number, 16), in_contact: flag, contact_point_mm: orNull(three), fixed_gaps: text,
    mobile_gaps: text,
  })),
  recorded: orNull(object({
    name: text, axis: oneOf("time_s", "frame"), times_s: text, coordinates_deg: text, coordinates_mm: text, poses: text,
    curves: list(object({ name: text, unit: text, values: text })),
  })),
  recorded_motion: ifThere(object({ by: oneOf("columns", "poses", "model") })), measures: orNull(measures), plan: orNull(plan),
  before: ifThere(orNull(before)), posed: ifThere(orNull(posed)), sweep: ifThere(orNull(sweep)), only_in_reports: ifThere(list(oneOf("contact"))),
  taken_by_name: ifThere(list(object({ mesh: text, taken: text }))),
});

export type ReportText = Passed<typeof report>;

/// The text of a block with every key that the page reads; throws ReportError that names the first wrong one.
export function checkedText(json: string): ReportText {
  let said: unknown;
  try {
    said = JSON.parse(json);
  } catch {
    throw new ReportError(words.damaged + words.notJson);
  }
  report(said, "");
  const read = said as ReportText;
  if (read.map) checkMap(read.map);
  checkArrays(read);
  return read;
}

/// A map has a start, the coordinates that it holds if one of them is a translation, and every point.
function checkMap({ columns, rows, start_deg, start_mm, held_deg, held_mm, intervals }: NonNullable<ReportText["map"]>): void {
  const axes = [heldOn(columns), heldOn(rows)];
  if (start_deg === undefined && start_mm === undefined) wrong("map.start_deg");
  if ((start_mm !== undefined || axes.some(({ unit }) => unit === "mm")) && !(held_deg && held_mm)) wrong("map.held_mm");
  if (intervals.length !== axes[0]!.values.length * axes[1]!.values.length) wrong("map.intervals");
}

/// Arrays have as many entries as the vertices or triangles that they describe.
function checkArrays(read: ReportText): void {
  const needed = (key: string, name: string, type: ArrayPlace["type"], right: (length: number) => boolean) => {
    const place = Object.hasOwn(read.arrays, name) ? read.arrays[name]! : wrong(key);
    if (place.type !== type || !right(place.length)) wrong(`arrays.${name}`);
    return place.length;
  };
  const threes = (length: number) => length > 0 && length % 3 === 0;
  const many = (wanted: number) => (length: number) => length === wanted;
  const any = () => true;
  for (const body of ["fixed", "mobile"] as const) {
    const vertices = needed("arrays", `${body}_vertices`, "f64", threes) / 3;
    const triangles = needed("arrays", `${body}_triangles`, "u32", threes) / 3;
    if (`${body}_roles` in read.arrays) needed("arrays", `${body}_roles`, "u8", many(triangles));
    read.poses.forEach((pose, i) => needed(`poses[${i}].${body}_gaps`, pose[`${body}_gaps`], "i16", many(vertices)));
    read.zones.forEach((zone, i) => needed(`zones[${i}].${body}`, zone[body], "u32", any));
    read.parts[body].forEach((known, i) => known.first_vertex + known.vertices <= vertices || wrong(`parts.${body}[${i}]`));
    const cut = read.plan?.surfaces[body];
    if (cut) {
      const lowered = needed(`plan.surfaces.${body}.lowered`, cut.lowered, "u32", any);
      needed(`plan.surfaces.${body}.before`, cut.before, "f64", many(3 * lowered));
      needed(`plan.surfaces.${body}.depth_mm`, cut.depth_mm, "f64", many(lowered));
    }
    const ghost = read.before?.surfaces[body];
    if (ghost) {
      needed(`before.surfaces.${body}.vertices`, ghost.vertices, "f64", threes);
      needed(`before.surfaces.${body}.triangles`, ghost.triangles, "u32", threes);
    }
    const given = read.posed?.[body];
    if (given) {
      if (given.as_given !== null) needed(`posed.${body}.as_given`, given.as_given, "f64", many(3 * vertices));
      if (given.fitted_head !== null) needed(`posed.${body}.fitted_head`, given.fitted_head, "u32", any);
      if (given.cut_triangles.length !== read.parts[body].length) wrong(`posed.${body}.cut_triangles`);
    }
    const loaded = read.layers?.[body];
    if (!loaded) continue;
    if (loaded.first_vertex + loaded.vertices > vertices || loaded.first_triangle + loaded.triangles > triangles) wrong(`layers.${body}`);
    if (loaded.thickness_mm !== undefined)
      needed(`layers.${body}.thickness_mm`, loaded.thickness_mm, "f64", many(loaded.vertices));
  }
  if (read.sweep) {
    const { parameters, targets, margin_deg, least_target } = read.sweep;
    const designs = parameters.reduce((all, { count: values }) => all * values, 1);
    if (parameters.length < 1 || parameters.length > 2 || targets.length === 0) wrong("sweep.parameters");
    needed("sweep.margin_deg", margin_deg, "f64", many(designs));
    needed("sweep.least_target", least_target, "u8", many(designs));
  }
  if (!read.recorded) return;
  const { times_s, coordinates_deg, coordinates_mm, poses, curves } = read.recorded;
  const frames = needed("recorded.times_s", times_s, "f64", (length) => length > 0);
  needed("recorded.coordinates_deg", coordinates_deg, "f64", many(3 * frames));
  needed("recorded.coordinates_mm", coordinates_mm, "f64", many(3 * frames));
  needed("recorded.poses", poses, "f64", many(16 * frames));
  curves.forEach(({ values }, i) => needed(`recorded.curves[${i}].values`, values, "f64", many(frames)));
}
