import type { CoreJoint } from "./joint";
import type { Coordinates, DroppedFile, LimitQuestion, MapQuestion, Quantity } from "./protocol";

/// Single queries by their names, which scripts ask too: docs/report-data.md.
export const queries = {
  pose: (joint: CoreJoint, { at }: { at: Coordinates }) => joint.details(at),
  /// 16 numbers, row by row.
  poseMatrix: (joint: CoreJoint, { X_FM }: { X_FM: number[] }) => joint.details(X_FM),
  /// Each ligament of the joint file, with a tube along its path.
  ligaments: (joint: CoreJoint, { at }: { at: Coordinates }) => joint.ligamentsAt(at),
  depth: (joint: CoreJoint, { at }: { at: Coordinates }) => joint.depth(at),
  /// The movement from one pose to another as a screw, and the depth about its axis.
  screw: (joint: CoreJoint, { before, at }: { before: Coordinates; at: Coordinates }) => joint.screw(before, at),
  /// The whole surfaces, or, if `counted`, the parts whose contact ends motions.
  nearest: (joint: CoreJoint, { at, counted }: { at: Coordinates; counted: boolean }) => joint.nearest(at, counted),
  /// Both bodies' vertices inside, without the other results of a pose.
  penetrations: (joint: CoreJoint, { at }: { at: Coordinates }) => joint.penetrationsAt(at),
  values: (joint: CoreJoint, { at, quantity }: { at: Coordinates; quantity: Exclude<Quantity, "none"> }) => joint.values(at, quantity),
  /// What the pose is to the limits; `held` in F, mm.
  standing: (joint: CoreJoint, { angles, held }: { angles: number[]; held: number[] }) => joint.standing(angles, held),
  limit: (joint: CoreJoint, { limit }: { limit: LimitQuestion }) => joint.limit(limit),
  mapPoint: (joint: CoreJoint, { question, point }: { question: MapQuestion; point: number }) => joint.mapPoint(question, point),
  /// The frames of a motion file, whose columns are as the data block says, or empty.
  motion: (joint: CoreJoint, { file, columns }: { file: DroppedFile; columns: string }) => joint.motion(file, columns),
  /// Bytes that the core has taken.
  memory: (joint: CoreJoint, _: object) => joint.memory_bytes,
};

type Queries = typeof queries;
export type QueryName = keyof Queries;
export type Query<Of extends QueryName = QueryName> = { [Name in Of]: { of: Name } & Parameters<Queries[Name]>[1] }[Of];
export type QueryAnswer<Of extends QueryName> = ReturnType<Queries[Of]>;
