import { named } from "./dom";
import type { MotionAnswer, ReportText } from "./report";
import { endText } from "./result";
import { words } from "./words";

/// What a plan did to the joint of the page: "without 164.1 mm³ of femur"; null for a joint as it was measured.
export function plannedOf({ joint }: ReportText): string | null {
  return joint.planned ? named(joint.planned).replaceAll("mm3", "mm³") : null;
}

/// The limit before the plan, if the page knows it: "now 32.6°".
export function nowOf({ plan }: ReportText, { name }: MotionAnswer): string | null {
  const known = plan?.limits.find(({ motion }) => motion === name);
  return known ? words.nowIs(endText(known.before)) : null;
}
