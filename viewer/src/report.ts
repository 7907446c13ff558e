import { ReportError } from "./checks";
import { bytesOf, inflated } from "./packed";
import type { LimitRecord, ShapeRecord } from "./records";
import { checkedText } from "./report_shape";
import type { Part } from "./scene/body";
import { words } from "./words";

/// Data that `condyle report` puts into the page; docs/report-data.md has every key.

export interface ArrayPlace {
  type: "f64" | "u32" | "i16" | "u8";
  offset: number;
  length: number;
}

export interface Band {
  p5_deg: number;
  median_deg: number;
  p95_deg: number;
}

export type MotionAnswer = LimitRecord;

export interface MeshSource {
  path: string;
  bytes: number;
  sha256: string;
}

export interface FittedSphere {
  radius_mm: number;
  centre_mm?: [number, number, number];
}

export interface RomAnswer {
  exact?: boolean;
  bearing?: {
    rule: "count" | "leave_out";
    why_none?: string;
    head?: FittedSphere | null;
    socket?: FittedSphere | null;
    margin_mm?: number | null;
  };
  band?: { samples: number; seed: number; sigma: BandSigma } | null;
  clock_plane?: "sagittal" | "rim" | null;  // null for joints other than hips
  held_translation_mm?: [number, number, number] | null;
  implant?: { fixed_part: string; mobile_part: string };
  motions: MotionAnswer[];
  notes: { code: string; text: string }[];
  caveats: string[];
  zero?: { from: string; is_neutral?: boolean | null; text: string };  // is_neutral: null for joints other than hips
  normal_range_source?: string | null;
  scope: string;
  provenance?: {
    version: string;
    /// Set by a report; of files dropped on the page it is empty, or neither is there.
    command?: string[];
    joint_file?: MeshSource;
    fixed_mesh: MeshSource | { files: MeshSource[] };
    mobile_mesh: MeshSource | { files: MeshSource[] };
    /// What a plan did to the bones, without the values of parts.
    planned?: string;
    parameters?: PartParameter[];
  };
}

/// A parameter that moves a part of a body.
export interface PartParameter {
  name: string;
  value: number;
  unit: string;  // "1" of a size
  in_joint_file: number;
}

export interface BandSigma {
  centre_mm: number;
  axes_deg: number;
  surface_mm: number;
  surface_voxels?: number;
  parameters?: Record<string, number>;
}

export interface MapAxis {
  angle: string;
  opposite: string;
  values_deg: number[];
}

/// low, high, whether contact ends it at the low end, and at the high end
export type Interval = [number, number, number, number];

export interface MapAnswer {
  columns: MapAxis;
  rows: MapAxis;
  vary: string;
  vary_opposite: string;
  start_deg: number;
  intervals: Interval[][];
}

/// Names of arrays of triangles that meet past the end of a motion.
export interface StoredZone {
  motion: string;
  past_deg: number;
  fixed: string;
  mobile: string;
}

export interface StoredSurface {
  first_vertex: number;
  vertices: number;
  first_triangle: number;
  triangles: number;
  youngs_modulus_mpa?: number;
  poisson_ratio?: number;
  thickness_mm?: string;
}

export interface StoredLayers {
  casting: "fixed" | "mobile" | "both";
  law: "linear" | "logarithmic";
  rule: "face_centre" | "cut_faces";
  reach_mm: number;
  fixed: StoredSurface;
  mobile: StoredSurface;
}

export interface StoredPose {
  name: string;
  coordinates_deg: [number, number, number];
  pose: number[];
  in_contact: boolean;
  contact_point_mm: [number, number, number] | null;
  fixed_gaps: string;
  mobile_gaps: string;
}

export interface Recorded {
  name: string;
  axis: "time_s" | "frame";
  times_s: string;
  coordinates_deg: string;
  coordinates_mm: string;
  poses: string;
  curves: { name: string; unit: string; values: string }[];
}

type Three = [number, number, number];

/// The shape of a hip; docs/measures.md. Points of the femur are in M, those of the hip bone in F.
export interface StoredMeasures extends ShapeRecord {
  geometry: {
    neck: { head_centre_mm: Three; direction: Three } | null;
    shaft: { first_mm: Three; last_mm: Three } | null;
    condyles: { medial_mm: Three; lateral_mm: Three } | null;
    rim_plane: { centre_mm: Three; normal: Three; radius_mm: number } | null;
  };
}

