import type {
  BoneChoice, BothValues, Brushed, Coordinates, Depth, DroppedFile, Edit, FromWorker, SideChoice, JointArrays, LabelMap, LimitQuestion, LiveLimit,
  MapQuestion, NamedFile, Proposal, Quantity, Query, QueryAnswer, Shown, ToWorker, Turned,
} from "./protocol";

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
  failed(message: string): void;
}

interface Question {
  at: Coordinates;
  quantity: Quantity;
}

/// The core in its worker. It answers one pose at a time; of the poses requested meanwhile it answers only the latest.
export class CoreClient {
  private readonly worker: Worker;
  private underWay: { id: number; question: Question; asked: number } | null = null;
  private waiting: Question | null = null;
  private answered: number | null = null;
  private count = 0;
  private readonly queries = new Map<number, (answer: QueryAnswer | null, error: string) => void>();
  private readonly edits = new Map<number, { answers: EditAnswers; last: number }>();
  private answers: Answers | null = null;

  private constructor() {
    this.worker = new Worker(URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" })));
  }

  /// Rejects with the core's own line if the joint cannot be made.
  static async open(wasm: ArrayBuffer, joint: JointArrays): Promise<CoreClient> {
    const client = new CoreClient();
    await client.first({ type: "open", wasm, joint }, [wasm]);
    return client;
  }

  /// The same for two files from which a joint is proposed.
  static async propose(
    wasm: ArrayBuffer, fixed: DroppedFile, mobile: DroppedFile, side: SideChoice): Promise<{ core: CoreClient; proposal: Proposal }> {
    const core = new CoreClient();
    const answer = await core.first({ type: "propose", wasm, fixed, mobile, side }, [wasm]);
    if (answer.type !== "proposed") throw new Error(answer.type);
    return { core, proposal: answer.proposal };
  }

  /// The data block of a joint file and of what was dropped with it, read in a worker that ends with it.
  static async blockOfJoint(wasm: ArrayBuffer, joint: NamedFile, files: readonly NamedFile[]): Promise<ArrayBuffer> {
    const core = new CoreClient();
    const answer = await core.first({ type: "jointFile", wasm, joint, files }, [wasm]);
    core.close();
    if (answer.type !== "block") throw new Error(answer.type);
    return answer.block;
  }

  /// A label map, read in a worker of its own; further ones are read there by readLabels().
  static async openLabels(wasm: ArrayBuffer, file: DroppedFile): Promise<{ core: CoreClient; map: LabelMap }> {
    const core = new CoreClient();
    return { core, map: await core.labels(wasm, file) };
  }

  readLabels(file: DroppedFile): Promise<LabelMap> {
    return this.labels(null, file);
  }

  private async labels(wasm: ArrayBuffer | null, file: DroppedFile): Promise<LabelMap> {
    const answer = await this.first({ type: "labels", wasm, file }, [...(wasm ? [wasm] : []), file.bytes]);
    if (answer.type !== "labels") throw new Error(answer.type);
    return answer.map;
  }

  /// The joint of two bones of the label maps. Rejects with the core's own line, after which others can be chosen.
  async join(fixed: BoneChoice, mobile: BoneChoice, side: SideChoice, step: (label: string | null) => void): Promise<Proposal> {
    const answer = await this.exchange({ type: "join", fixed, mobile, side }, [], step);
    if (answer.type !== "proposed") throw new Error(answer.type);
    return answer.proposal;
  }

  /// The answer to the first message, without which the worker is of no use.
  private first(message: ToWorker, transfer: Transferable[]): Promise<FromWorker> {
    return this.exchange(message, transfer).catch((error: unknown) => {
      this.close();
      throw error;
    });
  }

  /// The answer to a message before there is a joint; later answers go to the listeners.
  private exchange(message: ToWorker, transfer: Transferable[], step: (label: string | null) => void = () => undefined): Promise<FromWorker> {
    return new Promise((resolve, reject) => {
      this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
        if (data.type === "step") return step(data.label);
        if (data.type === "failed") return reject(new Error(data.message));
        this.worker.onmessage = (event: MessageEvent<FromWorker>) => this.hear(event.data);
        resolve(data);
      };
      this.worker.onerror = (event) => reject(new Error(event.message));
      this.say(message, transfer);
    });
  }

  listen(answers: Answers): void {
    this.answers = answers;
  }

  ask(at: Coordinates, quantity: Quantity): void {
    this.waiting = { at, quantity };
    if (!this.underWay) this.send();
  }

  askBearing(): void {
    this.say({ type: "bearing" });
  }

  askOpenness(): void {
    this.say({ type: "openness" });
  }

  askMap(question: MapQuestion): void {
    this.say({ type: "map", question });
  }

  /// Changes the joint; limits after the change are answered in their order, before anything about the pose.
  edit(edit: Edit, limits: LimitQuestion[], answers: EditAnswers): void {
    const id = ++this.count;
    this.edits.set(id, { answers, last: limits.length - 1 });
    this.say({ type: "edit", id, edit, limits });
  }

  /// A single query, after the page's own: all are answered, in order.
  query(query: Query): Promise<QueryAnswer> {
    const id = ++this.count;
    return new Promise((resolve, reject) => {
      this.queries.set(id, (answer, error) => (answer ? resolve(answer) : reject(new Error(error))));
      this.say({ type: "query", id, query });
    });
  }

  close(): void {
    this.worker.terminate();
  }

  private send(): void {
    if (!this.waiting) return;
    const question = this.waiting;
    this.waiting = null;
    this.underWay = { id: ++this.count, question, asked: performance.now() };
    this.say({ type: "pose", id: this.count, ...question });
  }

  private say(message: ToWorker, transfer: Transferable[] = []): void {
    this.worker.postMessage(message, transfer);
  }

  private hear(message: FromWorker): void {
    switch (message.type) {
      case "shown": {
        const { id, question, asked } = this.underWay!;
        this.underWay = null;
        this.answered = id;
        this.answers?.shown(question.at, message.shown, performance.now() - asked);
        this.send();
        return;
      }
      case "values":
        if (message.id === this.answered) this.answers?.values(message.values);
        return;
      case "depth":
        if (message.id === this.answered) this.answers?.depth(message.depth);
        return;
      case "queried":
        this.queries.get(message.id)?.(message.answer, message.error);
        this.queries.delete(message.id);
        return;
      case "edited": {
        const { answers, last } = this.edits.get(message.id)!;
        if (message.error || last < 0) this.edits.delete(message.id);
        if (message.error) answers.failed(message.error);
        else answers.edited(message.changed);
        return;
      }
      case "editLimit": {
        const asked = this.edits.get(message.id);
        if (asked?.last === message.number) this.edits.delete(message.id);
        asked?.answers.limit(message.number, message.limit);
        return;
      }
      case "bearing":
        this.answers?.bearing(message.triangles);
        return;
      case "openness":
        this.answers?.openness(message.body, message.openness);
        return;
      case "mapPoint":
        this.answers?.mapPoint(message.point, message.intervals);
        return;
      case "failed":
        this.underWay = null;
        this.answers?.failed(message.message);
        this.send();
        return;
      case "ready":
      case "proposed":
      case "block":
      case "labels":
      case "step":
        return;
    }
  }
}
