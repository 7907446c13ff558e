export const bodyNames = ["fixed", "mobile"] as const;
export type BodyName = (typeof bodyNames)[number];

export function otherThan(body: BodyName): BodyName {
  return body === "fixed" ? "mobile" : "fixed";
}
