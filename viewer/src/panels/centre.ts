import type { CoreClient } from "../core/client";
import type { LiveLimit } from "../core/protocol";
import { button, html, section } from "../dom";
import type { ReportText } from "../report";
import { words } from "../words";
import { NumberField } from "./angle_field";
import { liveEdit } from "./live_edit";
import { LiveLimits, questionsOf } from "./live_limits";

const farthest_mm = 5, step_mm = 0.5;
const axes = ["x", "y", "z"] as const;

/// Moves the joint centre by hand: how far limits change if it is moved by some millimetres. The page's joint stays about the centre that it has.
export class CentrePanel {
  readonly element: HTMLElement;
  private readonly limits: LiveLimits;
  private readonly edit: () => void;
  private readonly fields: NumberField[];
  private readonly refusal = html("p", { role: "status", class: "small" });
  private readonly offset: [number, number, number] = [0, 0, 0];

  /// `moved` whether the centre is elsewhere than in the report.
  constructor(core: CoreClient, text: ReportText, private readonly moved: (isMoved: boolean) => void) {
    const asked = questionsOf(text), motions = asked.map(({ motion }) => motion);
    this.edit = liveEdit(core, asked.map(({ question }) => question), {
      edit: () => ({ of: "centre", offset_mm: [...this.offset], reference_deg: text.reference_deg }),
      tables: () => [this.limits],
      edited: () => undefined,
      shown: (took_ms, rests) => {
        if (rests) this.element.dataset["allAfter"] = took_ms.toFixed(1);
      },
      failed: (message) => (this.refusal.textContent = message),
    });
    this.limits = new LiveLimits(words.centreLimits, words.centreChange, motions);
    this.fields = axes.map((axis, i) => new NumberField(
      words.centreAlong[axis], -farthest_mm, farthest_mm, step_mm, " mm", false, (mm) => this.move(i, mm), (why) => (this.refusal.textContent = why ?? "")));
    this.element = section(words.centre, html("p", { class: "small" }, words.centreHelp),
      ...axes.map((axis, i) => this.row(i, words.centreAlong[axis])),
      html("div", { class: "row no-print" }, button(words.centreReset, () => this.reset()), this.refusal), this.limits.element);
  }

  /// The joint itself is another one now, with these limits.
  setBefore(limits: readonly LiveLimit[]): void {
    const isMoved = this.offset.some((mm) => mm !== 0);
    limits.forEach((limit, i) => {
      this.limits.setBefore(i, limit);
      if (!isMoved) this.limits.showLimit(i, limit);
    });
    if (isMoved) this.ask();
  }

  private row(i: number, label: string): HTMLElement {
    const field = this.fields[i]!, axis = label.replace(/, mm$/, "");
    const step = (sign: number) => button(
      `${sign > 0 ? "+" : "\u2212"}${step_mm}`, () => this.step(i, sign * step_mm), { "aria-label": words.centreStep(axis.toLowerCase(), `${sign > 0 ? "+" : "\u2212"}${step_mm}`) });
    return html("div", { class: "row no-print centre-row" }, html("span", { "aria-hidden": "true" }, label), step(-1), field.input, step(1));
  }

  private step(i: number, by: number): void {
    const mm = Math.min(farthest_mm, Math.max(-farthest_mm, this.offset[i]! + by));
    this.fields[i]!.show(mm);
    this.move(i, mm);
  }

  private reset(): void {
    this.offset.fill(0);
    for (const field of this.fields) field.show(0);
    this.ask();
  }

  private move(i: number, mm: number): void {
    this.offset[i] = mm;
    this.ask();
  }

  private ask(): void {
    this.moved(this.offset.some((mm) => mm !== 0));
    this.edit();
  }
}
