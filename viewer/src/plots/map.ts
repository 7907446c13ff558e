import { scaleBand, scaleLinear, scaleSequential } from "d3-scale";
import { interpolateCividis } from "d3-scale-chromatic";
import { html, spaced, svg } from "../dom";
import { fixed, plain } from "../numbers";
import type { Interval, MapAnswer } from "../report";
import { heldOn } from "../report_shape";
import { roving } from "../roving";
import { words } from "../words";
import { figure, hatching, pressable, type Drawing } from "./figure";

const left = 52, right = 10, top = 8, bottom = 42, letter = 7;
/// Cells of at least this size show their numbers, and millimetres with a digit after the point.
const roomForNumber = { deg: 22, mm: 32, height: 14 };
/// A press that moves less is not a drag.
const still_px = 4;
/// Cividis is light from here on.
const isLightFrom = 0.55;

/// What matters of a hip's rotation, and of a joint's play, lies below the scale's end; the line is at half of it.
const scaleEnd = { deg: 60, mm: 10 };
type Unit = keyof typeof scaleEnd;

const withUnit = (text: string, unit: Unit) => text + words.partUnit[unit]!;
/// A held value: a translation is written in more digits than an angle.
const heldText = (value: number, unit: Unit) => plain(value, unit === "mm" ? 3 : 1);
const axisTitle = ({ name, unit }: { name: string; unit: Unit }) => (unit === "mm" ? words.translation(name) : spaced(name));

/// Values by the number of a column or row, between them too, and back.
function axisOf({ values, unit }: { values: readonly number[]; unit: Unit }): { last: number; at: (place: number) => number; invert: (value: number) => number } {
  const last = values.length - 1, first = values[0]!, step = last > 0 ? (values[last]! - first) / last : 1;
  return {
    last, at: (place) => Number((first + step * Math.min(last, Math.max(0, place))).toFixed(unit === "mm" ? 3 : 1)), invert: (value) => (value - first) / step,
  };
}

/// The interval that holds the start of a point's rotations or slides.
function fromStart(intervals: readonly Interval[], start: number): Interval | null {
  return intervals.find(([low, high]) => low <= start && start <= high) ?? null;
}

export interface MapHooks {
  /// Goes to a point of the grid.
  go: (column: number, row: number) => void;
  /// Goes anywhere, while dragged.
  drag: (column: number, row: number) => void;
}

/// How far the third coordinate goes over two held ones. A cell pressed moves the joint there and names all of its free intervals; a cross
/// marks where the joint is, and drags it.
export class MapPlot {
  readonly element: HTMLElement;
  private readonly cells: SVGRectElement[] = [];
  private readonly numbers: SVGTextElement[] = [];
  private readonly axes = svg("g", {});
  private readonly line = svg("path", { class: "map-line", "aria-hidden": "true" });
  private readonly cross = svg("g", { class: "cross", "aria-hidden": "true" },
    svg("line", { x1: -9, x2: 9, y1: 0, y2: 0 }), svg("line", { x1: 0, x2: 0, y1: -9, y2: 9 }), svg("circle", { r: 5 }));
  private readonly plane;
  private readonly readout = html("p", { class: "map-readout small", "aria-live": "polite" }, words.severalFree);
  private readonly columns;
  private readonly rows;
  /// The unit of the varied coordinate.
  private readonly unit: Unit;
  private readonly start: number;
  private readonly end: number;
  private readonly colour;
  private pose: [number, number] = [Number.NaN, Number.NaN];
  readonly drawing: Drawing;

  constructor(private readonly map: MapAnswer, private readonly hooks: MapHooks | null, private readonly prefix = "") {
    const columns = this.columns = heldOn(map.columns), rows = this.rows = heldOn(map.rows);
    this.unit = map.start_mm === undefined ? "deg" : "mm";
    this.start = map.start_mm ?? map.start_deg!;
    this.end = scaleEnd[this.unit];
    this.colour = scaleSequential(interpolateCividis).domain([0, this.end]).clamp(true);
    this.plane = { x: scaleLinear(), y: scaleLinear(), columns: axisOf(columns), rows: axisOf(rows) };
    const picture = svg("svg", { class: "plot map" }, svg("defs", {}, hatching(`${prefix}unfree`)));
    rows.values.forEach((rowValue, row) => columns.values.forEach((columnValue, column) => {
      const point = row * columns.values.length + column, cell = svg("rect", { class: "cell", fill: "none" });
      picture.append(pressable(cell, this.placeOf(point), () => {
        this.readout.textContent = this.map.intervals[point] ? this.textOf(point) : this.placeOf(point);
        this.hooks?.go(columnValue, rowValue);
      }));
      this.cells.push(cell);
      this.numbers.push(svg("text", { "text-anchor": "middle", class: "cell-number", "aria-hidden": "true" }));
    }));
    picture.append(...this.numbers, this.line, this.axes, this.cross);
    roving(this.cells, columns.values.length);
    if (this.hooks) this.dragBy(picture, this.hooks);
    const caption = words.mapCaption(words.measuredIn[this.unit], spaced(map.vary), spaced(columns.name), spaced(rows.name));
    this.drawing = { name: "map", caption, picture, lay: (width, height) => this.lay(width, height), data: () => this.data() };
    this.element = html("div", { class: "map-place" }, figure(this.drawing, this.legend()), this.readout);
    map.intervals.forEach((_, point) => this.paint(point));
  }

