import { html, named, namesOf } from "../dom";
import { clockDrawing } from "../plots/clock";
import { layOut, type Drawing } from "../plots/figure";
import { limitsDrawing } from "../plots/limits";
import { MapPlot } from "../plots/map";
import { planCurveDrawing } from "../plots/plan_curve";
import { SweepMap } from "../plots/sweep_map";
import { fromBefore, ribbonOf } from "../planned";
import { scopeOf, type ReportText } from "../report";
import { bandText, comparedText, firstFigures, hasLimits, headlineMotion, heldOf, notesBeside, zeroOf } from "../result";
import { motionName, words } from "../words";
import { comparisonTable } from "./compare";
import { headingOf } from "./header";
import { methodOf, sourcesOf } from "./numbers";
import { planInShort } from "./plan";
import { measureTables, shapeDrawings } from "./shape";
import { sentenceOf, type Extreme } from "./strip";
import type { ShownSweep } from "./sweep";

/// The page on paper: a sheet of the answer with its picture, limits and scope; then all figures, the method and the files.
export class Paper {
  readonly element: HTMLElement;
  /// The picture's size, in which its letters are no smaller than all others of the sheet.
  readonly pictureSize: { width: number; height: number };
  private readonly image: HTMLImageElement;
  private readonly sentence = html("p", {});
  private readonly caption = html("p", { class: "small" });
  private readonly notes = html("div", {});

  constructor(
    text: ReportText, counts: { fixed: [number, number]; mobile: [number, number] }, extremes: readonly Extreme[], sweep: ShownSweep | null,
    ofLoad: string | null, recorded: Drawing | null) {
    const { rom, map } = text, headline = headlineMotion(text), isLimited = hasLimits(text), held = heldOf(text);
    const figures = rom && isLimited && ofLoad === null
      ? firstFigures(text).map((motion) =>
        [motionName(motion.name), fromBefore(text, motion), bandText(motion), comparedText(motion, rom, zeroOf(rom))] as const)
      : extremes.map(({ name, value, at }) => [name, value, "", at] as const);
    // Hours are those of the report.
    const clock = rom && !text.by_hand && clockDrawing(rom.motions, rom.clock_plane, null);
    const notes = notesBeside(rom), compared = comparisonTable(text), ribbon = ribbonOf(text);
    const scope = html("p", { class: "small" }, words.scope(scopeOf(text)));
    this.pictureSize = { width: 700, height: compared || text.plan ? 225 : 355 };
    this.image = html("img", { alt: "", ...this.pictureSize });
    this.sentence.textContent = ofLoad ??
      (isLimited && headline ? sentenceOf(headline, text) : rom ? words.noLimitsInContact : words.noLimitsSentence(text.rom_error ?? ""));
    const first = html("div", { class: "sheet" }, html("h1", {}, headingOf(text)), ...(ribbon ? [html("p", { class: "ribbon" }, ribbon)] : []),
      ...(text.note ? [html("p", {}, text.note)] : []),
      html("div", { class: "paper-results" }, ...figures.map(([name, value, band, normal]) =>
        html("div", {}, html("span", {}, named(name)), html("b", {}, value), html("span", {}, [band, normal].filter(Boolean).join("; "))))),
      this.sentence,
      ...(notes.length ? [html("p", { class: "warning" }, html("b", {}, words.noted(notes.length)), " ", notes.map((note) => note.text).join("; "))] : []),
      html("div", { class: "paper-picture" }, this.image, this.caption),
      ...(isLimited && held !== null ? [html("h3", {}, words.heldLimits(held))] : []),
      ...(rom && isLimited ? [html("div", { class: "paper-figures" }, drawn(limitsDrawing(rom.motions)), ...(clock ? [drawn(clock, 290, 215)] : []))] : []),
      ...(text.plan
        ? [html("div", { class: "paper-plan" }, ...planInShort(text.plan, namesOf(text.joint)))]
        : []),
      ...(compared ? [compared] : []), scope);
    const filesBefore = text.before?.rom?.provenance, curve = text.plan && planCurveDrawing(text.plan.curve), { measures } = text;
    const second = html("div", { class: "sheet" },
      ...(map && !text.by_hand ? [drawn(new MapPlot(map, null, "paper-").drawing, 700, 200)] : []),
      ...(recorded ? [drawn(recorded, 700, 260)] : []), ...(curve ? [drawn(curve, 700, 170)] : []),
      ...(measures ? [html("h2", {}, words.measures), html("div", { class: "paper-measures" }, ...measureTables(measures),
        ...shapeDrawings(measures).map((drawing) => drawn(drawing, 345, 140)))] : []),
      ...(sweep ? [html("h2", {}, words.sweep), zoneOf(sweep, text)] : []),
      html("h2", {}, words.method), ...methodOf(text, counts),
      ...(rom?.provenance ? [html("h2", {}, words.sourceFiles), ...sourcesOf(rom.provenance)] : []),
      ...(filesBefore ? sourcesOf(filesBefore, words.filesBefore).slice(-1) : []), this.notes);
    this.element = html("div", {}, first, second);
    // Readers of the screen do not get the same text twice.
    for (const region of this.element.querySelectorAll("[tabindex]")) region.removeAttribute("tabindex");
    for (const region of this.element.querySelectorAll("[role=button]")) region.removeAttribute("role");
  }

  /// The user's notes and pins, under a title that says so; nothing if there are none.
  setNotes(text: string, pins: readonly { place: string; text: string }[]): void {
    const said = text.trim() ? [html("p", { class: "user-text", dir: "auto" }, text)] : [];
    const list = html("ol", {}, ...pins.map((pin) => html("li", {}, ...(pin.text ? [html("bdi", {}, pin.text), html("br")] : []), pin.place)));
    this.notes.replaceChildren(...(said.length || pins.length ? [html("h2", {}, words.notesOfUser), ...said, ...(pins.length ? [list] : [])] : []));
  }

  /// A picture of the scene and its description, which is read once if it is the sentence.
  setPicture(source: string, caption: string): void {
    this.image.src = source;
    this.image.alt = caption;
    this.caption.textContent = caption;
    this.caption.hidden = caption === this.sentence.textContent;
  }
}

/// The safe zone with the point of the joint as it is, and the notes that it must be read with.
function zoneOf({ stored, margins, least }: ShownSweep, { posed }: ReportText): HTMLElement {
  const map = new SweepMap(stored, margins, least, () => undefined, "paper-");
  const values = new Map((posed?.parts ?? []).flatMap(({ name, parameters }) => parameters.map((each) => [`${name}.${each.name}`, each.value])));
  map.show(stored.parameters.map(({ name }) => values.get(name) ?? NaN));
  layOut(map.drawing, 700, stored.parameters.length > 1 ? 180 : 70);
  return html("div", {}, map.element, html("p", { class: "small" }, ...stored.sweep_notes.map(({ text }) => `${words.sweepNoted(text)} `)));
}

/// A drawing and its caption; one without a size of its own gets this one.
function drawn({ picture, caption, lay }: Pick<Drawing, "picture" | "caption"> & Partial<Drawing>, width = 0, height = 0): HTMLElement {
  if (lay) layOut({ picture, lay }, width, height);
  return html("figure", {}, picture, html("figcaption", {}, caption));
}
