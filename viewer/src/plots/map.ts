import { scaleBand, scaleLinear, scaleSequential } from "d3-scale";
import { interpolateCividis } from "d3-scale-chromatic";
import { html, spaced, svg } from "../dom";
import { fixed, plain } from "../numbers";
import type { Interval, MapAnswer } from "../report";
import { roving } from "../roving";
import { words } from "../words";
import { figure, pressable } from "./figure";

const width = 560, left = 52, right = 10, top = 8, bottom = 42, stripHeight = 46;
/// Cells of at least this size show their degrees.
const roomForNumber = { width: 25, height: 13 };
/// A press that moves less is not a drag.
const still_px = 4;
/// Cividis is light from here on.
const isLightFrom = 0.55;

const scaleEnd_deg = 120;

/// Degrees by the number of a column or row, between them too, and back.
function axisOf(values_deg: readonly number[]): { last: number; at: (place: number) => number; invert: (deg: number) => number } {
  const last = values_deg.length - 1, first = values_deg[0]!, step = last > 0 ? (values_deg[last]! - first) / last : 1;
  return {
    last, at: (place) => Number((first + step * Math.min(last, Math.max(0, place))).toFixed(1)), invert: (deg) => (deg - first) / step,
  };
}

/// The interval that holds the start of a point's rotations.
function fromStart(intervals: readonly Interval[], start: number): Interval | null {
  return intervals.find(([low, high]) => low <= start && start <= high) ?? null;
}

export interface MapHooks {
  /// Goes to a point of the grid.
  go: (column_deg: number, row_deg: number) => void;
  /// Goes anywhere, while dragged.
  drag: (column_deg: number, row_deg: number) => void;
}

/// How far the third angle goes over two held ones. A cell pressed moves the joint there and shows all of its free intervals; a cross
/// is where the joint is, and drags.
export class MapPlot {
  readonly element: HTMLElement;
  private readonly cells: SVGRectElement[] = [];
  private readonly numbers: SVGTextElement[] = [];
  private readonly cross = svg("g", { class: "cross", "aria-hidden": "true" });
  private readonly plane;
  private readonly isRoomy: boolean;
  private readonly strip = svg("svg", { viewBox: `0 0 ${width} ${stripHeight}`, class: "plot", "aria-hidden": "true" });
  private readonly readout = html("p", { "aria-live": "polite" }, words.severalFree);
  private readonly colour;

  constructor(private readonly map: MapAnswer, private readonly hooks: MapHooks | null, private readonly prefix = "") {
    const { columns, rows } = map;
    const cellsHigh = Math.max(110, Math.min(250, 24 * rows.values_deg.length));
    const height = top + cellsHigh + bottom;
    this.colour = scaleSequential(interpolateCividis).domain([0, scaleEnd_deg]).clamp(true);
    const x = scaleBand<number>(columns.values_deg.map((_, i) => i), [left, width - right]);
    const y = scaleBand<number>(rows.values_deg.map((_, i) => i), [top + cellsHigh, top]);
    this.isRoomy = x.bandwidth() >= roomForNumber.width && y.bandwidth() >= roomForNumber.height;
    this.plane = {
      x: scaleLinear([0, columns.values_deg.length - 1], [x(0)! + x.bandwidth() / 2, x(columns.values_deg.length - 1)! + x.bandwidth() / 2]),
      y: scaleLinear([0, rows.values_deg.length - 1], [y(0)! + y.bandwidth() / 2, y(rows.values_deg.length - 1)! + y.bandwidth() / 2]),
      columns: axisOf(columns.values_deg), rows: axisOf(rows.values_deg),
    };
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot map" },
      svg("defs", {}, svg("pattern", { id: `${prefix}unfree`, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
        svg("rect", { width: 6, height: 6, class: "unfree-back" }), svg("rect", { width: 2, height: 6, class: "unfree-line" }))));
    rows.values_deg.forEach((rowDeg, row) => columns.values_deg.forEach((columnDeg, column) => {
      const point = row * columns.values_deg.length + column;
      const cell = svg("rect", {
        x: x(column)!, y: y(row)!, width: x.bandwidth() + 0.4, height: y.bandwidth() + 0.4, class: "cell", fill: "none",
      });
      picture.append(pressable(cell, this.placeOf(point), () => {
        this.describe(point);
        this.hooks?.go(columnDeg, rowDeg);
      }));
      this.cells.push(cell);
      this.numbers.push(svg("text", {
        x: x(column)! + x.bandwidth() / 2, y: y(row)! + y.bandwidth() / 2 + 3.5, "text-anchor": "middle", class: "cell-number", "aria-hidden": "true",
      }));
    }));
    if (this.isRoomy) picture.append(...this.numbers);
    roving(this.cells, columns.values_deg.length);
    const every = (count: number) => Math.max(1, Math.ceil(count / 8));
    columns.values_deg.forEach((value, i) => {
      if (i % every(columns.values_deg.length) === 0)
        picture.append(svg("text", { x: x(i)! + x.bandwidth() / 2, y: top + cellsHigh + 15, "text-anchor": "middle" }, `${plain(value)}°`));
    });
    rows.values_deg.forEach((value, i) => {
      if (i % every(rows.values_deg.length) === 0)
        picture.append(svg("text", { x: left - 6, y: y(i)! + y.bandwidth() / 2 + 4, "text-anchor": "end" }, `${plain(value)}°`));
    });
    picture.append(
      svg("text", { x: (left + width - right) / 2, y: height - 8, "text-anchor": "middle" }, spaced(columns.angle)),
      svg("text", { transform: `translate(15 ${top + cellsHigh / 2}) rotate(-90)`, "text-anchor": "middle" }, spaced(rows.angle)),
      this.cross);
    this.cross.append(
      svg("line", { x1: -9, x2: 9, y1: 0, y2: 0 }), svg("line", { x1: 0, x2: 0, y1: -9, y2: 9 }), svg("circle", { r: 5 }));
    this.setPose(Number.NaN, Number.NaN);
    if (this.hooks) this.dragBy(picture, this.hooks);
    const caption = words.mapCaption(spaced(map.vary), spaced(columns.angle), spaced(rows.angle));
    const drawn = figure({ name: "map", caption, picture, data: () => this.data() }, this.legend());
    this.element = html("div", { class: "map-place" }, drawn, html("div", { class: "map-readout" }, this.strip, this.readout));
    map.intervals.forEach((_, point) => this.paint(point));
  }

