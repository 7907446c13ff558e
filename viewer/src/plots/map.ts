import { scaleBand, scaleSequential } from "d3-scale";
import { interpolateCividis } from "d3-scale-chromatic";
import { html, spaced, svg } from "../dom";
import type { Interval, MapAnswer } from "../report";
import { words } from "../words";
import { figure, pressable } from "./figure";

const width = 460, left = 52, right = 10, top = 8, bottom = 42, stripHeight = 46;

const scaleEnd_deg = 120;

/// The interval that holds the start of a point's rotations.
function fromStart(intervals: readonly Interval[], start: number): Interval | null {
  return intervals.find(([low, high]) => low <= start && start <= high) ?? null;
}

/// How far the third angle goes over two held ones. A cell pressed moves the joint there and shows all of its free intervals.
export class MapPlot {
  readonly element: HTMLElement;
  private readonly cells: SVGRectElement[] = [];
  private readonly strip = svg("svg", { viewBox: `0 0 ${width} ${stripHeight}`, class: "plot", "aria-hidden": "true" });
  private readonly told = html("p", { "aria-live": "polite" });
  private readonly colour;

  constructor(private readonly map: MapAnswer, private readonly go: ((column_deg: number, row_deg: number) => void) | null) {
    const { columns, rows } = map;
    const cellsHigh = Math.max(120, Math.min(300, (width - left - right) * (rows.values_deg.length / columns.values_deg.length)));
    const height = top + cellsHigh + bottom;
    this.colour = scaleSequential(interpolateCividis).domain([0, scaleEnd_deg]).clamp(true);
    const x = scaleBand<number>(columns.values_deg.map((_, i) => i), [left, width - right]);
    const y = scaleBand<number>(rows.values_deg.map((_, i) => i), [top + cellsHigh, top]);
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "plot" },
      svg("defs", {}, svg("pattern", { id: "unfree", width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
        svg("rect", { width: 6, height: 6, class: "unfree-back" }), svg("rect", { width: 2, height: 6, class: "unfree-line" }))));
    rows.values_deg.forEach((rowDeg, row) => columns.values_deg.forEach((columnDeg, column) => {
      const point = row * columns.values_deg.length + column;
      const cell = svg("rect", {
        x: x(column)!, y: y(row)!, width: x.bandwidth() + 0.4, height: y.bandwidth() + 0.4, class: "cell",
      });
      picture.append(pressable(cell, this.placeOf(point), () => {
        this.tell(point);
        this.go?.(columnDeg, rowDeg);
      }));
      this.cells.push(cell);
    }));
    const every = (count: number) => Math.max(1, Math.ceil(count / 8));
    columns.values_deg.forEach((value, i) => {
      if (i % every(columns.values_deg.length) === 0)
        picture.append(svg("text", { x: x(i)! + x.bandwidth() / 2, y: top + cellsHigh + 15, "text-anchor": "middle" }, `${value}°`));
    });
    rows.values_deg.forEach((value, i) => {
      if (i % every(rows.values_deg.length) === 0)
        picture.append(svg("text", { x: left - 6, y: y(i)! + y.bandwidth() / 2 + 4, "text-anchor": "end" }, `${value}°`));
    });
    picture.append(
      svg("text", { x: (left + width - right) / 2, y: height - 8, "text-anchor": "middle" }, spaced(columns.angle)),
      svg("text", { transform: `translate(11 ${top + cellsHigh / 2}) rotate(-90)`, "text-anchor": "middle" }, spaced(rows.angle)));
    const caption = words.mapCaption(spaced(map.vary), spaced(columns.angle), spaced(rows.angle));
    this.element = html("div", {}, figure({ name: "map", caption, picture, data: () => this.data() }), this.legend(), this.strip, this.told);
    map.intervals.forEach((_, point) => this.paint(point));
  }

  /// The intervals of a point are known now.
  set(point: number, intervals: Interval[]): void {
    this.map.intervals[point] = intervals;
    this.paint(point);
  }

  /// In one line while points are missing, then nothing.
  progress(): string {
    const total = this.cells.length, done = this.map.intervals.filter((known) => known !== undefined).length;
    return done < total ? words.mapProgress(done, total) : "";
  }

  private paint(point: number): void {
    const intervals = this.map.intervals[point];
    const cell = this.cells[point]!;
    const free = intervals ? fromStart(intervals, this.map.start_deg) : null;
    cell.setAttribute("fill", !intervals ? "none" : free ? this.colour(free[1] - this.map.start_deg) : "url(#unfree)");
    if (intervals) {
      cell.replaceChildren(svg("title", {}, this.textOf(point)));
      cell.setAttribute("aria-label", this.textOf(point));
    }
    cell.classList.toggle("has-islands", (intervals?.length ?? 0) > 1);
  }

  private legend(): HTMLElement {
    const canvas = html("canvas", { id: "map-scale", width: 128, height: 1, "aria-hidden": "true" });
    const context = canvas.getContext("2d")!;
    for (let i = 0; i < canvas.width; ++i) {
      context.fillStyle = this.colour((scaleEnd_deg * i) / (canvas.width - 1));
      context.fillRect(i, 0, 1, 1);
    }
    return html("p", { class: "small" }, "0° ", canvas, ` ${words.orMore(scaleEnd_deg)}`,
      html("span", { class: "key" }, html("span", { class: "has-islands-key", "aria-hidden": "true" }), ` ${words.severalFree}`));
  }

  /// The held angles of a point.
  private placeOf(point: number): string {
    const { columns, rows } = this.map;
    const column = columns.values_deg[point % columns.values_deg.length]!;
    const row = rows.values_deg[Math.floor(point / columns.values_deg.length)]!;
    return words.mapPlace(spaced(columns.angle), column, spaced(rows.angle), row);
  }

  private textOf(point: number): string {
    const free = this.map.intervals[point]!.map(([low, high]) => words.freeFrom(low.toFixed(1), high.toFixed(1))).join(", ");
    return words.mapPoint(this.placeOf(point), spaced(this.map.vary), free || words.notFree);
  }

  /// All free intervals of a point, as a strip.
  private tell(point: number): void {
    const intervals = this.map.intervals[point] ?? [];
    const x = (deg: number) => left + ((deg + 180) / 360) * (width - left - right);
    this.strip.replaceChildren(
      svg("line", { x1: x(-180), x2: x(180), y1: 16, y2: 16, class: "grid" }),
      ...intervals.map(([low, high]) =>
        svg("rect", { x: x(low), y: 9, width: Math.max(1, x(high) - x(low)), height: 14, class: "bar" })),
      ...[-180, -90, 0, 90, 180].map((tick) => svg("text", { x: x(tick), y: 40, "text-anchor": "middle" }, `${tick}°`)));
    this.told.textContent = this.map.intervals[point] ? this.textOf(point) : this.placeOf(point);
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
