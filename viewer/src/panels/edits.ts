import type { CoreClient } from "../core/client";
import type { Brushed, JointArrays, LiveLimit, Turned } from "../core/protocol";
import { namesOf } from "../dom";
import type { Report, ReportText } from "../report";
import type { BodyName } from "../scene/body_names";
import type { JointScene } from "../scene/scene";
import { words } from "../words";
import { BrushPanel } from "./brush";
import { CentrePanel } from "./centre";
import { questionsOf } from "./live_limits";
import { PartsPanel, type PartsOptions } from "./parts";
import { addPlanPanel, setBlocked } from "./plan_tab";

export interface Edited {
  core: CoreClient;
  scene: JointScene | null;
  text: ReportText;
  arrays: JointArrays;
  /// Holds the arrays of a plan; null for a joint dropped on the page.
  report: Report | null;
  /// A bone has changed, or both bodies have; `rests` once the hand does.
  brushed: (brushed: Brushed, rests: boolean) => void;
  turned: (turned: Turned, rests: boolean, done: string) => void;
  /// The limits of the joint that was changed last, in the order of questionsOf().
  limited: (limits: readonly LiveLimit[]) => void;
}

type Change = "parts" | "brush" | "centre";

/// Panels that change the joint by hand, if limits are exact and no layers lie on the bones.
export function addEditPanels({ core, scene, text, arrays, report, brushed, turned, limited }: Edited): void {
  const { rom, layers, plan, joint, posed } = text;
  if (!rom || rom.exact === false || layers || questionsOf(text).length === 0) return;
  const changes: Record<Change, boolean> = { parts: false, brush: false, centre: false };
  const strokes = { fixed: 0, mobile: 0 };
  /// The parts do not turn while bone is removed or the centre is moved, and the other way round.
  const mark = (what: Change, isChanged: boolean) => {
    if (changes[what] === isChanged || !parts) return;
    changes[what] = isChanged;
    const first = changes.brush ? words.brushFirst : changes.centre ? words.centreFirst : null;
    for (const panel of [parts, parts.sweep]) if (panel) setBlocked(panel.element, first);
    for (const other of [brush, centre]) if (other) setBlocked(other.element, changes.parts ? words.partsFirst : null);
  };
  const parts = posed ? new PartsPanel(core, scene, { text, arrays, posed, sweep: sweepOf(report), turned: (is) => mark("parts", is), changed: turned, limited }) : null;
  const centre = joint.kind === "free" ? null : new CentrePanel(core, text, (is) => mark("centre", is));
  // A brush does not know an implant from bone.
  const brush = rom.implant ? null : new BrushPanel(core, scene, {
    text, arrays, names: namesOf(joint),
    before: { fixed: beforePlan(report, arrays, "fixed"), mobile: beforePlan(report, arrays, "mobile") },
    limitsBefore: new Map((plan?.limits ?? []).map(({ motion, before }) => [motion, before])),
    changed: (bone, rests) => {
      strokes[bone.body] = bone.steps;
      mark("brush", strokes.fixed + strokes.mobile > 0);
      brushed(bone, rests);
    },
    limited: (limits) => {
      centre?.setBefore(limits);
      limited(limits);
    },
  });
  for (const panel of [parts?.sweep, brush, parts, centre]) {
    panel?.element.classList.add("edit-panel");
    if (panel) addPlanPanel(panel.element);
  }
}

/// The surface of a bone before a plan cut it; null for an uncut bone.
function beforePlan(report: Report | null, arrays: JointArrays, body: BodyName): Float64Array | null {
  const cut = report?.text.plan?.surfaces[body];
  if (!cut) return null;
  const xyz = arrays[body].vertices.slice(), before = report.array(cut.before, "f64");
  report.array(cut.lowered, "u32").forEach((vertex, i) => xyz.set(before.subarray(3 * i, 3 * i + 3), 3 * vertex));
  return xyz;
}

export function sweepOf(report: Report | null): PartsOptions["sweep"] {
  const stored = report?.text.sweep;
  return stored ? { stored, margins: report.array(stored.margin_deg, "f64"), least: report.array(stored.least_target, "u8") } : null;
}