  /// Takes the intervals of a point.
  set(point: number, intervals: Interval[]): void {
    this.map.intervals[point] = intervals;
    this.paint(point);
  }

  /// One line while points are missing, then empty.
  progress(): string {
    const total = this.cells.length, done = this.map.intervals.filter((known) => known !== undefined).length;
    return done < total ? words.mapProgress(done, total) : "";
  }

  /// Where the joint is; outside the map it has no cross.
  setPose(column_deg: number, row_deg: number): void {
    const { x, y, columns, rows } = this.plane;
    const [column, row] = [columns.invert(column_deg), rows.invert(row_deg)];
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
    const intervals = this.map.intervals[point];
    const cell = this.cells[point]!, number = this.numbers[point]!;
    const free = intervals ? fromStart(intervals, this.map.start_deg) : null;
    const turn = free ? free[1] - this.map.start_deg : null;
    cell.classList.toggle("unknown", !intervals);
    cell.setAttribute("fill", !intervals ? "none" : turn !== null ? this.colour(turn) : `url(#${this.prefix}unfree)`);
    number.textContent = turn === null ? "" : fixed(turn, 0);
    number.classList.toggle("on-light", turn !== null && turn / scaleEnd_deg > isLightFrom);
    if (intervals) {
      cell.replaceChildren(svg("title", {}, this.textOf(point)));
      cell.setAttribute("aria-label", this.textOf(point));
    }
    cell.classList.toggle("has-islands", (intervals?.length ?? 0) > 1);
  }

  private legend(): HTMLElement {
    const canvas = html("canvas", { class: "map-scale", width: 128, height: 1, "aria-hidden": "true" });
    const context = canvas.getContext("2d")!;
    for (let i = 0; i < canvas.width; ++i) {
      context.fillStyle = this.colour((scaleEnd_deg * i) / (canvas.width - 1));
      context.fillRect(i, 0, 1, 1);
    }
    return html("p", { class: "small map-legend" }, "0° ", canvas, ` ${words.orMore(scaleEnd_deg)}`,
      html("span", { class: "key" }, html("span", { class: "has-islands-key", "aria-hidden": "true" }), ` ${words.severalKey}`));
  }

  /// The held angles of a point.
  private placeOf(point: number): string {
    const { columns, rows } = this.map;
    const column = columns.values_deg[point % columns.values_deg.length]!;
    const row = rows.values_deg[Math.floor(point / columns.values_deg.length)]!;
    return words.mapPlace(spaced(columns.angle), plain(column), spaced(rows.angle), plain(row));
  }

  private textOf(point: number): string {
    const free = this.map.intervals[point]!.map(([low, high]) => words.freeFrom(fixed(low, 1), fixed(high, 1))).join(", ");
    return words.mapPoint(this.placeOf(point), spaced(this.map.vary), free || words.notFree);
  }

  /// All free intervals of a point, as a strip.
  private describe(point: number): void {
    const intervals = this.map.intervals[point] ?? [];
    const x = (deg: number) => left + ((deg + 180) / 360) * (width - left - right);
    this.strip.replaceChildren(
      svg("line", { x1: x(-180), x2: x(180), y1: 16, y2: 16, class: "grid" }),
      ...intervals.map(([low, high]) =>
        svg("rect", { x: x(low), y: 9, width: Math.max(1, x(high) - x(low)), height: 14, class: "bar" })),
      ...[-180, -90, 0, 90, 180].map((tick) => svg("text", { x: x(tick), y: 40, "text-anchor": "middle" }, `${plain(tick)}°`)));
    this.readout.textContent = this.map.intervals[point] ? this.textOf(point) : this.placeOf(point);
  }

  private data(): (string | number | null)[][] {
    const { columns, rows, intervals } = this.map;
    return [
      [`${columns.angle}_deg`, `${rows.angle}_deg`, "low_deg", "high_deg", "contact_at_low", "contact_at_high"],
      ...intervals.flatMap((list, point) => list.map((interval) => [
        columns.values_deg[point % columns.values_deg.length]!, rows.values_deg[Math.floor(point / columns.values_deg.length)]!,
        ...interval,
      ])),
    ];
  }
}