  private lay(width: number, height: number): void {
    const { columns, rows } = this, base = height - bottom;
    const x = scaleBand<number>(columns.values.map((_, i) => i), [left, width - right]), wide = x.bandwidth();
    const y = scaleBand<number>(rows.values.map((_, i) => i), [base, top]), high = y.bandwidth();
    const middle = { x: (i: number) => x(i)! + wide / 2, y: (i: number) => y(i)! + high / 2 };
    this.plane.x.domain([0, columns.values.length - 1]).range([middle.x(0), middle.x(columns.values.length - 1)]);
    this.plane.y.domain([0, rows.values.length - 1]).range([middle.y(0), middle.y(rows.values.length - 1)]);
    const set = (element: SVGElement, values: Record<string, number>) => Object.entries(values).forEach(([name, value]) => element.setAttribute(name, String(value)));
    this.cells.forEach((cell, point) => {
      const column = point % columns.values.length, row = Math.floor(point / columns.values.length);
      set(cell, { x: x(column)!, y: y(row)!, width: wide + 0.4, height: high + 0.4 });
      set(this.numbers[point]!, { x: middle.x(column), y: middle.y(row) + 4 });
    });
    const isRoomy = wide >= roomForNumber[this.unit] && high >= roomForNumber.height;
    for (const number of this.numbers) number.style.display = isRoomy ? "" : "none";
    const labels = ({ values, unit }: typeof columns, step: number, room: number, at: (i: number, text: string) => SVGElement) =>
      values.flatMap((value, i) => (i % Math.ceil(room / step) === 0 ? [at(i, heldText(value, unit) + (unit === "deg" ? "°" : ""))] : []));
    this.axes.replaceChildren(
      ...labels(columns, wide, 5 * letter, (i, text) => svg("text", { x: middle.x(i), y: base + 16, "text-anchor": "middle" }, text)),
      ...labels(rows, high, 16, (i, text) => svg("text", { x: left - 6, y: middle.y(i) + 4, "text-anchor": "end" }, text)),
      svg("text", { x: (left + width - right) / 2, y: height - 8, "text-anchor": "middle" }, axisTitle(columns)),
      svg("text", { transform: `translate(15 ${(top + base) / 2}) rotate(-90)`, "text-anchor": "middle" }, axisTitle(rows)));
    this.drawLine();
    this.setPose(...this.pose);
  }

  /// Takes the intervals of a point.
  set(point: number, intervals: Interval[]): void {
    this.map.intervals[point] = intervals;
    this.paint(point);
    this.drawLine();
  }

  /// One line while points are missing, then empty.
  progress(): string {
    const total = this.cells.length, done = this.map.intervals.filter((known) => known !== undefined).length;
    return done < total ? words.mapProgress(done, total) : "";
  }

  /// Where the joint is; outside the map it has no cross.
  setPose(columnValue: number, rowValue: number): void {
    this.pose = [columnValue, rowValue];
    const { x, y, columns, rows } = this.plane;
    const [column, row] = [columns.invert(columnValue), rows.invert(rowValue)];
    const half = 0.5001, isInside = column >= -half && column <= columns.last + half && row >= -half && row <= rows.last + half;
    this.cross.style.visibility = isInside ? "" : "hidden";
    if (isInside) this.cross.setAttribute("transform", `translate(${x(column).toFixed(2)} ${y(row).toFixed(2)})`);
  }

  /// A press that moves takes the cross along; one that stays is the cell's.
  private dragBy(picture: SVGSVGElement, hooks: MapHooks): void {
    let from: { x: number; y: number; moved: boolean } | null = null;
    picture.addEventListener("pointerdown", (event) => (from = { x: event.clientX, y: event.clientY, moved: false }));
    picture.addEventListener("pointermove", (event) => {
      if (!from || event.buttons === 0) return;
      if (!from.moved && Math.hypot(event.clientX - from.x, event.clientY - from.y) < still_px) return;
      if (!from.moved) picture.setPointerCapture(event.pointerId);
      from.moved = true;
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(picture.getScreenCTM()!.inverse());
      const { x, y, columns, rows } = this.plane;
      hooks.drag(columns.at(x.invert(at.x)), rows.at(y.invert(at.y)));
    });
    // A drag does not press the cell below.
    picture.addEventListener("click", (event) => {
      if (from?.moved) event.stopPropagation();
      from = null;
    }, { capture: true });
  }

