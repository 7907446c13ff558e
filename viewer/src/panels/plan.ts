import { checkbox, fold, html, named, section } from "../dom";
import { clockTime, fixed } from "../numbers";
import { figure } from "../plots/figure";
import { planCurveDrawing } from "../plots/plan_curve";
import type { Report, StoredPlan } from "../report";
import type { Values } from "../core/protocol";
import { bodyNames, type BodyName } from "../scene/body_names";
import type { JointScene } from "../scene/scene";
import { endText } from "../result";
import { motionName, words } from "../words";
import { measureName } from "./shape";
import { lines, table } from "./table";

/// The targets with their limits before and after, what stands in the way of them, and the bone that goes.
export function planInShort({ targets, cuts, margin_mm }: StoredPlan, names: Record<BodyName, string>): HTMLElement[] {
  const blocked = targets.flatMap(({ motion, planned_deg, blocked: by }) =>
    (by ? [words.blocked(named(motionName(motion)), planned_deg.toFixed(1), words.keptBy[by.kept_by], names[by.body])] : []));
  return [
    table(["", words.before, words.target, words.after], targets.map((target) => [
      named(motionName(target.motion)), endText(target.before), `${Number(target.reach_deg.toFixed(2))}°`, endText(target.after),
    ]), words.targets),
    lines([...targets.map(({ motion, text }) => words.promised(named(motionName(motion)), text)), ...blocked]),
    cuts.length
      ? lines(cuts.map((cut) => words.cut({ ...cut, name: names[cut.body], hour: cut.deepest_hour === null ? null : clockTime(cut.deepest_hour) })))
      : html("p", {}, words.nothingGoes),
    ...(margin_mm > 0 ? [html("p", {}, words.plannedMargin(String(Number(margin_mm.toPrecision(3)))))] : []),
  ];
}

/// The bone that must go: how much, the gain of each motion, and the cost of each degree. The joint of the page is without it.
export class PlanPanel {
  readonly element: HTMLElement;
  /// Its details: all limits, measures that change, notes.
  readonly details: HTMLDetailsElement;
  readonly deepest_mm: number;

  constructor(
    private readonly scene: JointScene | null, private readonly report: Report, private readonly plan: StoredPlan,
    names: Record<BodyName, string>) {
    const { cuts, limits, measures, curve, resection_notes, caveats } = plan;
    this.deepest_mm = Math.max(0, ...cuts.map((cut) => cut.deepest_mm));
    const parts: HTMLElement[] = planInShort(plan, names);
    if (scene && cuts.length)
      parts.push(html("div", { class: "row no-print" }, checkbox(words.showRemoved, false, (on) => this.showRemoved(on))));
    const drawing = planCurveDrawing(curve);
    if (drawing) parts.push(figure(drawing));
    const more: HTMLElement[] = [table(["", words.before, words.after, words.gain], limits.map(({ motion, before, after, gain_deg }) => [
      named(motionName(motion)), endText(before), endText(after), `${fixed(gain_deg, 1)}°`,
    ]), words.limits)];
    const changed = (measures ?? []).filter(({ before, after }) => before?.toFixed(1) !== after?.toFixed(1));
    const text = (value: number | null) => (value === null ? "–" : fixed(value, 1));
    if (changed.length)
      more.push(table(["", words.before, words.after, words.unitHead], changed.map(({ key, unit, before, after }) =>
        [measureName(key, unit), text(before), text(after), unit]), words.measuresThatChange));
    if (resection_notes.length) more.push(html("h3", {}, words.planNotes), lines(resection_notes.map(({ code, text: said }) => `${said} (${code})`)));
    more.push(html("h3", {}, words.readWith), lines(caveats));
    this.details = fold(words.planDetails, false, ...more);
    this.element = section(words.plan, ...parts);
  }

  /// How far each lowered vertex lies below the surface before.
  values(vertexCounts: Record<BodyName, number>): Record<BodyName, Values> {
    const of = (body: BodyName): Values => {
      const values = { shown: new Float32Array(vertexCounts[body]), marks: new Uint8Array(vertexCounts[body]) };
      const cut = this.plan.surfaces[body];
      if (!cut) return values;
      const depths = this.report.array(cut.depth_mm, "f64");
      this.report.array(cut.lowered, "u32").forEach((vertex, i) => {
        values.shown[vertex] = depths[i]!;
        values.marks[vertex] = 1;
      });
      return values;
    };
    return { fixed: of("fixed"), mobile: of("mobile") };
  }

  private showRemoved(on: boolean): void {
    for (const body of bodyNames) {
      const cut = this.plan.surfaces[body];
      this.scene?.annotations.showRemoved(
        body, on && cut ? { vertices: this.report.array(cut.lowered, "u32"), before: this.report.array(cut.before, "f64") } : null);
    }
  }
}
