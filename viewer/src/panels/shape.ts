import { checkbox, fold, html, section } from "../dom";
import { fixed } from "../numbers";
import { figure, type Drawing } from "../plots/figure";
import { hoursDrawing } from "../plots/hours";
import type { Measure, StoredMeasures } from "../report";
import type { JointScene } from "../scene/scene";
import { measureMarks } from "../scene/measure_marks";
import { words } from "../words";
import { lines, table } from "./table";

const digits: Record<string, number> = { "1": 3, h: 2 };

function shown(value: number | null, unit: string): string {
  return value === null ? "–" : fixed(value, digits[unit] ?? 1);
}

/// "alpha 1:30" of "alpha_1_30_deg": without the unit, which has a column.
export function measureName(key: string, unit: string): string {
  const name = key.endsWith(`_${unit}`) ? key.slice(0, -unit.length - 1) : key;
  return name.replace(/_(\d+)_(\d\d)(?=_|$)/, " $1:$2").replaceAll("_", " ");
}

function row({ key, unit, value, band, normal }: Measure, hasBands: boolean): string[] {
  return [
    measureName(key, unit), value === null || unit === "1" ? shown(value, unit) : `${shown(value, unit)} ${unit}`,
    ...(hasBands ? [band?.p5 == null ? "–" : words.rangeOf(shown(band.p5, unit), shown(band.p95, unit))] : []),
    normal ? words.rangeOf(String(normal.low), String(normal.high)) : "–",
  ];
}

function sentences(measures: readonly Measure[], said: (measure: Measure) => string | null): string[] {
  return measures.filter((measure) => said(measure)).map((measure) => words.ofMeasure(measureName(measure.key, measure.unit), said(measure)!));
}

export function measureTables({ measures }: StoredMeasures): HTMLElement[] {
  const hasBands = measures.some(({ band }) => band !== null), head = ["", words.value, ...(hasBands ? [words.band] : []), words.normal];
  return (["femur", "acetabulum", "both"] as const).flatMap((part) => {
    const rows = measures.filter((measure) => measure.part === part).map((measure) => row(measure, hasBands));
    return rows.length ? [table(head, rows, words.measuredPart[part])] : [];
  });
}

/// Alpha angles around the neck and centre-edge angles around the rim.
export function shapeDrawings(shape: StoredMeasures): Drawing[] {
  const alpha = hoursDrawing("alpha_by_hour", words.alphaCaption, words.alphaAxis, shape.around_neck.map(({ hour }) => hour), [
    { name: words.alphaAt("0.5"), values: shape.around_neck.map(({ alpha_deg }) => alpha_deg) },
    { name: words.alphaAt("1.0"), values: shape.around_neck.map(({ alpha_at_1mm_deg }) => alpha_at_1mm_deg) },
  ]);
  const edge = hoursDrawing("centre_edge_by_hour", words.centreEdgeCaption, words.centreEdgeAxis, shape.rim.map(({ hour }) => hour), [
    { name: words.centreEdgeAxis, values: shape.rim.map(({ centre_edge_deg }) => centre_edge_deg) },
  ]);
  return [alpha, edge].filter((drawing) => drawing !== null);
}

/// The shape of a hip: its measures with bands and normal ranges, around the clock, and drawn on the bones.
export function shapePanel(shape: StoredMeasures, scene: JointScene | null): { element: HTMLElement; details: HTMLDetailsElement } {
  const { measures } = shape, more: HTMLElement[] = [html("p", {}, words.pelvisFrame(shape.pelvis_frame)), ...measureTables(shape)];
  const parts = scene ? [html("div", { class: "row no-print" }, checkbox(words.drawMeasures, false, (on) => scene.annotations.showMarks(on ? measureMarks(shape) : null)))] : [];
  const folded = (title: string, texts: string[]) => {
    if (texts.length) more.push(html("details", { class: "folded" }, html("summary", {}, title), lines(texts)));
  };
  const reasons = sentences(measures, ({ value, why_none }) => (value === null ? why_none : null));
  const notes = [...shape.left_out, ...sentences(measures, ({ note }) => note)];
  if (reasons.length) more.push(html("h3", {}, words.notMeasured), lines(reasons));
  if (notes.length) more.push(html("h3", {}, words.readWith), lines(notes));
  folded(words.definitions, measures.map(({ key, unit, definition, source }) =>
    words.ofMeasure(measureName(key, unit), words.definedBy(definition, source))));
  folded(words.normalSources, measures.flatMap(({ key, unit, normal }) =>
    (normal ? [words.ofMeasure(measureName(key, unit), words.definedBy(normal.people ? `${normal.people}: ${normal.meaning}` : normal.meaning, normal.source))] : [])));
  return { element: section(words.shape, ...parts, ...shapeDrawings(shape).map((drawing) => figure(drawing))), details: fold(words.measures, false, ...more) };
}
