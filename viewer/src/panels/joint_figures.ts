import type { CoreClient } from "../core/client";
import type { JointArrays } from "../core/protocol";
import { section } from "../dom";
import { clockDrawing } from "../plots/clock";
import { figure } from "../plots/figure";
import { socketPicture } from "../plots/socket";
import { plateauOf, type Plateau } from "../plots/plateau";
import type { MotionAnswer, ReportText } from "../report";
import { hasLimits } from "../result";
import { words } from "../words";
import { figuresPanel } from "./figures";
import { MapSection } from "./map_section";
import type { MotionPanel } from "./motion";

/// So wide the clock's dial is about a head.
const aroundHead = 1.15;

/// Figures of a joint: the surface that carries its load, its recorded motion, its map and its clock.
export class JointFigures {
  readonly element: HTMLElement;
  readonly plateau: Plateau | null;
  readonly map: MapSection | null;

  /// `recorded` is the panel of the recorded motion; `core` answers if the page computes.
  constructor(
    text: ReportText, arrays: JointArrays, motion: MotionPanel, recorded: HTMLElement | null, computes: boolean, core: () => CoreClient | null) {
    const { rom, map, joint } = text;
    const go = computes || text.poses.length ? (to: MotionAnswer) => motion.goToEnd(to) : null;
    const head = rom?.clock_plane !== "rim" && rom?.bearing?.head;
    const socket = head ? socketPicture(arrays.fixed, head.radius_mm * aroundHead, joint.side === "left" ? -1 : 1) : null;
    const clock = rom && clockDrawing(rom.motions, rom.clock_plane, go, socket), clockPlace = clock && section(words.clock, figure(clock));
    clockPlace?.classList.add("of-report");
    this.plateau = computes ? plateauOf(text, arrays) : null;
    this.map = joint.kind !== "hinge" && (map || (computes && hasLimits(text))) ? new MapSection(text, motion, computes, core) : null;
    this.element = figuresPanel([
      { key: "map", parts: this.map ? [this.map.element] : [] },
      { key: "clock", parts: clockPlace ? [clockPlace] : [] },
      { key: "curves", parts: [...(this.plateau ? [this.plateau.element] : []), ...(recorded ? [recorded] : [])] },
    ].filter(({ parts }) => parts.length > 0));
  }
}
