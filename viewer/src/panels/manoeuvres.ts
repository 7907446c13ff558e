import { button, html, markCurrent, named, shortened } from "../dom";
import { limitBar, limitRows, mostOf } from "../plots/limits";
import { beforeText } from "../planned";
import type { MotionAnswer, ReportText, RomAnswer } from "../report";
import { bandText, comparedText, deficitOf, limitAlone, zeroOf } from "../result";
import { csv, save } from "../save";
import { motionName, words } from "../words";
import { roving } from "../roving";

const columns = 3;

/// Every motion with where it ends, as a grid to press: the table of limits.
export class ManoeuvreGrid {
  readonly element: HTMLElement;
  private readonly tiles = new Map<string, HTMLButtonElement>();

  constructor(text: ReportText, rom: RomAnswer, go: (motion: MotionAnswer) => void, canGo: (motion: MotionAnswer) => boolean) {
    const { motions } = rom, most = mostOf(motions), zero = zeroOf(rom);
    for (const motion of motions) {
      const before = beforeText(text, motion), isShort = deficitOf(motion) !== null;
      const tile = button("", () => go(motion), { class: "tile", disabled: !canGo(motion), title: words.goThere(named(motionName(motion.name))) });
      tile.classList.toggle("short", isShort);
      const besides = ([["quiet", bandText(motion)], ["tile-normal", comparedText(motion, rom, zero, true)]] as const).filter(([, said]) => said);
      tile.append(
        html("span", { class: "tile-name" }, shortened(named(motionName(motion.name)), 40)), " ",
        html("span", { class: "tile-value" }, ...(before ? [html("span", { class: "quiet" }, before), " "] : []), html("b", {}, limitAlone(motion)),
          ...(isShort ? besides.reverse() : besides).flatMap(([kind, said]) => [" ", html("span", { class: kind }, said)])), limitBar(motion, most));
      this.tiles.set(motion.name, tile);
    }
    const grid = html("div", { class: "tiles", role: "group", "aria-label": words.limits }, ...this.tiles.values());
    roving([...this.tiles.values()], columns);
    this.element = html("div", { class: "manoeuvres" }, grid,
      html("div", { class: "tile-key small" }, html("span", {}, motions.some(({ band }) => band) ? words.tileKey : words.tileKeyNoBand, zero ? ` ${words.tileKeyZero(zero)}` : ""),
        button(words.saveLimits, () => save("limits.csv", "text/csv", csv(limitRows(motions, text.before ?? null))), { class: "quiet-button" })));
  }

  /// The motion at whose end the joint is; null for none.
  mark(motion: MotionAnswer | null): void {
    markCurrent(this.tiles, motion?.name ?? null);
  }
}
