// Records of answers, and checks of them. Made by `make describe` from the tables in src/answer/records/.
import { each, flag, ifThere, list, number, object, oneOf, orNull, text, three } from "./checks";

/// A vertex or a face by its number, or an edge by its two vertices, ascending: in numbers of the mesh, from 0.
export const featureRecord = object({
  kind: oneOf("vertex", "edge", "face"), vertices: ifThere(list(number)), id: ifThere(number), part: ifThere(text),
});

/// What is in contact of either body.
export const featuresRecord = object({ fixed: featureRecord, mobile: featureRecord });

/// Names of the meshes that touch, None of a body of one mesh.
export const partsRecord = object({ fixed: orNull(text), mobile: orNull(text) });

/// Depths of a limit with a depth allowed.
export const allowedDepthRecord = object({
  at_start_mm: number, at_limit_mm: number, ray_to_normal_deg: number, grows: flag,
});

/// Where liner and neck of an implant end a motion, as bodies of revolution.
export const closedForm = object({
  limit_deg: number, reason: oneOf("contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"),
  of_facets_deg: list(number),
});

/// Width of a band if only one source was uncertain.
export const bandWidthRecord = object({
  centre_deg: number, axes_deg: number, surface_deg: number, parameters_deg: ifThere(number),
});

/// The limit over the joints of a band.
export const bandRecord = object({
  p5_deg: number, median_deg: number, p95_deg: number, text: text, width_from: bandWidthRecord,
  share_without_contact: number, share_in_contact_at_start: number,
});

/// Means of simulations of bone in other people's hips; their spread is not given.
export const boneReference = object({
  healthy_deg: number, cam_without_complaints_deg: number, patients_deg: number, people_each: number, is_short: flag,
  source: text,
});

/// How much earlier soft tissue ended the motion than bone, in hips of cadavers.
export const softTissueGap = object({
  closeness: oneOf("close", "moderate", "weak"), mean_deg: number, sd_deg: number, hips: number, source: text,
});

/// How far other people's hips turn, soft tissue included; never of this joint.
export const peopleRange = object({
  low_deg: number, high_deg: number, who: text, people: orNull(number), source: text,
});

/// What studies say of the living beside a limit of bone.
export const livingLimit = object({
  expected_deg: orNull(number), expected_sd_deg: orNull(number), gap: orNull(softTissueGap),
  people: orNull(peopleRange), text: text,
});

/// A caveat to read before a limit is compared with a living joint.
export const caveat = object({
 
  code: oneOf("bone_may_end", "soft_tissue_ends", "soft_tissue_close", "capsule_restrains", "labrum_not_modelled", "end_unknown"),
  text: text, source: orNull(text),
});

/// The overlap past a limit, on the fixed body.
export const fixedZoneRecord = object({
  triangles: number, area_mm2: number, centroid_mm: orNull(three), max_radial_depth_mm: orNull(number),
  max_tangential_depth_deg: orNull(number), max_tangential_depth_mm: orNull(number), clock_hour: orNull(number),
});

/// The overlap past a limit, on the mobile body.
export const mobileZoneRecord = object({
  triangles: number, area_mm2: number, centroid_mm: orNull(three), max_radial_depth_mm: orNull(number),
  max_tangential_depth_deg: orNull(number), max_tangential_depth_mm: orNull(number), neck_angle_deg: orNull(number),
});

/// The overlap past a limit.
export const zoneRecord = object({
  past_deg: number, contact_neck_angle_deg: orNull(number), fixed: fixedZoneRecord, mobile: mobileZoneRecord,
});

/// Where one motion ends, in the words of rom.json.
export const limitRecord = object({
  name: text, limit_deg: number,
  reason: oneOf("contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"), ligament: orNull(text),
  contact_kind: orNull(oneOf("unknown", "bearing", "impingement", "cut", "soft")), bearing_contact_deg: orNull(number),
  bearing_contact_point_mm: orNull(three), soft_contact_deg: orNull(number), soft_contact_point_mm: orNull(three),
  soft_contact_parts: orNull(partsRecord), centre_distance_mm: orNull(number), joint_space_mm: orNull(number),
  error_bound_deg: number, vary: text, sense: oneOf("negative", "positive"), range_deg: number, start_deg: each(number),
  held_deg: each(number), zero_from: oneOf("as_given", "stated", "landmarks", "anatomy"), definition: orNull(text),
  at_limit_deg: each(number), translation_mm: orNull(three), translation_ends: orNull(flag),
  contact_point_mm: orNull(three), contact_point_mobile_mm: orNull(three), features: orNull(featuresRecord),
  contact_side: orNull(oneOf("superior", "anterior", "inferior", "posterior")), clock_hour: orNull(number),
  normal_range_deg: orNull(number), bone_reference: ifThere(boneReference), living: ifThere(livingLimit),
  caveats: list(caveat), guarantee: text, depth: ifThere(allowedDepthRecord), closed_form: ifThere(closedForm),
  zone: ifThere(orNull(zoneRecord)), band: orNull(bandRecord),
});

/// Between these values lie the measures of other people.
export const normalRange = object({
  low: number, high: number, people: text, count: orNull(number), meaning: text, source: text,
});

/// A measure over varied joints.
export const measureBand = object({
  p5: orNull(number), median: orNull(number), p95: orNull(number), samples_without_value: number,
});

/// One measure of a hip.
export const measureRecord = object({
  key: text, part: oneOf("femur", "acetabulum", "both"), unit: text, value: orNull(number), why_none: orNull(text),
  note: orNull(text), definition: text, measured_by: list(text), source: text, frame: orNull(text),
  normal: orNull(normalRange), patients: orNull(normalRange), band: orNull(measureBand),
});

/// What is measured in one direction around the neck, 12 superior and 3 anterior.
export const neckHour = object({
  hour: number, alpha_deg: orNull(number), alpha_at_1mm_deg: orNull(number), is_doubtful: flag,
  alpha_point_mm: orNull(three), offset_mm: orNull(number), offset_point_mm: orNull(three),
});

/// The rim in one direction around the socket, 12 superior and 3 anterior.
export const rimHour = object({
  hour: number, point_mm: orNull(three), cover_deg: orNull(number), centre_edge_deg: orNull(number), is_in_plane: flag,
});

/// The shape of a hip, in the words of measures.json.
export const shapeRecord = object({
  pelvis_frame: text, pelvic_tilt_deg: number, left_out: list(text), measures: list(measureRecord),
  around_neck: list(neckHour), rim: list(rimHour),
});

/// Notes by which no number holds, and those on how exact limits are, which `--strict` lets pass; others are findings.
export const noteGrades: Record<string, "wrong" | "remark"> = {
  same_mesh: "wrong", swapped_bodies: "wrong", axes_not_upright: "wrong", axes_turned: "wrong", wrong_side: "wrong",
  mirrored: "wrong", bodies_disagree: "wrong", centre_moves_limits: "remark", narrow_bearing_margin: "remark",
  limit_on_cut: "remark", limit_on_part_cut: "remark", limit_on_piece: "remark", sliding_surfaces: "remark",
  translation_ends: "remark", bones_touch: "remark", coarse_mesh: "remark", differs_from_closed_form: "remark",
  last_value_left_out: "remark", nothing_holds_joint: "remark", limit_through_bone: "remark",
};
