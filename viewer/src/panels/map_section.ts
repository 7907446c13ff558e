import type { CoreClient } from "../core/client";
import type { Coordinates, MapQuestion } from "../core/protocol";
import { button, html, section } from "../dom";
import { MapPlot } from "../plots/map";
import type { Interval, MapAnswer, ReportText } from "../report";
import { heldOn } from "../report_shape";
import { words } from "../words";
import type { MotionPanel } from "./motion";

/// The report's map, or a button that has the page compute one.
export class MapSection {
  readonly element = section(words.map);
  private readonly progress = html("p", { id: "map-progress", role: "status" });
  private plot: MapPlot | null = null;
  /// Numbers of the coordinates of the map's columns and rows.
  private axes: [number, number] | null = null;

  /// `core` answers if the page computes: then the map moves the joint.
  constructor(
    private readonly text: ReportText, private readonly motion: MotionPanel, private readonly computes: boolean,
    private readonly core: () => CoreClient | null) {
    if (text.map) this.show(text.map);
    else this.element.append(this.progress, this.askButton());
  }

  /// Takes the intervals of a point that the core has computed.
  set(point: number, intervals: Interval[]): void {
    this.plot?.set(point, intervals);
    this.progress.textContent = this.plot?.progress() ?? "";
  }

  /// Marks where the joint is.
  mark(at: Coordinates): void {
    const values = valuesOf(at);
    if (this.axes) this.plot?.setPose(values[this.axes[0]]!, values[this.axes[1]]!);
  }

  private show(answer: MapAnswer): void {
    const names = [...this.text.coordinates.map(({ name }) => name), "x", "y", "z"], { held_deg, held_mm } = answer;
    const [columnAt, rowAt] = this.axes = [names.indexOf(heldOn(answer.columns).name), names.indexOf(heldOn(answer.rows).name)];
    const at = (values: number[], column: number, row: number): [number[], number[]] => {
      [values[columnAt], values[rowAt]] = [column, row];
      return [values.slice(0, 3), values.slice(3)];
    };
    this.plot = new MapPlot(answer, this.computes ? {
      go: (column, row) => {
        const values = held_deg && held_mm ? [...held_deg, ...held_mm] : valuesOf(this.motion.coordinates);
        values[names.indexOf(answer.vary)] = answer.start_mm ?? answer.start_deg!;
        const [angles, translation] = at(values, column, row);
        this.motion.goTo(angles, undefined, translation);
      },
      drag: (column, row) => this.motion.drag(...at(valuesOf(this.motion.coordinates), column, row)),
    } : null);
    this.mark(this.motion.coordinates);
    this.element.append(this.plot.element);
    this.element.classList.add("of-report");
  }

  private askButton(): HTMLButtonElement {
    const ask = button(words.computeMap, () => {
      const core = this.core();
      if (!core) return;
      ask.remove();
      this.element.dataset["of"] = document.body.dataset["byHand"] ?? "";
      const question = { ...coarseMap(), held: this.text.rom?.held_translation_mm ?? this.text.reference_mm } satisfies MapQuestion;
      const [column, row, vary] = [question.columnAngle, question.rowAngle, question.vary].map((i) => this.text.coordinates[i]!);
      this.show({
        columns: { angle: column!.name, opposite: column!.opposite, values_deg: question.columns },
        rows: { angle: row!.name, opposite: row!.opposite, values_deg: question.rows },
        vary: vary!.name, vary_opposite: vary!.opposite, start_deg: 0, intervals: [],
      });
      core.request("map", question);
    });
    return ask;
  }
}

/// Angles, then the translation.
function valuesOf({ angles, translation }: Coordinates): number[] {
  return [...angles, ...translation];
}

/// Internal rotation over flexion and adduction, every ten degrees.
function coarseMap(): MapQuestion {
  const every10 = (first: number, last: number) => Array.from({ length: (last - first) / 10 + 1 }, (_, i) => first + 10 * i);
  return { columnAngle: 0, rowAngle: 1, vary: 2, columns: every10(-20, 120), rows: every10(-40, 30) };
}
