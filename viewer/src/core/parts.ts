import type { PosedArrays } from "./protocol";
import type { Memory } from "./joint";

/// Describes the parts of a joint to the core: viewer/core/page_parts.hpp.
export function describeParts(memory: Memory, joint: number, { parts, fixed, mobile, bearingMargin_mm }: PosedArrays): void {
  const { core } = memory;
  for (const [ofFixed, { meshes, vertices, head, fittedHead, margin_mm }] of [mobile, fixed].entries()) {
    for (const { name, contact, place } of meshes) memory.call(core._condyle_body_mesh, joint, ofFixed, name, contact, place);
    memory.call(core._condyle_body_given, joint, ofFixed, vertices, head, fittedHead, fittedHead?.length ?? 0, margin_mm ?? NaN);
  }
  for (const { name, body, definition, centre_mm, meshes, parameters } of parts) {
    memory.call(core._condyle_part, joint, name, body === "fixed" ? 1 : 0, definition, centre_mm);
    for (const mesh of meshes) memory.call(core._condyle_part_mesh, joint, mesh);
    for (const { name: parameter, kind, range, value, in_joint_file, as_given, sigma, along } of parameters)
      memory.call(core._condyle_parameter, joint, parameter, kind, [...range, value, in_joint_file, as_given, sigma, ...along]);
  }
  memory.call(core._condyle_parts, joint, bearingMargin_mm ?? NaN);
}
