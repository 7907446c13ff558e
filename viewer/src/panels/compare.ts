import { checkbox, fold, html, named, section } from "../dom";
import { signed } from "../numbers";
import { comparedFiles } from "../planned";
import type { LimitDifference, MotionAnswer, Report, ReportText, StoredBefore } from "../report";
import { bandText, differenceText, limitAlone } from "../result";
import { bodyNames } from "../scene/body_names";
import type { JointScene } from "../scene/scene";
import { motionName, words } from "../words";
import { sourcesOf } from "./numbers";
import { lines, table } from "./table";

const unknown = "–", ghostColour = "#7b3fa0";

/// A number over its band.
function cell(value: string, band: string): string | HTMLElement {
  return band ? html("div", {}, value, " ", html("span", { class: "under-value quiet" }, band)) : value;
}

function limitCell(motion: MotionAnswer | undefined): string | HTMLElement {
  return motion ? cell(limitAlone(motion), bandText(motion)) : unknown;
}

function differenceCells(difference: LimitDifference | undefined, hasBands: boolean): (string | HTMLElement)[] {
  if (!difference) return hasBands ? [unknown, unknown] : [unknown];
  const { band, beyond_band } = difference;
  const meaning = beyond_band === null ? unknown : beyond_band ? words.beyondBand : words.withinBand;
  return [
    cell(differenceText(difference), band ? `(${words.rangeOf(signed(band.p5_deg, 1), signed(band.p95_deg, 1))})` : ""),
    ...(hasBands ? [meaning] : []),
  ];
}

/// Every motion before and after; null if either joint has no limits.
export function comparisonTable({ rom, before }: ReportText): HTMLElement | null {
  if (!rom || !before?.rom) return null;
  const hasBands = before.differences.some(({ band }) => band !== null), then = before.rom.motions;
  const rows = rom.motions.map((motion) => [
    named(motionName(motion.name)), limitCell(then.find(({ name }) => name === motion.name)), limitCell(motion),
    ...differenceCells(before.differences.find((each) => each.motion === motion.name), hasBands),
  ]);
  const made = table(["", words.before, words.after, words.difference, ...(hasBands ? [""] : [])], rows, words.limitsCompared);
  made.classList.add("comparison");
  return made;
}

/// Why either joint, or both, has no limits.
function reasonsOf({ rom, rom_error, before }: ReportText): HTMLElement[] {
  return [
    ...(before && !before.rom ? [html("p", { class: "warning" }, words.noLimitsBefore(before.rom_error ?? ""))] : []),
    ...(rom ? [] : [html("p", { class: "warning" }, words.noLimits + (rom_error ?? ""))]),
  ];
}

/// How differences are judged, and files and notes of the joint before.
function detailsOf({ rom }: StoredBefore): HTMLElement[] {
  const notes = rom?.notes ?? [];
  return [
    html("p", {}, words.bandRule),
    ...(notes.length ? [html("h3", {}, words.notedBefore), lines(notes.map(({ code, text }) => `${text} (${code})`))] : []),
    ...(rom?.provenance ? [html("h3", {}, words.filesBefore), ...sourcesOf(rom.provenance, words.filesBefore)] : []),
  ];
}

/// The joint before a change: its bodies transparent in the scene, and its limits beside those of the page.
export class ComparePanel {
  readonly element: HTMLElement;
  readonly details: HTMLDetailsElement;
  /// Whether the joint before is shown; in a shared link it is one of what is hidden.
  readonly box: HTMLInputElement;

  constructor(
    private readonly scene: JointScene | null, private readonly report: Report, private readonly before: StoredBefore, changed: () => void) {
    const toggle = checkbox(words.showBefore, true, (on) => {
      this.show(on);
      changed();
    });
    this.box = toggle.querySelector("input")!;
    const differs = bodyNames.some((body) => before.surfaces[body] !== null), compared = comparisonTable(report.text);
    const hasBands = before.differences.some(({ band }) => band !== null);
    this.element = section(words.compared,
      html("p", {}, words.comparedWith(comparedFiles(report.text)!)),
      ...(!differs ? [html("p", {}, words.sameBodies)] : scene ? [html("div", { class: "row no-print" }, toggle)] : []),
      ...reasonsOf(report.text), ...(compared ? [compared] : []),
      ...(compared ? [html("p", { class: "small" }, hasBands ? words.bandRuleShort : words.noBand)] : []));
    this.details = fold(words.beforeDetails, false, ...detailsOf(before));
  }

  /// Transparent, if they differ from the page's own.
  show(on: boolean): void {
    for (const body of bodyNames) {
      const stored = this.before.surfaces[body];
      if (stored)
        this.scene?.bodies[body].setGhost("before", on ? {
          vertices: this.report.array(stored.vertices, "f64"), triangles: this.report.array(stored.triangles, "u32"), colour: ghostColour,
        } : null);
    }
  }
}
