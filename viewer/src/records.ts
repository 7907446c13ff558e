// Records of answers, and checks of them. Made by `make describe` from the tables in src/answer/records/.
import { each, flag, ifThere, list, number, object, oneOf, orNull, text, three } from "./checks";

/// A vertex or a face by its number, or an edge by its two vertices, ascending: in numbers of the mesh, from 0.
export interface FeatureRecord {
  kind: "vertex" | "edge" | "face";
  vertices?: number[];
  id?: number;
  part?: string;
}
const featureRecord = object({
  kind: oneOf("vertex", "edge", "face"),
  vertices: ifThere(list(number)),
  id: ifThere(number),
  part: ifThere(text),
});

/// What is in contact of either body.
export interface FeaturesRecord {
  fixed: FeatureRecord;
  mobile: FeatureRecord;
}
const featuresRecord = object({
  fixed: featureRecord,
  mobile: featureRecord,
});

/// Names of the meshes that touch, None of a body of one mesh.
export interface PartsRecord {
  fixed: string | null;
  mobile: string | null;
}
const partsRecord = object({
  fixed: orNull(text),
  mobile: orNull(text),
});

/// Depths of a limit with a depth allowed.
export interface AllowedDepthRecord {
  at_start_mm: number;
  at_limit_mm: number;
  ray_to_normal_deg: number;
  grows: boolean;
}
const allowedDepthRecord = object({
  at_start_mm: number,
  at_limit_mm: number,
  ray_to_normal_deg: number,
  grows: flag,
});

/// Where liner and neck of an implant end a motion, as bodies of revolution.
export interface ClosedForm {
  limit_deg: number;
  reason: "contact" | "end_of_range" | "contact_at_start";
  of_facets_deg: number[];
}
const closedForm = object({
  limit_deg: number,
  reason: oneOf("contact", "end_of_range", "contact_at_start"),
  of_facets_deg: list(number),
});

/// Width of a band if only one source was uncertain.
export interface BandWidthRecord {
  centre_deg: number;
  axes_deg: number;
  surface_deg: number;
  parameters_deg?: number;
}
const bandWidthRecord = object({
  centre_deg: number,
  axes_deg: number,
  surface_deg: number,
  parameters_deg: ifThere(number),
});

/// The limit over the joints of a band.
export interface BandRecord {
  p5_deg: number;
  median_deg: number;
  p95_deg: number;
  width_from: BandWidthRecord;
  share_without_contact: number;
  share_in_contact_at_start: number;
}
const bandRecord = object({
  p5_deg: number,
  median_deg: number,
  p95_deg: number,
  width_from: bandWidthRecord,
  share_without_contact: number,
  share_in_contact_at_start: number,
});

/// A caveat to read before a limit is compared with a living joint.
export interface Caveat {
  code: "bone_may_end" | "soft_tissue_ends" | "soft_tissue_close" | "capsule_restrains" | "labrum_not_modelled" | "end_unknown";
  text: string;
  source: string | null;
}
const caveat = object({
  code: oneOf("bone_may_end", "soft_tissue_ends", "soft_tissue_close", "capsule_restrains", "labrum_not_modelled", "end_unknown"),
  text: text,
  source: orNull(text),
});

/// The overlap past a limit, on the fixed body.
export interface FixedZoneRecord {
  triangles: number;
  area_mm2: number;
  centroid_mm: [number, number, number] | null;
  max_radial_depth_mm: number | null;
  max_tangential_depth_deg: number | null;
  max_tangential_depth_mm: number | null;
  clock_hour: number | null;
}
const fixedZoneRecord = object({
  triangles: number,
  area_mm2: number,
  centroid_mm: orNull(three),
  max_radial_depth_mm: orNull(number),
  max_tangential_depth_deg: orNull(number),
  max_tangential_depth_mm: orNull(number),
  clock_hour: orNull(number),
});

/// The overlap past a limit, on the mobile body.
export interface MobileZoneRecord {
  triangles: number;
  area_mm2: number;
  centroid_mm: [number, number, number] | null;
  max_radial_depth_mm: number | null;
  max_tangential_depth_deg: number | null;
  max_tangential_depth_mm: number | null;
  neck_angle_deg: number | null;
}
const mobileZoneRecord = object({
  triangles: number,
  area_mm2: number,
  centroid_mm: orNull(three),
  max_radial_depth_mm: orNull(number),
  max_tangential_depth_deg: orNull(number),
  max_tangential_depth_mm: orNull(number),
  neck_angle_deg: orNull(number),
});

/// The overlap past a limit.
export interface ZoneRecord {
  past_deg: number;
  contact_neck_angle_deg: number | null;
  fixed: FixedZoneRecord;
  mobile: MobileZoneRecord;
}
const zoneRecord = object({
  past_deg: number,
  contact_neck_angle_deg: orNull(number),
  fixed: fixedZoneRecord,
  mobile: mobileZoneRecord,
});

