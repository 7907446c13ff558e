import type { Answers, EditAnswers } from "./client";
import { lineOf } from "./error_line";
import { CoreJoint } from "./joint";
import { blockOfJoint } from "./joint_file";
import { CoreLabels } from "./labels";
import { openness } from "./openness";
import type { BoneChoice, Coordinates, DroppedFile, Edit, FromWorker, JointArrays, LimitQuestion, MapQuestion, NamedFile, Quantity, SideChoice } from "./protocol";
import { queries, type Query } from "./queries";

/// Answers in the order of visible effect: changes by hand, the pose, limits after the last change, then the pose's colours, its depth, then
/// all else. A message that arrives meanwhile comes in between; pending answers about an earlier pose are dropped. All limits after a change
/// come before the next change.

type Queue = (() => void)[];

let joint: CoreJoint | null = null;
let labels: CoreLabels | null = null;
const edits: Queue = [], poses: Queue = [], afterEdit: Queue = [], afterwards: Queue = [];
let aboutPose: Queue = [];
/// What only makes the picture better: a piece of it while nothing is to be answered.
let light: Generator<void> | null = null;

/// What listens in the page, as if it were here. Arrays go there without a copy.
function listener<On extends object>(id: number): On {
  return new Proxy({}, {
    get: (_, say: string) => (...args: unknown[]) =>
      (self as unknown as DedicatedWorkerGlobalScope).postMessage({ id, say, args } satisfies FromWorker, [...new Set(buffersIn(args))]),
  }) as On;
}
const page = listener<Answers>(0);

function buffersIn(value: unknown): ArrayBuffer[] {
  if (value instanceof ArrayBuffer) return [value];
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  return typeof value === "object" && value !== null ? Object.values(value).flatMap(buffersIn) : [];
}

/// The worker's own turn of the event loop: a message waits no longer than one piece of work.
const turns = new MessageChannel();
let isTurnAsked = false;
turns.port1.onmessage = () => {
  isTurnAsked = false;
  const work = (afterEdit.length ? undefined : edits.shift()) ?? poses.shift() ?? afterEdit.shift() ?? aboutPose.shift() ?? afterwards.shift();
  try {
    if (work) work();
    else if (light?.next().done) light = null;
  } catch (error) {
    page.failed(lineOf(error));
  }
  if (work || light) soon();
};
function soon(): void {
  if (!isTurnAsked) turns.port2.postMessage(null);
  isTurnAsked = true;
}

/// The result of work once it is its turn.
function inTurn<Result>(queue: Queue, work: () => Result | Promise<Result>): Promise<Result> {
  soon();
  return new Promise((done, failed) => queue.push(() => {
    try {
      done(work());
    } catch (error) {
      failed(error as Error);
    }
  }));
}

function* lightOf(bones: CoreJoint): Generator<void> {
  for (const [ofFixed, body] of (["mobile", "fixed"] as const).entries()) page.openness(body, yield* openness(bones.surface(ofFixed)));
}

/// By their names; what is given back ends the task, and `on` hears of its parts before. Those of the first block come before there is a joint.
const tasks = {
  open: async ({ wasm, arrays }: { wasm: ArrayBuffer; arrays: JointArrays }) => {
    joint = await CoreJoint.open(wasm, arrays);
  },
  /// The joint that is proposed for two files.
  propose: async ({ wasm, fixed, mobile, side }: { wasm: ArrayBuffer; fixed: DroppedFile; mobile: DroppedFile; side: SideChoice }) => {
    const made = await CoreJoint.propose(wasm, fixed, mobile, side);
    joint = made.joint;
    return made.proposal;
  },
  /// The data block of a joint file and of what was dropped with it, as a report has it.
  jointFile: ({ wasm, file, files }: { wasm: ArrayBuffer; file: NamedFile; files: readonly NamedFile[] }) => blockOfJoint(wasm, file, files),
  /// A label map, with the module for the first one.
  labels: async ({ wasm, file }: { wasm: ArrayBuffer | null; file: DroppedFile }) => (labels ??= await CoreLabels.open(wasm!)).read(file),
  /// The joint of two bones of the label maps, which stay if it fails. `step` hears of the surface that is next, then with null of the joint.
  join: ({ fixed, mobile, side }: { fixed: BoneChoice; mobile: BoneChoice; side: SideChoice }, on: { step: (label: string | null) => void }) => {
    const made = labels!.join(fixed, mobile, side, on.step);
    joint = made.joint;
    labels = null;
    return made.proposal;
  },

  pose: ({ at, quantity }: { at: Coordinates; quantity: Quantity }) => inTurn(poses, () => {
    aboutPose = [];
    const shown = joint!.shown(at);
    if (quantity !== "none") aboutPose.push(() => page.values(joint!.values(at, quantity)));
    // Last: it takes longest.
    if (shown.inContact) aboutPose.push(() => page.depth(joint!.depth(at)));
    return shown;
  }),
  query: (query: Query) => inTurn(afterwards, () => (queries[query.of] as (joint: CoreJoint, query: Query) => unknown)(joint!, query)),
  /// The limits are those after the edit, in this order.
  edit: ({ edit, limits }: { edit: Edit; limits: LimitQuestion[] }, on: EditAnswers) => {
    light = lightOf(joint!);
    return inTurn(edits, async () => {
      on.edited(joint!.edit(edit));
      const about = edit.of === "centre" && edit.offset_mm.some((mm) => mm !== 0);
      await Promise.all(limits.map((question, number) => inTurn(afterEdit, () =>
        on.limit(number, about ? joint!.limitAbout(question) : joint!.limit(question)))));
    });
  },
  bearing: (_: object) => inTurn(afterwards, () => page.bearing(joint!.bearing())),
  /// How open the surfaces are, once nothing else is to be answered, and again after each edit.
  openness: (_: object) => {
    light = lightOf(joint!);
    soon();
  },
  map: async (question: MapQuestion) => {
    const points = Array.from({ length: question.columns.length * question.rows.length }, (_, point) =>
      inTurn(afterwards, () => page.mapPoint(point, joint!.mapPoint(question, point))));
    await Promise.all(points);
  },
};

export type Tasks = typeof tasks;
export type Task = keyof Tasks;

self.onmessage = async ({ data: { id, of, question } }: MessageEvent<{ id: number; of: Task; question: unknown }>) => {
  const on = listener<{ done: (answer: unknown) => void; failed: (message: string) => void }>(id);
  try {
    on.done(await (tasks[of] as (question: unknown, on: object) => unknown)(question, on));
  } catch (error) {
    on.failed(lineOf(error));
  }
};
