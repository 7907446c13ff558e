import type { LimitQuestion, LiveLimit } from "../core/protocol";
import { html, named } from "../dom";
import { fixed } from "../numbers";
import type { EndOfMotion, MotionAnswer, ReportText } from "../report";
import { endText } from "../result";
import { motionName, words } from "../words";

/// The motions of a report as the core is asked for their ends.
export function questionsOf({ rom, coordinates, reference_mm, joint }: ReportText): { motion: MotionAnswer; question: LimitQuestion }[] {
  const held = rom?.held_translation_mm ?? (joint.kind === "free" ? reference_mm : undefined);
  return (rom?.motions ?? []).filter(({ reason }) => reason !== "contact_at_start").map((motion) => ({
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
  if (after.reason === "contact_at_start") return "–";
  const gained = after.limit_deg - before.limit_deg, shown = fixed(gained, 1);
  const said = gained > 0 && shown !== "0.0" ? `+${shown}°` : `${shown}°`;
  return before.reason === "contact" && after.reason === "end_of_range" ? words.over(said) : said;
}

interface Row {
  before: HTMLTableCellElement;
  after: HTMLTableCellElement;
  gained: HTMLTableCellElement;
  head: HTMLTableRowElement;
}

/// Each motion before and after a change.
export class LiveLimits {
  readonly element: HTMLElement;
  private readonly rows: Row[];
  private readonly before: EndOfMotion[];

  /// `change` heads what the limits differ by, `of` says of what they are.
  constructor(
    title: string, change: string, before: readonly EndOfMotion[], after: readonly EndOfMotion[], motions: readonly MotionAnswer[],
    of: string = words.boneOnly) {
    this.before = [...before];
    const cell = () => html("td", {});
    this.rows = motions.map(({ name }) => {
      const row = { before: cell(), after: cell(), gained: cell() };
      const head = html("tr", {}, html("th", { scope: "row" }, named(motionName(name))), row.before, row.after, row.gained, html("td", { class: "quiet" }, of));
      return { ...row, head };
    });
    this.element = html("div", { class: "scroll live-limits", tabindex: 0, role: "region", "aria-label": title },
      html("table", {}, html("caption", {}, title),
        html("thead", {}, html("tr", {}, html("td"), ...[words.before, words.after, change].map((text) => html("th", { scope: "col" }, text)), html("td"))),
        html("tbody", {}, ...this.rows.map(({ head }) => head))));
    this.showAll(after);
  }

  showAll(after: readonly EndOfMotion[]): void {
    after.forEach((end, i) => this.show(i, end));
  }

  show(i: number, after: EndOfMotion): void {
    const row = this.rows[i]!, before = this.before[i]!;
    row.before.textContent = endText(before);
    row.after.textContent = endText(after);
    row.gained.textContent = gainText(before, after);
    row.head.classList.remove("waits");
  }

  setBefore(i: number, { turned_deg, reason }: LiveLimit): void {
    this.before[i] = { limit_deg: turned_deg, reason };
  }

  showLimit(i: number, limit: LiveLimit): void {
    this.show(i, endOf(limit));
  }

  /// The values shown belong to an earlier state of the joint.
  wait(): void {
    for (const { head } of this.rows) head.classList.add("waits");
  }

  mark(chosen: number): void {
    this.rows.forEach(({ head }, i) => (i === chosen ? head.setAttribute("aria-current", "true") : head.removeAttribute("aria-current")));
  }
}
