import type { GivenBody, PosedArrays } from "./protocol";
import type { Memory } from "./joint";

/// Describes the parts of a joint to the core: viewer/core/page_parts.hpp.
export function describeParts(memory: Memory, joint: number, { parts, fixed, mobile, bearingMargin_mm }: PosedArrays): void {
  const { core } = memory;
  givenBody(memory, joint, 1, fixed);
  givenBody(memory, joint, 0, mobile);
  for (const { name, body, definition, centre_mm, meshes, parameters } of parts) {
    within(memory, [name, definition, Float64Array.from(centre_mm)], ([said, by, centre]) =>
      core._condyle_part(joint, said!, body === "fixed" ? 1 : 0, by!, centre!));
    for (const mesh of meshes) within(memory, [mesh], ([said]) => core._condyle_part_mesh(joint, said!));
    for (const { name: parameter, kind, range, value, in_joint_file, as_given, sigma, along } of parameters)
      within(memory, [parameter, kind, Float64Array.of(...range, value, in_joint_file, as_given, sigma, ...along)], ([said, how, numbers]) =>
        core._condyle_parameter(joint, said!, how!, numbers!));
  }
  within(memory, [], () => core._condyle_parts(joint, bearingMargin_mm ?? NaN));
}

function givenBody(memory: Memory, joint: number, ofFixed: number, { meshes, vertices, head, fittedHead, margin_mm }: GivenBody): void {
  const { core } = memory;
  for (const { name, contact, place } of meshes)
    within(memory, [name, contact, place], ([said, means, at]) => core._condyle_body_mesh(joint, ofFixed, said!, means!, at!));
  within(memory, [vertices, head, fittedHead], ([xyz, sphere, fitted]) =>
    core._condyle_body_given(joint, ofFixed, xyz!, sphere!, fitted!, fittedHead?.length ?? 0, margin_mm ?? NaN));
}

/// Calls with copies of these in the core's memory, null of what there is not; throws the core's line.
export function within(memory: Memory, given: readonly (string | Float64Array | Uint32Array | null)[], call: (places: number[]) => number): void {
  const places = given.map((each) => (each === null ? 0 : typeof each === "string" ? memory.copiedText(each) : memory.copied(each)));
  const answer = call(places);
  memory.free(...places.filter((place) => place));
  if (answer < 0) throw memory.error();
}
