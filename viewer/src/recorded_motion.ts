import type { MotionFrames } from "./core/protocol";
import type { Recorded, Report, ReportText } from "./report";

/// Frames of a motion that plays, and their curves.
export interface RecordedMotion {
  name: string;
  axis: Recorded["axis"];
  times: Float64Array;
  /// Three angles, three lengths and 16 numbers of X_FM a frame; NaN in a gap.
  angles: Float64Array;
  translations: Float64Array;
  poses: Float64Array;
  curves: { name: string; unit: string; values: Float64Array }[];
}

/// That of a report.
export function recordedOf(report: Report, { name, axis, times_s, coordinates_deg, coordinates_mm, poses, curves }: Recorded): RecordedMotion {
  const array = (key: string) => report.array(key, "f64");
  return {
    name, axis, times: array(times_s), angles: array(coordinates_deg), translations: array(coordinates_mm), poses: array(poses),
    curves: curves.map(({ name: curve, unit, values }) => ({ name: curve, unit, values: array(values) })),
  };
}

const lengths = ["x", "y", "z"];

/// That of a file which the core has read: its curves are the joint's coordinates.
export function droppedMotion(name: string, frames: MotionFrames, { joint, coordinates }: ReportText): RecordedMotion {
  const array = (numbers: (number | null)[]) => Float64Array.from(numbers, (number) => number ?? Number.NaN);
  const angles = array(frames.coordinates_deg), translations = array(frames.coordinates_mm);
  const column = (of: Float64Array, i: number) => of.filter((_, at) => at % 3 === i);
  return {
    name, axis: frames.axis, times: array(frames.times), angles, translations, poses: array(frames.poses),
    curves: [
      ...coordinates.slice(0, joint.kind === "hinge" ? 1 : 3).map((coordinate, i) => ({ name: `${coordinate.name}_deg`, unit: "°", values: column(angles, i) })),
      ...(joint.kind === "free" ? lengths : []).map((axis, i) => ({ name: `${axis}_mm`, unit: "mm", values: column(translations, i) })),
    ],
  };
}
