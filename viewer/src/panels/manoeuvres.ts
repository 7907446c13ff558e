import { button, html, named, shortened } from "../dom";
import { limitBar, limitRows, mostOf } from "../plots/limits";
import type { MotionAnswer, StoredBefore } from "../report";
import { bandText, deficitOf, limitAlone } from "../result";
import { csv, save } from "../save";
import { motionName, words } from "../words";
import { roving } from "../roving";

const columns = 4;

/// What a motion is compared with, and how much it is short of that.
export function normalText(motion: MotionAnswer): string {
  const { normal_range_deg: clinical, bone_reference: bone } = motion, lacks = deficitOf(motion);
  if (clinical === null && !bone) return "";
  const said = bone ? String(bone.healthy_deg) : clinical!.toFixed(0);
  return lacks !== null ? words.short(lacks.toFixed(0), said) : bone ? words.healthyIs(said) : words.clinicalIs(said);
}

/// Every motion with where it ends, as a grid to press: the table of limits.
export class ManoeuvreGrid {
  readonly element: HTMLElement;
  private readonly tiles = new Map<string, HTMLButtonElement>();

  constructor(motions: readonly MotionAnswer[], go: (motion: MotionAnswer) => void, canGo: (motion: MotionAnswer) => boolean,
    before: StoredBefore | null = null) {
    const most = mostOf(motions);
    for (const motion of motions) {
      const tile = button("", () => go(motion), { class: "tile", disabled: !canGo(motion), title: words.goThere(named(motionName(motion.name))) });
      if (deficitOf(motion) !== null) tile.classList.add("short");
      tile.append(
        html("span", { class: "tile-name" }, shortened(named(motionName(motion.name)), 40)), " ",
        html("span", { class: "tile-value" }, html("b", {}, limitAlone(motion)), " ", html("span", { class: "quiet" }, bandText(motion))), " ",
        limitBar(motion, most), html("span", { class: "tile-normal" }, normalText(motion)));
      this.tiles.set(motion.name, tile);
    }
    const grid = html("div", { class: "tiles", role: "group", "aria-label": words.limits }, ...this.tiles.values());
    roving([...this.tiles.values()], columns);
    this.element = html("div", { class: "manoeuvres" }, grid,
      html("div", { class: "tile-key small" }, html("span", {}, motions.some(({ band }) => band) ? words.tileKey : words.tileKeyNoBand),
        button(words.saveLimits, () => save("limits.csv", "text/csv", csv(limitRows(motions, before))), { class: "quiet-button" })));
  }

  /// The motion at whose end the joint is; null for none.
  mark(motion: MotionAnswer | null): void {
    for (const [name, tile] of this.tiles) {
      if (name === motion?.name) tile.setAttribute("aria-current", "true");
      else tile.removeAttribute("aria-current");
    }
  }
}