export interface EndOfMotion {
  limit_deg: number;
  reason: MotionAnswer["reason"];
}

/// The bone that must go; docs/planning.md. The joint of the page is the one without it.
export interface StoredPlan {
  margin_mm: number;
  targets: {
    motion: string;
    reach_deg: number;
    planned_deg: number;
    before: EndOfMotion;
    after: EndOfMotion;
    blocked: { kept_by: "bearing" | "depth" | "zone" | "marked"; body: "fixed" | "mobile"; point_mm: Three } | null;
  }[];
  cuts: {
    body: "fixed" | "mobile";
    volume_mm3: number;
    least_volume_mm3: number;
    burr_volume_mm3: number;
    area_mm2: number;
    deepest_mm: number;
    deepest_hour: number | null;
  }[];
  limits: { motion: string; before: EndOfMotion; after: EndOfMotion; gain_deg: number }[];
  measures: { key: string; unit: string; before: number | null; after: number | null }[] | null;
  curve: { motion: string; reached_deg: number; volume_mm3: number; deepest_mm: number }[];
  resection_notes: { code: string; text: string }[];
  caveats: string[];
  /// Names of arrays: vertices that were lowered, where they were, and how far below that surface they are.
  surfaces: Record<"fixed" | "mobile", { lowered: string; before: string; depth_mm: string } | null>;
}

/// How far a motion's limit is from that of the joint before; docs/report-data.md.
export interface LimitDifference {
  motion: string;
  /// After minus before; null if neither end is by contact, or one is in contact at the start.
  difference_deg: number | null;
  difference_is: "exact" | "at_least" | "at_most" | null;
  /// The band of the difference, from joints displaced by the same amounts.
  band: Band | null;
  beyond_band: boolean | null;
}

/// The joint before, to which the page's joint is compared.
export interface StoredBefore {
  file: string | null;
  joint: { name: string; fixed: string; mobile: string };
  rom: RomAnswer | null;
  rom_error?: string;
  /// One for each motion; empty if either joint has no limits.
  differences: LimitDifference[];
  /// Names of arrays; null for a body that is the page's own.
  surfaces: Record<"fixed" | "mobile", { vertices: string; triangles: string } | null>;
}

/// A number by which a part turns or shifts; docs/parts.md.
export interface StoredParameter {
  name: string;
  kind: string;
  unit: string;  // "1" of a size
  range: [number, number];
  value: number;
  in_joint_file: number;
  as_given: number;
  sigma: number;
  /// Direction of a translation.
  along: Three;
}

export interface StoredPart {
  name: string;
  body: "fixed" | "mobile";
  /// Names of the meshes that it moves; none of a part that is the whole body.
  meshes: string[];
  centre_mm: Three;
  definition: string;
  is_cut: boolean;
  parameters: StoredParameter[];
}

export interface StoredGivenBody {
  /// Name of an array; null where the drawn vertices are as given.
  as_given: string | null;
  head: { centre_mm: Three; radius_mm: number } | null;
  /// Name of an array: vertices of the head that the joint's centre was fitted to.
  fitted_head: string | null;
  bearing_margin_mm: number | null;
  cut_triangles: number[];
}

/// Parts that turn, and the bodies as they are given.
export interface StoredPosed {
  parts: StoredPart[];
  bearing_margin_mm: number | null;
  fixed: StoredGivenBody;
  mobile: StoredGivenBody;
}

/// Values of one parameter: first, first + step, ...
export interface SweptParameter {
  name: string;
  unit: string;
  first: number;
  last: number;
  step: number;
  count: number;
}

/// Designs of `condyle sweep`, the last parameter fastest; docs/sweeps.md.
export interface StoredSweep {
  parameters: SweptParameter[];
  targets: { name: string; motion: string; reach_deg: number }[];
  designs: number;
  safe_designs: number;
  safe_measure: number;
  window_measure: number;
  best: { values: Record<string, number>; margin_deg: number } | null;
  /// Names of arrays: of each design the margin, NaN of one in contact in its reference pose, and the target that has the least to spare.
  margin_deg: string;
  least_target: string;
  safe: { line: number; low: number; high: number; low_target: number | null; high_target: number | null }[];
  sweep_notes: { code: string; text: string }[];
  caveats: string[];
}

