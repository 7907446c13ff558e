import type { CoreClient } from "../core/client";
import { lineOf } from "../core/error_line";
import type { Brushed, Edit, JointArrays, LiveLimit, Stroke } from "../core/protocol";
import { button, checkbox, choice, html, named, section } from "../dom";
import { fixed } from "../numbers";
import type { EndOfMotion, ReportText } from "../report";
import { headlineMotion } from "../result";
import { bodyNames, type BodyName } from "../scene/body_names";
import type { JointScene } from "../scene/scene";
import { motionName, words } from "../words";
import { NumberField } from "./angle_field";
import { LiveLimits, questionsOf } from "./live_limits";
import { Painter } from "./painter";
import { saveJointFile, saveMeshes } from "./saved_files";
import { vertexByNumber } from "./vertex_choice";

const usual = { radius_mm: 6, depth_mm: 2 }, most = { radius_mm: 30, depth_mm: 20 }, least_mm = 0.1;

type Change = Exclude<Edit, { of: "brush" | "centre" | "parts" }>;

/// A change that waits; strokes of one drag have one number.
interface Asked {
  edit: Change;
  rests: boolean;
  hand: number;
}

export interface BrushOptions {
  text: ReportText;
  arrays: JointArrays;
  names: Record<BodyName, string>;
  /// The surface before the cut, for a bone that a plan cuts.
  before: Record<BodyName, Float64Array | null>;
  /// Limits of the joint before a plan, by the names of motions; none without a plan.
  limitsBefore: ReadonlyMap<string, EndOfMotion>;
  /// A bone is another one now; `rests` once the hand does.
  changed: (brushed: Brushed, rests: boolean) => void;
  /// All limits are known, in the order of questionsOf().
  limited: (limits: readonly LiveLimit[]) => void;
}

/// Strokes of a brush on the bones, what they take, and what each motion gains, live.
export class BrushPanel {
  readonly element: HTMLElement;
  private readonly limits: LiveLimits;
  private readonly asked;
  private readonly said = html("p", { role: "status", class: "small brush-said" });
  private readonly took = html("span", { class: "small", "aria-hidden": "true" });
  private readonly radius: NumberField;
  private readonly depth: NumberField;
  private readonly vertex: HTMLInputElement;
  private readonly bodies: HTMLSelectElement;
  private readonly shows: HTMLInputElement;
  private readonly undoButton: HTMLButtonElement;
  private readonly painter: Painter | null;
  private readonly brushed: Partial<Record<BodyName, Brushed>> = {};
  private readonly prepared = new Map<BodyName, Promise<boolean>>();
  /// Bones in the order of their steps.
  private readonly steps: BodyName[] = [];
  private readonly latest: (LiveLimit | null)[];
  private action: Stroke["action"] = "lower";
  private shown: number;
  private isBusy = false;
  private hand = 0;
  private waiting: Asked[] = [];

  constructor(private readonly core: CoreClient, private readonly scene: JointScene | null, private readonly options: BrushOptions) {
    const { text, names, arrays, limitsBefore } = options;
    this.asked = questionsOf(text);
    this.latest = this.asked.map(() => null);
    const motions = this.asked.map(({ motion }) => motion);
    this.limits = new LiveLimits(words.liveLimits, words.gained, motions, motions.map((motion) => limitsBefore.get(motion.name) ?? motion));
    const first = headlineMotion(text);
    this.shown = Math.max(0, motions.findIndex((motion) => motion === first));
    this.radius = this.sizeField(words.brushRadius, most.radius_mm, usual.radius_mm);
    this.depth = this.sizeField(words.brushDepth, most.depth_mm, usual.depth_mm);
    this.depth.input.title = words.brushDepthHelp;
    const { bodies, number, submit } = vertexByNumber({ body: words.brushBone, number: words.brushVertex, button: words.strokeAtVertex }, names,
      (body) => arrays[body].vertices.length / 3 - 1, ({ body, vertex }) => void this.draw(body, [vertex], true, true), (why) => this.say(why));
    this.vertex = number;
    this.bodies = bodies.querySelector("select")!;
    const paint = checkbox(words.paint, false, (on) => this.painter?.setActive(on));
    const shows = checkbox(words.showBrushed, false, () => this.showTaken());
    this.shows = shows.querySelector("input")!;
    this.undoButton = button(words.undoStroke, () => void this.undo(), { disabled: true });
    this.painter = scene && new Painter(scene, {
      isOpen: () => this.element.checkVisibility(), radius_mm: () => this.radius.number,
      drawn: (body, along, isFirst, rests) => void this.draw(body, along, isFirst, rests),
    });
    bodyNames.forEach((body) => {
      if (options.before[body]) this.steps.push(body);
    });
    this.undoButton.disabled = this.steps.length === 0;
    this.element = section(words.brush,
      html("div", { class: "row no-print" }, ...(scene ? [paint] : []),
        html("label", {}, `${words.brushRadius} `, this.radius.input), html("label", {}, `${words.brushDepth} `, this.depth.input)),
      html("div", { class: "row no-print" },
        choice<Stroke["action"]>(words.brushAction, words.brushActions, this.action, (action) => (this.action = action)), this.undoButton),
      html("div", { class: "row no-print" }, bodies, number, submit),
      html("div", { class: "row no-print" }, this.motionChoice(motions.map(({ name }) => name)),
        button(words.strokeAtLimit, () => void this.strokeAtLimit())),
      this.said, this.limits.element,
      html("p", { class: "small" }, options.before.mobile || options.before.fixed ? `${words.planIsStart} ` : "", words.brushNote, " ", this.took),
      html("div", { class: "row no-print" }, ...(scene ? [shows] : []), button(words.saveStl, () => saveMeshes(text, arrays, "brushed", (body) => this.verticesOf(body))),
        button(words.saveJointFile, () => void saveJointFile(core, text))));
    this.limits.mark(this.shown);
    // Tables are built before the first stroke.
    this.element.addEventListener("focusin", () => void this.prepare(this.body));
    this.element.addEventListener("pointerenter", () => void this.prepare(this.body));
  }

