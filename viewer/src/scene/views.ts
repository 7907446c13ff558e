/// Directions from which the joint is viewed, in the joint frame: X anterior, Y superior, Z right. The names are those of `condyle picture`.

export type Three = readonly [number, number, number];

/// Towards the viewer, by the views with buttons on the page.
export const viewDirections = {
  anterior: [1, 0, 0], posterior: [-1, 0, 0], superior: [0, 1, 0], inferior: [0, -1, 0], right: [0, 0, 1], left: [0, 0, -1],
} as const;
export type View = keyof typeof viewDirections;

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
