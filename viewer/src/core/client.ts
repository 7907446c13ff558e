import { lineOf } from "./error_line";
import { latestOnly } from "./latest";
import type { BothValues, Brushed, Coordinates, Depth, Edit, FromWorker, LimitQuestion, LiveLimit, Shown, Turned } from "./protocol";
import type { Query, QueryAnswer, QueryName } from "./queries";
import type { Task, Tasks } from "./worker";

declare const workerSource: string;

export interface Answers {
  shown(at: Coordinates, shown: Shown, roundTripMs: number): void;
  values(values: BothValues): void;
  depth(depth: Depth): void;
  bearing(triangles: Uint8Array): void;
  openness(body: "fixed" | "mobile", openness: Uint8Array): void;
  mapPoint(point: number, intervals: [number, number, number, number][]): void;
  failed(message: string): void;
}

/// Results of an edit: the changed bodies, then limits one by one.
export interface EditAnswers {
  edited(changed: Brushed | Turned | null): void;
  limit(number: number, limit: LiveLimit): void;
}

type Listener = Record<string, ((...args: unknown[]) => void) | undefined>;
type Question<Of extends Task> = Parameters<Tasks[Of]>[0];
type Answer<Of extends Task> = Awaited<ReturnType<Tasks[Of]>>;

/// The core in its worker. It answers one pose at a time; of the poses requested meanwhile it answers only the latest.
export class CoreClient {
  private readonly worker = new Worker(URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" })));
  private readonly listeners = new Map<number, Listener>();
  private count = 0;
  /// A pose and the quantity that colours it.
  readonly ask = latestOnly<Question<"pose">>(async (question) => {
    const asked = performance.now();
    try {
      const shown = await this.call("pose", question);
      this.say("shown", question.at, shown, performance.now() - asked);
    } catch (error) {
      this.say("failed", lineOf(error));
    }
  });

  private constructor() {
    this.worker.onmessage = ({ data: { id, say, args } }: MessageEvent<FromWorker>) => {
      const listener = this.listeners.get(id);
      if (id && /^(done|failed)$/.test(say)) this.listeners.delete(id);
      listener?.[say]?.(...args);
    };
    this.worker.onerror = ({ message }) => this.listeners.forEach((listener) => listener["failed"]?.(message));
  }

  /// A worker and its answer to the first task, without which it is of no use. Rejects with the core's own line.
  static async begin<Of extends Task>(of: Of, question: Question<Of>, transfer: Transferable[]): Promise<{ core: CoreClient; answer: Answer<Of> }> {
    const core = new CoreClient();
    try {
      return { core, answer: await core.call(of, question, undefined, transfer) };
    } catch (error) {
      core.close();
      throw error;
    }
  }

  /// A task of the worker; `on` hears of its parts before its end. Rejects with the core's own line.
  call<Of extends Task>(of: Of, question: Question<Of>, on?: Parameters<Tasks[Of]>[1], transfer: Transferable[] = []): Promise<Answer<Of>> {
    const id = ++this.count;
    return new Promise((resolve, reject) => {
      const ends = { done: resolve, failed: (message: string) => reject(new Error(message)) };
      this.listeners.set(id, { ...(on as object | undefined), ...ends } as Listener);
      this.worker.postMessage({ id, of, question }, transfer);
    });
  }

  listen(answers: Answers): void {
    this.listeners.set(0, answers as unknown as Listener);
  }

  /// Something whose answers come to who listens.
  request<Of extends "bearing" | "openness" | "map">(of: Of, question: Question<Of>): void {
    this.call(of, question).catch((error: unknown) => this.say("failed", lineOf(error)));
  }

  /// Changes the joint; limits after the change are answered in their order, before anything about the pose.
  edit(edit: Edit, limits: LimitQuestion[], on: EditAnswers): Promise<void> {
    return this.call("edit", { edit, limits }, on);
  }

  /// A single query, after the page's own: all are answered, in order.
  query<Of extends QueryName>(query: Query<Of>): Promise<QueryAnswer<Of>> {
    return this.call("query", query as Query) as Promise<QueryAnswer<Of>>;
  }

  close(): void {
    this.worker.terminate();
  }

  private say<Of extends keyof Answers>(of: Of, ...args: Parameters<Answers[Of]>): void {
    this.listeners.get(0)?.[of]?.(...args);
  }
}