  private get body(): BodyName {
    return this.bodies.value as BodyName;
  }

  private sizeField(label: string, largest: number, value: number): NumberField {
    const field = new NumberField(label, least_mm, largest, 0.5, " mm", false, () => undefined, (why) => this.say(why ?? ""));
    field.show(value);
    return field;
  }

  private motionChoice(names: readonly string[]): HTMLElement {
    const texts = Object.fromEntries(names.map((name, i) => [String(i), named(motionName(name))])) as Record<string, string>;
    return choice(words.shownMotion, texts, String(this.shown), (number) => {
      this.shown = Number(number);
      this.limits.mark(this.shown);
    });
  }

  private say(text: string): void {
    this.said.textContent = text;
  }

  // -- edits ------------------------------------------------------------------------------------------------------------------------

  /// The bone is made ready for strokes, once; whether it is.
  private prepare(body: BodyName): Promise<boolean> {
    const ready = this.prepared.get(body) ?? this.core.edit({ of: "brush", body, before: this.options.before[body] }, [], {
      edited: (changed) => {
        const brushed = (this.brushed[body] = changed as Brushed);
        if (!this.said.textContent) this.say(words.noStroke(fixed(brushed.edge_mm, 1)) + ` ${words.protectedBone(this.options.names[body], brushed.protectedVertices)}`);
      },
      limit: () => undefined,
    }).then(() => true, (error: unknown) => {
      this.say(lineOf(error));
      return false;
    });
    this.prepared.set(body, ready);
    return ready;
  }

  /// One change is under way at a time; of the strokes of one drag that come meanwhile only the latest is made.
  private async ask(edit: Change, rests: boolean): Promise<void> {
    if (!(edit.of === "stroke" && edit.replaces)) ++this.hand;
    const { hand } = this;
    if (!(await this.prepare(edit.body))) return;
    const last = this.waiting.at(-1);
    if (last?.hand === hand && last.edit.of === "stroke" && edit.of === "stroke") {
      edit = { ...edit, replaces: last.edit.replaces };
      this.waiting.pop();
    }
    this.waiting.push({ edit, rests, hand });
    if (this.isBusy) return;
    this.isBusy = true;
    for (let next = this.waiting.shift(); next; next = this.waiting.shift())
      await this.make(next.edit, next.rests).catch((error: unknown) => this.say(lineOf(error)));
    this.isBusy = false;
  }

  private async make(edit: Change, rests: boolean): Promise<void> {
    const begun = performance.now(), order = [this.shown, ...this.asked.keys()].filter((i, at) => at === 0 || i !== this.shown);
    const wanted = rests ? order : order.slice(0, 1), since_ms = () => performance.now() - begun;
    let first_ms = 0;
    this.limits.wait();
    await this.core.edit(edit, wanted.map((i) => this.asked[i]!.question), {
      edited: (changed) => this.take(changed as Brushed, edit, rests),
      limit: (number, limit) => {
        this.latest[wanted[number]!] = limit;
        this.limits.showLimit(wanted[number]!, limit);
        if (number === 0) this.element.dataset["shownAfter"] = (first_ms = since_ms()).toFixed(1);
      },
    });
    if (!rests) return;
    this.took.textContent = words.tookLimits(first_ms.toFixed(0), since_ms().toFixed(0));
    this.element.dataset["allAfter"] = since_ms().toFixed(1);
    this.options.limited(this.latest as LiveLimit[]);
  }

