import { lineOf } from "./error_line";
import { CoreJoint } from "./joint";
import { blockOfJoint } from "./joint_file";
import { CoreLabels } from "./labels";
import { openness } from "./openness";
import type { Edit, FromWorker, LimitQuestion, MapQuestion, Quantity, Query, QueryAnswer, ToWorker } from "./protocol";

/// Answers in the order of visible effect: changes by hand, the latest pose, limits after the last change, then the pose's colours, its
/// depth, then all else. A message that arrives meanwhile comes in between; pending answers about an earlier pose are
/// dropped. All limits after a change come before the next change.

type PoseQuestion = Extract<ToWorker, { type: "pose" }>;

let joint: CoreJoint | null = null;
let labels: CoreLabels | null = null;
let latest: PoseQuestion | null = null;
let aboutPose: (() => void)[] = [];
const edits: (() => void)[] = [];
const afterEdit: (() => void)[] = [];
const afterwards: (() => void)[] = [];
/// What only makes the picture better: a piece of it while nothing is to be answered.
let light: Generator<void> | null = null;

function say(message: FromWorker, transfer: Transferable[] = []): void {
  (self as unknown as DedicatedWorkerGlobalScope).postMessage(message, transfer);
}

async function attempt(work: () => void | Promise<void>): Promise<void> {
  try {
    await work();
  } catch (error) {
    say({ type: "failed", message: lineOf(error) });
  }
}

/// The worker's own turn of the event loop: a message waits no longer than one piece of work.
const turns = new MessageChannel();
let isTurnAsked = false;
turns.port1.onmessage = () => {
  isTurnAsked = false;
  void attempt(next);
};
function soon(): void {
  if (!isTurnAsked) turns.port2.postMessage(null);
  isTurnAsked = true;
}

function next(): void {
  if (!joint) return;
  if (edits.length && !afterEdit.length) {
    edits.shift()!();
  } else if (latest) {
    const asked = latest;
    latest = null;
    aboutPose = [];
    const shown = joint.shown(asked.at);
    say({ type: "shown", id: asked.id, shown }, [shown.pose.buffer as ArrayBuffer, shown.pairs.buffer as ArrayBuffer]);
    const { quantity } = asked;
    if (quantity !== "none") aboutPose.push(() => sayValues(asked, quantity));
    // Last: it takes longest.
    if (shown.inContact) aboutPose.push(() => say({ type: "depth", id: asked.id, depth: joint!.depth(asked.at) }));
  } else {
    const work = afterEdit.shift() ?? aboutPose.shift() ?? afterwards.shift();
    if (work) work();
    else if (light?.next().done) light = null;
  }
  if (latest || edits.length || afterEdit.length || aboutPose.length || afterwards.length || light) soon();
}

function* lightOf(bones: CoreJoint): Generator<void> {
  for (const [ofFixed, body] of (["mobile", "fixed"] as const).entries()) {
    const open = yield* openness(bones.surface(ofFixed));
    say({ type: "openness", body, openness: open }, [open.buffer as ArrayBuffer]);
  }
}

function sayValues({ id, at }: PoseQuestion, quantity: Exclude<Quantity, "none">): void {
  const values = joint!.values(at, quantity);
  const arrays = [values.mobile.shown, values.mobile.marks, values.fixed.shown, values.fixed.marks];
  say({ type: "values", id, values }, arrays.map((array) => array.buffer as ArrayBuffer));
}

function askEdit(id: number, edit: Edit, limits: readonly LimitQuestion[]): void {
  edits.push(() => {
    try {
      const changed = joint!.edit(edit);
      const arrays = Object.values(changed ?? {}).filter((value): value is Float64Array => value instanceof Float64Array);
      say({ type: "edited", id, changed, error: "" }, arrays.map((array) => array.buffer as ArrayBuffer));
    } catch (error) {
      return say({ type: "edited", id, changed: null, error: lineOf(error) });
    }
    const about = edit.of === "centre" && edit.offset_mm.some((mm) => mm !== 0);
    limits.forEach((question, number) => afterEdit.push(() => {
      const limit = about ? joint!.limitAbout(question) : joint!.limit(question);
      say({ type: "editLimit", id, number, limit });
    }));
  });
}

function askMap(question: MapQuestion): void {
  for (let point = 0; point < question.columns.length * question.rows.length; ++point)
    afterwards.push(() => say({ type: "mapPoint", point, intervals: joint!.mapPoint(question, point) }));
}

function answerTo(query: Query): QueryAnswer {
  switch (query.of) {
    case "pose":
      return joint!.details(query.at);
    case "poseMatrix":
      return joint!.detailsOf(query.X_FM);
    case "depth":
      return joint!.depth(query.at);
    case "nearest":
      return joint!.nearest(query.at, query.counted);
    case "penetrations":
      return joint!.penetrationsAt(query.at);
    case "values":
      return joint!.values(query.at, query.quantity);
    case "limit":
      return joint!.limit(query.limit);
    case "mapPoint":
      return joint!.mapPoint(query.question, query.point);
    case "motion":
      return joint!.motion(query.file, query.columns);
    case "memory":
      return joint!.memory_bytes;
  }
}

function askQuery(id: number, query: Query): void {
  afterwards.push(() => {
    try {
      say({ type: "queried", id, answer: answerTo(query), error: "" });
    } catch (error) {
      say({ type: "queried", id, answer: null, error: lineOf(error) });
    }
  });
}

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  switch (data.type) {
    case "open":
      void attempt(async () => {
        joint = await CoreJoint.open(data.wasm, data.joint);
        say({ type: "ready" });
      });
      return;
    case "propose":
      void attempt(async () => {
        const opened = await CoreJoint.propose(data.wasm, data.fixed, data.mobile, data.side);
        joint = opened.joint;
        say({ type: "proposed", proposal: opened.proposal });
      });
      return;
    case "jointFile":
      void attempt(async () => {
        const block = await blockOfJoint(data.wasm, data.joint, data.files);
        say({ type: "block", block }, [block]);
      });
      return;
    case "labels":
      void attempt(async () => {
        labels ??= await CoreLabels.open(data.wasm!);
        say({ type: "labels", map: labels.read(data.file) });
      });
      return;
    case "join":
      void attempt(() => {
        const made = labels!.join(data.fixed, data.mobile, data.side, (label) => say({ type: "step", label }));
        joint = made.joint;
        labels = null;
        say({ type: "proposed", proposal: made.proposal });
      });
      return;
    case "pose":
      latest = data;
      break;
    case "query":
      askQuery(data.id, data.query);
      break;
    case "edit":
      askEdit(data.id, data.edit, data.limits);
      light = lightOf(joint!);
      break;
    case "openness":
      light = lightOf(joint!);
      break;
    case "bearing":
      afterwards.push(() => {
        const triangles = joint!.bearing();
        say({ type: "bearing", triangles }, [triangles.buffer as ArrayBuffer]);
      });
      break;
    case "map":
      askMap(data.question);
      break;
  }
  soon();
};
