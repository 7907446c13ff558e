/// Directions from which the joint is viewed, in the joint frame: X anterior, Y superior, Z right. The names and their meaning are those of
/// `condyle picture`: view_named() in src/io/picture/picture.cpp.

export type Three = readonly [number, number, number];
export type Side = "right" | "left";

/// The views with buttons on the page.
const viewDirections = {
  anterior: [1, 0, 0], posterior: [-1, 0, 0], superior: [0, 1, 0], inferior: [0, -1, 0], right: [0, 0, 1], left: [0, 0, -1],
} as const;
export type View = keyof typeof viewDirections;

/// Orthogonal unit vectors.
export interface ViewDirection {
  towardsViewer: Three;
  up: Three;
}

/// "anterior", "medial", or several with hyphens for a view from between: "anterior-superior". Superior is up; in a view along it,
/// anterior is. Throws RangeError.
export function viewNamed(name: string, side: Side): ViewDirection {
  const lateral: Three = [0, 0, side === "right" ? 1 : -1];
  const directions = new Map<string, Three>([...Object.entries(viewDirections), ["lateral", lateral], ["medial", times(-1, lateral)]]);
  let sum: Three = [0, 0, 0];
  for (const part of name.split("-")) {
    const direction = directions.get(part);
    if (!direction) throw new RangeError(name);
    sum = plus(sum, direction);
  }
  if (Math.hypot(...sum) < 0.5) throw new RangeError(name);
  const towardsViewer = unit(sum);
  const upright: Three = Math.abs(towardsViewer[1]) === 1 ? [1, 0, 0] : [0, 1, 0];
  return { towardsViewer, up: unit(plus(upright, times(-dot(upright, towardsViewer), towardsViewer))) };
}

const letters = [["A", "P"], ["S", "I"], ["R", "L"]] as const;
/// An axis whose component along an edge is less than this is not named there.
const leastNamed = 0.4;

/// Letters of a direction in the picture, the axis most along it first: "S", "AR".
export function lettersOf(direction: Three): string {
  const shares = direction.map((share, axis) => ({ share: Math.abs(share), letter: letters[axis]![share < 0 ? 1 : 0] }));
  shares.sort((a, b) => b.share - a.share);
  return shares.filter(({ share }, i) => i === 0 || share >= leastNamed).map(({ letter }) => letter).join("");
}

/// The largest of 1, 2, 5, 10 ... mm that is no longer than this.
export function scaleBarLength(most_mm: number): number {
  const decade = 10 ** Math.floor(Math.log10(most_mm));
  return decade * (most_mm >= 5 * decade ? 5 : most_mm >= 2 * decade ? 2 : 1);
}

function plus(a: Three, b: Three): Three {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}
function times(by: number, a: Three): Three {
  return [by * a[0], by * a[1], by * a[2]];
}
function dot(a: Three, b: Three): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
function unit(a: Three): Three {
  return times(1 / Math.hypot(...a), a);
}
