import type { RomAnswer } from "../report";

/// What page and worker say to each other; the worker's tasks and queries are in worker.ts and queries.ts, and their types with them.

export type Quantity = "gap" | "depth" | "nearest" | "pressure" | "none";
/// With the quantity of a plan, which the report holds.
export type ShownQuantity = Quantity | "removed";
/// Numbers of the quantities that condyle_shown() gives.
export const quantityNumber = { gap: 0, depth: 1, nearest: 2 } as const;

export interface Surface {
  vertices: Float64Array;
  triangles: Uint32Array;
}

export interface JointArrays {
  kind: number;
  anatomy: number;
  side: number;
  translationFrame: number;
  fixed: Surface;
  mobile: Surface;
  /// Contact that ends motions: "found" by the core, every contact, or all but that of these mobile triangles, marked
  /// 1.
  bearing: "found" | { counts: boolean; fixed: Uint8Array | null; mobile: Uint8Array | null };
  layers: Layers | null;
  /// Parts that turn; null of a joint without any.
  posed: PosedArrays | null;
  /// Tables of ligaments as a joint file has them, in mm; null of a joint without any.
  ligaments: string | null;
}

/// Parts of a joint and its bodies as they are given, as page_parts.hpp takes them: texts, and arrays that are null as in the drawn body, or not known.
export interface PosedArrays {
  text: string;
  fixed: GivenBody;
  mobile: GivenBody;
}

export interface GivenBody {
  text: string;
  vertices: Float64Array | null;
  fittedHead: Uint32Array | null;
}

/// The part of a body that carries load; rigid without a layer.
export interface LoadedSurface {
  firstVertex: number;
  vertices: number;
  firstTriangle: number;
  triangles: number;
  layer: { youngsModulus_mpa: number; poissonRatio: number; thickness_mm: Float64Array } | null;
}

/// Numbers as condyle_elastic() takes them.
export interface Layers {
  casting: number;
  law: number;
  rule: number;
  reach_mm: number;
  fixed: LoadedSurface;
  mobile: LoadedSurface;
}

/// Values of a body's vertices, for colours: mm or MPa, and per vertex 0 nothing, 1 the value, 2 a bound.
export interface Values {
  shown: Float32Array;
  marks: Uint8Array;
}

export interface BothValues {
  mobile: Values;
  fixed: Values;
}

export interface Coordinates {
  angles: [number, number, number];
  translation: [number, number, number];
}

/// Answer of `condyle depth` at a pose. `about`: the axis, in the joint's order, whose arc is the depth; null along
/// the ray.
export interface Depth {
  inContact: boolean;
  deepest: {
    depth_mm: number;
    about: number | null;
    depth_deg: number | null;
    body: "mobile" | "fixed";
    vertex: number;
    point: [number, number, number];
    nearest_mm: number;
  } | null;
  withoutDepth: number;
  area_mm2: { mobile: number | null; fixed: number | null };
  volume_mm3: number | null;
  volumeError_mm3: number | null;
  coveredAgain_mm3: number | null;
}

/// A movement as one screw motion, and how far the mobile body must turn about its axis to be free: docs/motion-files.md. The axis is null if
/// the movement slides or turns by half a turn, depths if no rotation frees the bodies.
export interface Screw {
  slides: boolean;
  axis: { direction: number[]; point: number[] } | null;
  depth_deg: number | null;
  depth_mm: number | null;
}

/// Where the surfaces are nearest to each other; the point is the fixed body's, in F.
export interface Nearest {
  distance_mm: number;
  triangle: { fixed: number; mobile: number };
  /// Whether contact there would end no motion.
  isBearing: boolean;
  point: [number, number, number];
}

/// Results at one pose.
export interface Shown {
  pose: Float64Array;
  inContact: boolean;
  /// How many of a body's vertices are in the other one.
  inside: { mobile: number; fixed: number };
  pairs: Uint32Array;
  ligaments: LigamentShown[];
}

/// A ligament at a pose: numbers are null where its length is not known; a thin tube along its path in F. docs/ligaments.md.
export interface LigamentShown {
  name: string;
  is: "slack" | "taut" | "at_end" | "unknown";
  length_mm: number | null;
  strain: number | null;
  tension_n: number | null;
  vertices: number[];
  triangles: [number, number, number][];
}

/// What a pose is to the limits, by the rule of `condyle depth`. At a limit: by which angle, at which of its ends, and whether a ligament makes it.
export interface Standing {
  is: "free" | "at_limit" | "bearing" | "impinging" | "strained" | "contact";
  vary: number;
  isHigh: boolean;
  byLigament: boolean;
}

