import type { CoreClient } from "../core/client";
import type { JointArrays, LiveLimit, Turned } from "../core/protocol";
import { button, checkbox, html, section } from "../dom";
import type { ReportText, StoredPosed } from "../report";
import { bodyNames } from "../scene/body_names";
import type { JointScene } from "../scene/scene";
import { words } from "../words";
import { liveEdit } from "./live_edit";
import { LiveLimits, questionsOf } from "./live_limits";
import { ParameterRow } from "./parameter_row";
import { saveJointFile, saveMeshes } from "./saved_files";
import { SweepPanel, type ShownSweep } from "./sweep";

const ghostName = "parts";

export interface PartsOptions {
  text: ReportText;
  arrays: JointArrays;
  posed: StoredPosed;
  /// The designs that leave targets free, if the report has any.
  sweep: ShownSweep | null;
  /// Parts are to stand otherwise than in the report, or as there again.
  turned: (isTurned: boolean) => void;
  /// Both bodies are these now, by the values of `done`, none as in the report; `rests` once no other value waits.
  changed: (turned: Turned, rests: boolean, done: string) => void;
  limited: (limits: readonly LiveLimit[]) => void;
}

/// Sliders of the joint's parts: every value is set as `--set` sets it, and each motion is shown before and after, live. What turned is seen where it was, as
/// a ghost.
export class PartsPanel {
  readonly element: HTMLElement;
  private readonly limits: LiveLimits;
  private readonly edit: () => void;
  private readonly rows: ParameterRow[];
  private readonly said = html("p", { role: "status", class: "small" });
  private readonly option = html("input", { type: "text", readonly: true, class: "command", "aria-label": words.partsCommand });
  private readonly took = html("span", { class: "small", "aria-hidden": "true" });
  private readonly ghost: HTMLInputElement;
  /// A panel of its own, whose point sets the values too.
  readonly sweep: SweepPanel | null;
  /// Where the bodies are now.
  private now: Turned | null = null;

  constructor(core: CoreClient, private readonly scene: JointScene | null, private readonly options: PartsOptions) {
    const { text, posed, sweep, arrays } = options;
    const asked = questionsOf(text), motions = asked.map(({ motion }) => motion);
    this.edit = liveEdit(core, asked.map(({ question }) => question), {
      edit: () => ({ of: "parts", values: this.textOf(this.rows.filter(({ isTurned }) => isTurned)) }),
      tables: () => this.tables,
      edited: (turned, rests) => this.take(turned as Turned, rests),
      shown: (took_ms, rests, limits) => {
        this.took.textContent = words.tookAll(took_ms.toFixed(0));
        if (rests) options.limited(limits);
        if (rests) this.element.dataset["allAfter"] = took_ms.toFixed(1);
      },
      failed: (message) => (this.said.textContent = message),
    });
    this.limits = new LiveLimits(words.partsLimits, words.gained, motions);
    this.sweep = sweep && new SweepPanel(sweep, motions, (values) => this.set(values));
    this.rows = posed.parts.flatMap((part) => part.parameters.map((parameter) =>
      new ParameterRow(part.name, parameter, () => this.ask(), (why) => (this.said.textContent = why ?? ""))));
    const shows = checkbox(words.showAsReported, true, () => this.showGhosts());
    this.ghost = shows.querySelector("input")!;
    const canSave = posed.parts.every(({ is_cut }) => !is_cut);
    this.element = section(words.parts,
      html("div", { class: "parameter-rows" }, ...this.rows.map(({ element }) => element)),
      html("div", { class: "row no-print" }, button(words.partsReset, () => this.reset()), ...(scene ? [shows] : [])),
      this.said, this.limits.element,
      html("p", { class: "small" }, text.rom?.implant ? "" : `${words.osseousOnly} `, words.partsNote, " ", this.took),
      html("p", { class: "small command-row" }, html("span", { "aria-hidden": "true" }, `${words.partsCommand}:`), this.option),
      // Meshes as given: the joint file says where its parts stand.
      ...(canSave ? [html("div", { class: "row no-print" },
        button(words.saveGivenStl, () => saveMeshes(text, arrays, "given", (body) => arrays.posed![body].vertices ?? arrays[body].vertices)),
        button(words.saveJointFile, () => void saveJointFile(core, text, { posed, values: this.values })))] : []));
    this.showValues();
  }

  /// The present value of each parameter, by "cup.inclination".
  get values(): Map<string, number> {
    return new Map(this.rows.map(({ name, value }) => [name, value]));
  }

  /// Other values of some parameters, as by hand; those that there are not are passed over.
  set(values: ReadonlyMap<string, number>): void {
    for (const row of this.rows) {
      const value = values.get(row.name);
      if (value !== undefined) row.show(value);
    }
    this.ask();
  }

  private get tables(): LiveLimits[] {
    return [this.limits, ...(this.sweep ? [this.sweep.limits] : [])];
  }

  private reset(): void {
    this.set(new Map(this.rows.map(({ name, reported }) => [name, reported])));
  }

  private textOf(rows: readonly ParameterRow[]): string {
    return rows.map(({ name, value }) => `${name}=${value}`).join(" ");
  }

  /// On the map, and as the words of the command line that have these values, beside the file's own.
  private showValues(): void {
    const { values } = this;
    this.sweep?.show(values);
    const differing = this.rows.filter(({ value, inFile }) => value !== inFile);
    this.option.value = differing.length ? `--set "${this.textOf(differing)}"` : words.partsAsInFile;
  }

  private ask(): void {
    this.showValues();
    this.options.turned(this.rows.some(({ isTurned }) => isTurned));
    this.edit();
  }

  private take(turned: Turned, rests: boolean): void {
    this.now = turned;
    this.options.changed(turned, rests, this.textOf(this.rows.filter(({ isTurned }) => isTurned)));
    this.showGhosts();
  }

  /// Ghosts of the bodies that differ from the report.
  private showGhosts(): void {
    for (const body of bodyNames) {
      const { vertices, triangles } = this.options.arrays[body];
      const isOther = this.now !== null && this.now[body].some((value, i) => value !== vertices[i]);
      const shown = isOther && this.ghost.checked;
      const drawn = this.scene?.bodies[body];
      if (shown !== drawn?.hasGhost(ghostName)) drawn?.setGhost(ghostName, shown ? { vertices, triangles } : null);
    }
  }
}