  private paint(point: number): void {
    const intervals = this.map.intervals[point], turn = this.turnAt(point);
    const cell = this.cells[point]!, number = this.numbers[point]!;
    cell.classList.toggle("unknown", !intervals);
    cell.setAttribute("fill", !intervals ? "none" : turn !== null ? this.colour(turn) : `url(#${this.prefix}unfree)`);
    number.textContent = turn === null ? "" : fixed(turn, this.unit === "mm" ? 1 : 0);
    number.classList.toggle("on-light", turn !== null && turn / this.end > isLightFrom);
    if (intervals) {
      cell.replaceChildren(svg("title", {}, this.textOf(point)));
      cell.setAttribute("aria-label", this.textOf(point));
    }
    cell.classList.toggle("has-islands", (intervals?.length ?? 0) > 1);
  }

  /// How far a point turns or slides from its start; null if it is not free there, or not known.
  private turnAt(point: number): number | null {
    const free = fromStart(this.map.intervals[point] ?? [], this.start);
    return free && free[1] - this.start;
  }

  /// The line of equal values through each square of four points: it crosses a side between a point below and one above.
  private drawLine(): void {
    const { x, y } = this.plane, across = this.columns.values.length, up = this.rows.values.length, line = this.end / 2;
    let path = "";
    for (let row = 0; row + 1 < up; ++row)
      for (let column = 0; column + 1 < across; ++column) {
        const corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([i, k]) => [column + i!, row + k!] as const);
        const turns = corners.map(([i, k]) => this.turnAt(k * across + i) ?? 0);
        const crossings = corners.flatMap(([i, k], c) => {
          const next = (c + 1) % 4, [a, b] = [turns[c]!, turns[next]!], share = (line - a) / (b - a), [toI, toK] = corners[next]!;
          return a >= line === b >= line ? [] : [`${x(i + share * (toI - i)).toFixed(1)} ${y(k + share * (toK - k)).toFixed(1)}`];
        });
        for (let c = 0; c < crossings.length; c += 2) path += `M${crossings[c]}L${crossings[c + 1]}`;
      }
    this.line.setAttribute("d", path);
  }

  private legend(): HTMLElement {
    const canvas = html("canvas", { class: "map-scale", width: 128, height: 1, "aria-hidden": "true" });
    const context = canvas.getContext("2d")!;
    for (let i = 0; i < canvas.width; ++i) {
      context.fillStyle = this.colour((this.end * i) / (canvas.width - 1));
      context.fillRect(i, 0, 1, 1);
    }
    return html("p", { class: "small map-legend" }, `${withUnit("0", this.unit)} `, canvas, ` ${words.orMore(withUnit(String(this.end), this.unit))}`,
      html("span", { class: "key" }, html("span", { class: "map-line-key", "aria-hidden": "true" }), ` ${withUnit(plain(this.end / 2), this.unit)}`),
      html("span", { class: "key" }, html("span", { class: "has-islands-key", "aria-hidden": "true" }), ` ${words.severalKey}`));
  }

  /// The held coordinates of a point.
  private placeOf(point: number): string {
    const { columns, rows } = this, across = columns.values.length;
    const said = ({ unit }: typeof columns, value: number) => withUnit(heldText(value, unit), unit);
    return words.mapPlace(spaced(columns.name), said(columns, columns.values[point % across]!), spaced(rows.name), said(rows, rows.values[Math.floor(point / across)]!));
  }

  private textOf(point: number): string {
    const free = this.map.intervals[point]!.map(([low, high, atLow, atHigh]) =>
      [words.freeFrom(this.endText(low), this.endText(high)), ...(atLow === 2 || atHigh === 2 ? [words.byLigament] : [])].join(" ")).join(", ");
    return words.mapPoint(this.placeOf(point), spaced(this.map.vary), free || words.notFree);
  }

  private endText(value: number): string {
    return withUnit(fixed(value, this.unit === "mm" ? 2 : 1), this.unit);
  }

  private data(): (string | number | null)[][] {
    const { columns, rows, unit, map: { intervals } } = this, across = columns.values.length;
    return [
      [`${columns.name}_${columns.unit}`, `${rows.name}_${rows.unit}`, `low_${unit}`, `high_${unit}`, "contact_at_low", "contact_at_high", "ligament_at_low", "ligament_at_high"],
      ...intervals.flatMap((list, point) => list.map(([low, high, ...ends]) => [
        columns.values[point % across]!, rows.values[Math.floor(point / across)]!,
        low, high, ...[1, 2].flatMap((by) => ends.map((end) => (end === by ? 1 : 0))),
      ])),
    ];
  }
}
