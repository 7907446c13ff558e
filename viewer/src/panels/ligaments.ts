import type { LigamentShown } from "../core/protocol";
import { named } from "../dom";
import { fixed } from "../numbers";
import { words } from "../words";
import { table } from "./table";

/// Each ligament at the pose shown.
export function ligamentTable(ligaments: readonly LigamentShown[]): HTMLElement {
  const text = (value: number | null, digits: number) => (value === null ? "–" : fixed(value, digits));
  return table([words.ligament, words.ligamentState, words.ligamentLength, words.strain, words.tension], ligaments.map(({ name, is, length_mm, strain, tension_n }) => [
    named(name), words.stretches[is], text(length_mm, 1), text(strain && 100 * strain, 1), text(tension_n, 1),
  ]), words.ligaments);
}