/// Where one motion ends, in the words of rom.json.
export interface LimitRecord {
  name: string;
  limit_deg: number;
  reason: "contact" | "end_of_range" | "contact_at_start";
  contact_kind: "unknown" | "bearing" | "impingement" | "cut" | "soft" | null;
  bearing_contact_deg: number | null;
  bearing_contact_point_mm: [number, number, number] | null;
  soft_contact_deg: number | null;
  soft_contact_point_mm: [number, number, number] | null;
  soft_contact_parts: PartsRecord | null;
  centre_distance_mm: number | null;
  joint_space_mm: number | null;
  error_bound_deg: number;
  vary: string;
  sense: "negative" | "positive";
  range_deg: number;
  start_deg: Record<string, number>;
  held_deg: Record<string, number>;
  zero_from: "as_given" | "stated" | "landmarks" | "anatomy";
  definition: string | null;
  at_limit_deg: Record<string, number>;
  translation_mm: [number, number, number] | null;
  translation_ends: boolean | null;
  contact_point_mm: [number, number, number] | null;
  contact_point_mobile_mm: [number, number, number] | null;
  features: FeaturesRecord | null;
  contact_side: "superior" | "anterior" | "inferior" | "posterior" | null;
  clock_hour: number | null;
  normal_range_deg: number | null;
  caveats: Caveat[];
  guarantee: string;
  depth?: AllowedDepthRecord;
  closed_form?: ClosedForm;
  zone?: ZoneRecord | null;
  band: BandRecord | null;
}
const limitRecord = object({
  name: text,
  limit_deg: number,
  reason: oneOf("contact", "end_of_range", "contact_at_start"),
  contact_kind: orNull(oneOf("unknown", "bearing", "impingement", "cut", "soft")),
  bearing_contact_deg: orNull(number),
  bearing_contact_point_mm: orNull(three),
  soft_contact_deg: orNull(number),
  soft_contact_point_mm: orNull(three),
  soft_contact_parts: orNull(partsRecord),
  centre_distance_mm: orNull(number),
  joint_space_mm: orNull(number),
  error_bound_deg: number,
  vary: text,
  sense: oneOf("negative", "positive"),
  range_deg: number,
  start_deg: each(number),
  held_deg: each(number),
  zero_from: oneOf("as_given", "stated", "landmarks", "anatomy"),
  definition: orNull(text),
  at_limit_deg: each(number),
  translation_mm: orNull(three),
  translation_ends: orNull(flag),
  contact_point_mm: orNull(three),
  contact_point_mobile_mm: orNull(three),
  features: orNull(featuresRecord),
  contact_side: orNull(oneOf("superior", "anterior", "inferior", "posterior")),
  clock_hour: orNull(number),
  normal_range_deg: orNull(number),
  caveats: list(caveat),
  guarantee: text,
  depth: ifThere(allowedDepthRecord),
  closed_form: ifThere(closedForm),
  zone: ifThere(orNull(zoneRecord)),
  band: orNull(bandRecord),
});

/// Between these values lie the measures of other people.
export interface NormalRange {
  low: number;
  high: number;
  people: string;
  count: number | null;
  meaning: string;
  source: string;
}
const normalRange = object({
  low: number,
  high: number,
  people: text,
  count: orNull(number),
  meaning: text,
  source: text,
});

/// A measure over displaced joints.
export interface MeasureBand {
  p5: number | null;
  median: number | null;
  p95: number | null;
  samples_without_value: number;
}
const measureBand = object({
  p5: orNull(number),
  median: orNull(number),
  p95: orNull(number),
  samples_without_value: number,
});

/// One measure of a hip.
export interface MeasureRecord {
  key: string;
  part: "femur" | "acetabulum" | "both";
  unit: string;
  value: number | null;
  why_none: string | null;
  note: string | null;
  definition: string;
  measured_by: string[];
  source: string;
  frame: string | null;
  normal: NormalRange | null;
  patients: NormalRange | null;
  band: MeasureBand | null;
}
const measureRecord = object({
  key: text,
  part: oneOf("femur", "acetabulum", "both"),
  unit: text,
  value: orNull(number),
  why_none: orNull(text),
  note: orNull(text),
  definition: text,
  measured_by: list(text),
  source: text,
  frame: orNull(text),
  normal: orNull(normalRange),
  patients: orNull(normalRange),
  band: orNull(measureBand),
});

/// What is measured in one direction around the neck, 12 superior and 3 anterior.
export interface NeckHour {
  hour: number;
  alpha_deg: number | null;
  alpha_at_1mm_deg: number | null;
  is_doubtful: boolean;
  alpha_point_mm: [number, number, number] | null;
  offset_mm: number | null;
  offset_point_mm: [number, number, number] | null;
}
const neckHour = object({
  hour: number,
  alpha_deg: orNull(number),
  alpha_at_1mm_deg: orNull(number),
  is_doubtful: flag,
  alpha_point_mm: orNull(three),
  offset_mm: orNull(number),
  offset_point_mm: orNull(three),
});

/// The rim in one direction around the socket, 12 superior and 3 anterior.
export interface RimHour {
  hour: number;
  point_mm: [number, number, number] | null;
  cover_deg: number | null;
  centre_edge_deg: number | null;
  is_in_plane: boolean;
}
const rimHour = object({
  hour: number,
  point_mm: orNull(three),
  cover_deg: orNull(number),
  centre_edge_deg: orNull(number),
  is_in_plane: flag,
});

/// The shape of a hip, in the words of measures.json.
export interface ShapeRecord {
  pelvis_frame: string;
  pelvic_tilt_deg: number;
  left_out: string[];
  measures: MeasureRecord[];
  around_neck: NeckHour[];
  rim: RimHour[];
}
const shapeRecord = object({
  pelvis_frame: text,
  pelvic_tilt_deg: number,
  left_out: list(text),
  measures: list(measureRecord),
  around_neck: list(neckHour),
  rim: list(rimHour),
});

export { limitRecord, shapeRecord };
