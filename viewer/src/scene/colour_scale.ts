import { interpolateInferno, interpolateOrRd, interpolateYlGnBu } from "d3-scale-chromatic";
import type { ShownQuantity } from "../core/protocol";

/// Colours of a quantity over mm or MPa, made of sequential scales that the colour blind can distinguish.
///
///     gap, distance   end striped | -end  dark red ... orange | 0 | dark blue ... pale  end | beyond it plain bone
///     depth, pressure, removed bone      0  light ... dark  end | end striped
///
/// A value beyond an end is always distinct from one within: it is striped with the end's colour, or not coloured at all.
export interface ColourScale {
  quantity: Exclude<ShownQuantity, "none">;
  low: number;
  high: number;
  /// Values above `high` need no colour: the bone stays plain.
  plainAbove: boolean;
  /// CSS colour of a value; values beyond an end have its colour.
  colour(amount: number): string;
}

/// The fixed bone's own colour.
export const plainBone = "#e6d9bd";
/// Colours of marks that are not values, distinct from every colour of a scale for all eyes: docs/decisions/0018-the-page.md.
export const contactColour = "#9933ff", zoneColour = "#ff00ff";
/// A scale above which the bone stays plain fades into it from this share of its end on.
export const plainFrom = 0.75;
/// Colour of the stripes over an end's colour.
export const stripeColour = "#ffffff";

export function colourScale(quantity: Exclude<ShownQuantity, "none">, end: number): ColourScale {
  const share = (amount: number) => Math.min(1, Math.max(0, amount / end));
  // The lightest of the sequential map is left out: on a light bone it would be invisible.
  if (quantity !== "gap" && quantity !== "nearest")
    return { quantity, low: 0, high: end, plainAbove: false, colour: (amount) => interpolateInferno(0.85 * (1 - share(amount))) };
  return {
    quantity, low: -end, high: end, plainAbove: true,
    colour: (amount) => (amount < 0 ? interpolateOrRd(0.4 + 0.6 * share(-amount)) : interpolateYlGnBu(1 - 0.9 * share(amount))),
  };
}

/// How much of a value's colour covers the bone: a scale above which it stays plain fades into it.
export function strength({ plainAbove, high }: ColourScale, amount: number): number {
  const past = Math.min(1, Math.max(0, (amount / high - plainFrom) / (1 - plainFrom)));
  return plainAbove ? 1 - past * past * (3 - 2 * past) : 1;
}

/// The swatch of a value beyond the scale; null for one within.
export function beyond(scale: ColourScale, amount: number): "striped" | "plain" | null {
  if (amount > scale.high) return scale.plainAbove ? "plain" : "striped";
  return scale.low < 0 && amount < scale.low ? "striped" : null;
}

/// The numbers in a scale's legend.
export function tickText(amount: number): string {
  return String(Number(amount.toFixed(2))).replace("-", "−");
}

export function rgb(css: string): [number, number, number] {
  const short = /^#(..)(..)(..)$/.exec(css);
  if (short) return [1, 2, 3].map((i) => Number.parseInt(short[i]!, 16)) as [number, number, number];
  return css.match(/\d+/g)!.slice(0, 3).map(Number) as [number, number, number];
}

/// The scale as RGBA bytes, `steps` of them, from low to high.
export function colourTable(scale: ColourScale, steps: number): Uint8Array<ArrayBuffer> {
  const table = new Uint8Array(4 * steps);
  for (let i = 0; i < steps; ++i) {
    const amount = scale.low + ((scale.high - scale.low) * i) / (steps - 1);
    table.set([...rgb(scale.colour(amount)), 255], 4 * i);
  }
  return table;
}