export interface ReportText {
  version: string;
  title: string;
  /// Options of the command line, each null if not given; never taken from the clock.
  case?: string | null;
  note?: string | null;
  date?: string | null;
  joint: {
    name: string;
    kind: "ball" | "hinge" | "free";
    anatomy: "hip" | "knee" | "ankle" | "elbow" | "shoulder";
    side: "right" | "left";
    fixed: string;
    mobile: string;
    translation_frame: "fixed" | "joint_axes";
    /// What a plan did to the bones, if one did.
    planned?: string | undefined;
  };
  coordinates: { name: string; opposite: string }[];
  reference_deg: [number, number, number];
  reference_mm: [number, number, number];
  scope?: string;
  rom: RomAnswer | null;
  rom_error?: string;
  map: MapAnswer | null;
  zones: StoredZone[];
  layers: StoredLayers | null;
  parts: Record<"fixed" | "mobile", Part[]>;
  arrays: Record<string, ArrayPlace>;
  poses: StoredPose[];
  recorded: Recorded | null;
  /// How the joint file reads tables of motions; the core takes it as it is.
  recorded_motion?: { by: "columns" | "poses" | "model" };
  measures: StoredMeasures | null;
  plan: StoredPlan | null;
  /// Set in a report of two joints.
  before?: StoredBefore | null;
  /// Present for a joint with parts that turn.
  posed?: StoredPosed | null;
  sweep?: StoredSweep | null;
  /// Set for a joint file that was read in this page: its tables whose answers take the command.
  only_in_reports?: "contact"[];
  /// And its meshes that were not where it has them, and the dropped files of the same name that were taken.
  taken_by_name?: { mesh: string; taken: string }[];
}

const headBytes = 16;
const magic = "CONDYLE\0";
const elementTypes = {
  f64: Float64Array, u32: Uint32Array, i16: Int16Array, u8: Uint8Array,
};
type Elements = { [T in keyof typeof elementTypes]: InstanceType<(typeof elementTypes)[T]> };

/// Scope: what the joint's answers cover and what they exclude.
export function scopeOf({ scope, rom }: ReportText): string | null {
  return scope ?? rom?.scope ?? null;
}

/// A data block: its text, and arrays by name.
export class Report {
  private constructor(readonly text: ReportText, private readonly arrays: ArrayBuffer) {}

  /// Throws ReportError for a block that is damaged.
  static async read(base64: string): Promise<Report> {
    let block: ArrayBuffer;
    try {
      block = await inflated(bytesOf(base64), "deflate");
    } catch {
      throw new ReportError(words.damaged + words.notCompressed);
    }
    return Report.of(block);
  }

  /// The same of a block that is not compressed.
  static of(block: ArrayBuffer): Report {
    const bytes = new Uint8Array(block);
    if (bytes.length < headBytes || new TextDecoder().decode(bytes.subarray(0, magic.length)) !== magic)
      throw new ReportError(words.damaged + words.wrongMagic);
    const head = new DataView(block);
    const version = head.getUint32(8, true);
    if (version !== 1) throw new ReportError(words.damaged + words.wrongVersion(version));
    const textEnd = headBytes + head.getUint32(12, true);
    if (textEnd > bytes.length) throw new ReportError(words.damaged + words.truncated);
    const text = checkedText(new TextDecoder().decode(bytes.subarray(headBytes, textEnd)));
    const report = new Report(text, block.slice(textEnd));
    for (const { type, offset, length } of Object.values(text.arrays))
      if (offset + length * elementTypes[type].BYTES_PER_ELEMENT > report.arrays.byteLength)
        throw new ReportError(words.damaged + words.truncated);
    return report;
  }

  /// The array of that name and type, a copy.
  array<T extends keyof Elements>(name: string, type: T): Elements[T] {
    const place = this.text.arrays[name];
    if (place === undefined || place.type !== type) throw new ReportError(words.damaged + name);
    const Type = elementTypes[type];
    return new Type(this.arrays.slice(place.offset, place.offset + place.length * Type.BYTES_PER_ELEMENT)) as Elements[T];
  }
}
