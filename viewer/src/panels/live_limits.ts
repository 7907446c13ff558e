import type { LimitQuestion, LiveLimit } from "../core/protocol";
import { named } from "../dom";
import { fixed } from "../numbers";
import type { EndOfMotion, MotionAnswer, ReportText } from "../report";
import { cannotBegin, endText } from "../result";
import { motionName, words } from "../words";
import { table } from "./table";

/// The motions of a report as the core is asked for their ends.
export function questionsOf({ rom, coordinates, reference_mm, joint }: ReportText): { motion: MotionAnswer; question: LimitQuestion }[] {
  const held = rom?.held_translation_mm ?? (joint.kind === "free" ? reference_mm : undefined);
  return (rom?.motions ?? []).filter(({ reason }) => !cannotBegin(reason)).map((motion) => ({
    motion,
    question: {
      start: coordinates.map(({ name }) => motion.start_deg[name] ?? 0) as [number, number, number], ...(held ? { held } : {}),
      vary: coordinates.findIndex(({ name }) => name === motion.vary), positive: motion.sense === "positive", range_deg: motion.range_deg,
    },
  }));
}

function endOf({ turned_deg, reason }: LiveLimit): EndOfMotion {
  return { limit_deg: turned_deg, reason };
}

/// "+4.2°", "–" where nothing changes; ">+12.0°" where no bone ends it any more.
function gainText(before: EndOfMotion, after: EndOfMotion): string {
  if (cannotBegin(after.reason)) return "–";
  const gained = after.limit_deg - before.limit_deg, shown = fixed(gained, 1);
  const said = gained > 0 && shown !== "0.0" ? `+${shown}°` : `${shown}°`;
  return before.reason !== "end_of_range" && after.reason === "end_of_range" ? words.over(said) : said;
}

/// Each motion before and after a change.
export class LiveLimits {
  readonly element: HTMLElement;
  private readonly rows: HTMLTableRowElement[];
  private readonly before: EndOfMotion[];

  /// `change` heads what the limits differ by; `before` are the ends before the change, if the motions' own are not.
  constructor(title: string, change: string, motions: readonly MotionAnswer[], before: readonly EndOfMotion[] = motions) {
    this.before = [...before];
    this.element = table(["", words.before, words.after, change], motions.map(({ name }) => [named(motionName(name)), "", "", ""]), title);
    this.element.classList.add("live-limits");
    this.rows = [...this.element.querySelectorAll<HTMLTableRowElement>("tbody tr")];
    motions.forEach((end, i) => this.show(i, end));
  }

  setBefore(i: number, limit: LiveLimit): void {
    this.before[i] = endOf(limit);
  }

  showLimit(i: number, limit: LiveLimit): void {
    this.show(i, endOf(limit));
  }

  private show(i: number, after: EndOfMotion): void {
    const row = this.rows[i]!, before = this.before[i]!;
    [endText(before), endText(after), gainText(before, after)].forEach((text, k) => (row.cells[k + 1]!.textContent = text));
    row.classList.remove("waits");
  }

  /// The values shown belong to an earlier state of the joint.
  wait(): void {
    for (const row of this.rows) row.classList.add("waits");
  }

  mark(chosen: number): void {
    this.rows.forEach((row, i) => (i === chosen ? row.setAttribute("aria-current", "true") : row.removeAttribute("aria-current")));
  }
}