/// An angle turned from a pose until contact or the end of a ligament.
export interface LiveLimit {
  vary: number;
  positive: boolean;
  turned_deg: number;
  reason: "contact" | "end_of_range" | "contact_at_start" | "ligament" | "strained_at_start";
  kind: "unknown" | "bearing" | "impingement" | "cut";
  bearing_deg: number | null;
  point: [number, number, number] | null;
  /// The one that ends it.
  ligament: string | null;
}

/// `held` in F, mm: what the mobile body keeps while it turns.
export interface MapQuestion {
  held?: [number, number, number];
  columnAngle: number;
  rowAngle: number;
  vary: number;
  columns: number[];
  rows: number[];
}

/// The vertices that are not outside at a pose, and their radial depths.
export interface Penetrations {
  vertices: Uint32Array;
  depths_mm: Float64Array;
}

export interface BothPenetrations {
  mobileInFixed: Penetrations;
  fixedInMobile: Penetrations;
}

/// The results of a pose that scripts read.
export interface Details extends BothPenetrations {
  pose: Float64Array;
  inContact: boolean;
  pairs: Uint32Array;
}

export interface LimitQuestion {
  start: [number, number, number];
  held?: [number, number, number];
  vary: number;
  positive: boolean;
  range_deg: number;
}

/// A path of the brush over a bone: condyle/brush.hpp.
export interface Stroke {
  action: "lower" | "restore";
  /// Vertices of the bone.
  along: number[];
  radius_mm: number;
  depth_mm: number;
}

/// A change of the joint by hand. A bone is made ready once, with where its surface was before a cut, if there is one; a stroke replaces
/// the last one while the hand draws it. A centre is moved along the axes of F, the bones standing as the reference pose has them. Parts are
/// turned to these values, as `--set` takes them; those that are not named stand as in the report.
export type Edit =
  | { of: "brush"; body: "fixed" | "mobile"; before: Float64Array | null }
  | { of: "stroke"; body: "fixed" | "mobile"; stroke: Stroke; replaces: boolean }
  | { of: "undo"; body: "fixed" | "mobile" }
  | { of: "centre"; offset_mm: [number, number, number]; reference_deg: [number, number, number] }
  | { of: "parts"; values: string };

/// The vertices of both bodies where their parts have them.
export interface Turned {
  fixed: Float64Array;
  mobile: Float64Array;
}

/// A bone as its brush has left it.
export interface Brushed {
  body: "fixed" | "mobile";
  vertices: Float64Array;
  /// Distance of each vertex from the surface before.
  depths_mm: Float64Array;
  volume_mm3: number;
  deepest_mm: number;
  /// Mean length of the edges: a cut is no finer.
  edge_mm: number;
  /// How many strokes can be undone.
  steps: number;
  /// Vertices that no stroke moves.
  protectedVertices: number;
  /// Vertices of the last stroke that moved, that must stay, and that are less deep than requested.
  outcome: { moved: number; kept: number; limited: number } | null;
}

/// The answer of condyle_motion() on a motion file; null in a gap.
export interface MotionFrames {
  axis: "time_s" | "frame";
  times: number[];
  coordinates_deg: (number | null)[];
  coordinates_mm: (number | null)[];
  poses: (number | null)[];
  remarks: string[];
}

/// A mesh file and its name, whose extension gives the format.
export interface DroppedFile {
  name: string;
  bytes: ArrayBuffer;
}

/// A file of a drop, not read yet, and its path in the folder that was dropped, or its name.
export interface NamedFile {
  path: string;
  file: File;
}

/// The side of the joint of two files: inferred from their bones, or given.
export type SideChoice = "automatic" | "right" | "left";

/// The joint that was proposed for two files.
export interface Proposal {
  joint: JointArrays;
  /// Limits in a report's form; `caveats` are the evidence that the joint was inferred from.
  rom: RomAnswer;
  /// Their names on the page.
  bodies: { fixed: string; mobile: string };
}

/// The list of condyle_labels() for a label map, and the name of its file.
export interface LabelMap {
  name: string;
  labels: { choice: string; name: string; voxels: number }[];
  pairs: { side: "right" | "left"; task: string | null; fixed: NamedLabel; mobile: NamedLabel }[];
}

export interface NamedLabel {
  label: string;
  choice: string;
}

/// A label as condyle_bone() takes it, of one of the label maps by its number.
export interface BoneChoice {
  map: number;
  label: string;
  task: string | null;
}

/// From the worker: a call of what listens to the answer of this number, `done` or `failed` at last; of number 0 it is the page.
export interface FromWorker {
  id: number;
  say: string;
  args: unknown[];
}
