import type { StoredMeasures } from "../report";
import type { BodyName } from "./body_names";

/// Lines and points drawn on a body, in its frame; x, y and z of each point in turn.
export interface Marks {
  body: BodyName;
  colour: string;
  /// Two points for each line.
  lines: number[];
  points: number[];
}

const blue = "#0072b2", vermilion = "#d55e00", grey = "#6e6e6e", green = "#009e73";
const axisBehind_mm = 30, axisAhead_mm = 50, normal_mm = 25, ringSteps = 144;

type Three = readonly [number, number, number];

function along(from: Three, direction: Three, mm: number): number[] {
  return from.map((value, i) => value + mm * direction[i]!);
}

function cross(a: readonly number[], b: readonly number[]): number[] {
  return [0, 1, 2].map((i) => a[(i + 1) % 3]! * b[(i + 2) % 3]! - a[(i + 2) % 3]! * b[(i + 1) % 3]!);
}

function unit(v: readonly number[]): number[] {
  const length = Math.hypot(...v);
  return v.map((value) => value / length);
}

/// The axes and points of the measures, as `condyle picture --measures` draws them: the neck's axis and where alpha angles are read; the shaft's
/// axis and the condyles; the rim and its plane.
export function measureMarks({ around_neck, rim, geometry }: StoredMeasures): Marks[] {
  const { neck, shaft, condyles, rim_plane } = geometry;
  const femur = (colour: string, lines: number[], points: number[] = []): Marks => ({ body: "mobile", colour, lines, points });
  const socket = (colour: string, lines: number[], points: number[]): Marks => ({ body: "fixed", colour, lines, points });
  const rimPoints = (inPlane: boolean) => rim.flatMap(({ point_mm, is_in_plane }) => (point_mm && is_in_plane === inPlane ? point_mm : []));
  const marks = [
    femur(green, [], around_neck.flatMap(({ alpha_point_mm }) => alpha_point_mm ?? [])),
    socket(vermilion, rim_plane ? planeLines(rim_plane) : [], rimPoints(true)), socket(grey, [], rimPoints(false)),
  ];
  if (neck)
    marks.push(femur(blue, [
      ...along(neck.head_centre_mm, neck.direction, -axisBehind_mm), ...along(neck.head_centre_mm, neck.direction, axisAhead_mm),
    ]));
  if (shaft) marks.push(femur(blue, [...shaft.first_mm, ...shaft.last_mm]));
  if (condyles) marks.push(femur(blue, [...condyles.medial_mm, ...condyles.lateral_mm]));
  return marks;
}

/// The rim's circle and its normal.
function planeLines({ centre_mm, normal, radius_mm }: { centre_mm: Three; normal: Three; radius_mm: number }): number[] {
  const x = unit(cross(normal, Math.abs(normal[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0])), y = cross(normal, x);
  const at = (step: number) => {
    const turn = (2 * Math.PI * step) / ringSteps;
    return centre_mm.map((value, i) => value + radius_mm * (Math.cos(turn) * x[i]! + Math.sin(turn) * y[i]!));
  };
  const ring = Array.from({ length: ringSteps }, (_, step) => [...at(step), ...at(step + 1)]).flat();
  return [...ring, ...centre_mm, ...along(centre_mm, normal, normal_mm)];
}