  private take(brushed: Brushed, edit: Change, rests: boolean): void {
    this.brushed[brushed.body] = brushed;
    if (edit.of === "stroke" && !edit.replaces) this.steps.push(brushed.body);
    if (edit.of === "undo") this.steps.pop();
    this.undoButton.disabled = this.steps.length === 0;
    const taken = bodyNames.flatMap((body) => {
      const bone = this.brushed[body];
      return bone && bone.deepest_mm > 0 ? [words.brushed(this.options.names[body], fixed(bone.volume_mm3, 1), fixed(bone.deepest_mm, 2))] : [];
    });
    const last = brushed.outcome ? [words.lastStroke(brushed.outcome)] : [];
    this.say(taken.length ? `${[...taken, ...last].join("; ")}.` : words.noStroke(fixed(brushed.edge_mm, 1)));
    this.options.changed(brushed, rests);
    this.showTaken();
  }

  private strokeOf(along: number[]): Stroke {
    return { action: this.action, along, radius_mm: this.radius.number, depth_mm: this.depth.number };
  }

  private draw(body: BodyName, along: number[], isFirst: boolean, rests: boolean): Promise<void> {
    this.bodies.value = body;
    return this.ask({ of: "stroke", body, stroke: this.strokeOf(along), replaces: !isFirst }, rests);
  }

  /// At the vertex of the chosen bone that is nearest to where the shown motion ends now.
  private async strokeAtLimit(): Promise<void> {
    const { motion, question } = this.asked[this.shown]!, live = this.latest[this.shown];
    const reason = live?.reason ?? motion.reason, point = live ? live.point : motion.contact_point_mm;
    if (reason !== "contact" || !point) return this.say(words.noContactThere);
    const angles = [...question.start] as [number, number, number];
    angles[question.vary]! += (question.positive ? 1 : -1) * (live?.turned_deg ?? motion.limit_deg);
    const { pose } = await this.core.query({ of: "pose", at: { angles, translation: question.held ?? [0, 0, 0] } });
    const vertex = nearestVertex(this.verticesOf(this.body), this.body === "fixed" ? point : intoM(pose, point));
    this.vertex.value = String(vertex);
    await this.draw(this.body, [vertex], true, true);
  }

  private async undo(): Promise<void> {
    const body = this.steps.at(-1);
    if (body) await this.ask({ of: "undo", body }, true);
  }

  // -- what is seen and kept --------------------------------------------------------------------------------------------------------

  private verticesOf(body: BodyName): Float64Array {
    return this.brushed[body]?.vertices ?? this.options.arrays[body].vertices;
  }

  private showTaken(): void {
    for (const body of bodyNames) {
      const depths = this.brushed[body]?.depths_mm;
      const lowered = depths && this.shows.checked ? Uint32Array.from(depths.keys()).filter((v) => depths[v]! > 0) : null;
      const before = this.options.before[body] ?? this.options.arrays[body].vertices;
      this.scene?.annotations.showRemoved(body, lowered?.length ? { vertices: lowered, before: threesOf(before, lowered) } : null);
    }
  }
}

function threesOf(xyz: Float64Array, vertices: Uint32Array): Float64Array {
  const chosen = new Float64Array(3 * vertices.length);
  vertices.forEach((vertex, i) => chosen.set(xyz.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
  return chosen;
}

function nearestVertex(xyz: Float64Array, [x, y, z]: readonly [number, number, number]): number {
  let nearest = 0, least = Infinity;
  for (let v = 0; 3 * v < xyz.length; ++v) {
    const squared = (xyz[3 * v]! - x) ** 2 + (xyz[3 * v + 1]! - y) ** 2 + (xyz[3 * v + 2]! - z) ** 2;
    if (squared < least) [nearest, least] = [v, squared];
  }
  return nearest;
}

/// A point of F in M at a pose X_FM, 16 numbers row by row.
function intoM(X_FM: ArrayLike<number>, point: readonly [number, number, number]): [number, number, number] {
  const from = point.map((value, i) => value - X_FM[4 * i + 3]!);
  return [0, 1, 2].map((k) => [0, 1, 2].reduce((sum, i) => sum + X_FM[4 * i + k]! * from[i]!, 0)) as [number, number, number];
}
