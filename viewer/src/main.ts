import { CoreClient } from "./core/client";
import { lineOf } from "./core/error_line";
import type { BothValues, Brushed, Coordinates, JointArrays, MapQuestion, MotionFrames, NamedFile, Proposal, Query, ShownQuantity, Turned, Values } from "./core/protocol";
import { button, checkbox, choice, fold, html, named, section, shortened, spaced } from "./dom";
import { jointArraysOf } from "./joint_arrays";
import { clearMessages, post, warn } from "./messages";
import { blockOf, copiedOf, countOf, type Copied, type UserNotes } from "./notes_block";
import { clockTime, fixed } from "./numbers";
import { keepPage, notesBlock, pageWith } from "./page_copy";
import { Clearance } from "./panels/clearance";
import { ComparePanel } from "./panels/compare";
import { DisplayPanel } from "./panels/display";
import { DropPanel, isJointFile } from "./panels/drop";
import { addEditPanels } from "./panels/edits";
import { figuresPanel } from "./panels/figures";
import { FreeAngles } from "./panels/free_angles";
import { LabelDrop } from "./panels/label_drop";
import { actions, copyLink, headingOf, listenToKeys } from "./panels/header";
import { MotionPanel } from "./panels/motion";
import { NotesPanel } from "./panels/notes";
import { numberFolds } from "./panels/numbers";
import { takeDrops } from "./panels/report_drop";
import { Paper } from "./panels/paper";
import { PlanPanel } from "./panels/plan";
import { addPlanPanel } from "./panels/plan_tab";
import { PointerPanel } from "./panels/pointer";
import { RecordedPanel, type Frame } from "./panels/recorded";
import { shapePanel } from "./panels/shape";
import { placeOf, ResultStrip, sentenceOf } from "./panels/strip";
import { Tabs } from "./panels/tabs";
import { pictureOf } from "./panels/worst_picture";
import { ZonePanel } from "./panels/zones";
import { clockDrawing } from "./plots/clock";
import { figure } from "./plots/figure";
import { MapPlot } from "./plots/map";
import { Plateau } from "./plots/plateau";
import {
  bytesOf, inflated, Report, scopeOf, textOfProposal, type MapAnswer, type MotionAnswer, type ReportText, type StoredPose,
} from "./report";
import { droppedMotion, recordedOf, type RecordedMotion } from "./recorded_motion";
import { headlineMotion } from "./result";
import { saveBlob } from "./save";
import { JointScene, type BodyName } from "./scene/scene";
import { readViewState, writeViewState } from "./view_state";
import { motionName, words } from "./words";

const translationNames = ["x", "y", "z"];
const quantities = Object.keys(words.quantity) as ShownQuantity[];
const storedQuantities: readonly ShownQuantity[] = ["gap", "removed", "none"];
/// From here on figures stand beside the other panels.
const wide = matchMedia("(min-width: 150rem)");
/// The picture for paper waits until the page has answered and is idle.
const pictureAfter_ms = 1500;

function found<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

function textOf(id: string): string | null {
  return document.getElementById(id)?.textContent ?? null;
}

/// A scene, or only a line if the browser shows none.
function sceneOf(arrays: JointArrays, parts: ReportText["parts"], label: string): JointScene | null {
  try {
    return new JointScene(found("scene"), arrays.fixed, arrays.mobile, parts, label, arrays.side === 0 ? "right" : "left");
  } catch {
    warn(words.noWebGl);
    return null;
  }
}

/// Content that no report holds: its user's notes, and the motion of a dropped file. A joint of dropped files takes no notes: no copy of the
/// page would have it.
interface Added {
  notes?: UserNotes | undefined;
  motion?: RecordedMotion;
  isDropped?: boolean;
}

/// The page of one report.
class Page {
  private readonly scene: JointScene | null;
  private readonly display: DisplayPanel;
  private readonly motion: MotionPanel;
  private readonly strip: ResultStrip;
  private readonly tabs: Tabs;
  private readonly paper: Paper;
  private readonly recorded: RecordedPanel | null;
  private readonly notes: NotesPanel | null;
  private core: CoreClient | null = null;
  private freeAngles: FreeAngles | null = null;
  private clearance: Clearance | null = null;
  private mapPlot: MapPlot | null = null;
  private plateau: { plot: Plateau; body: BodyName } | null = null;
  private zones: ZonePanel | null = null;
  private readonly plan: PlanPanel | null;
  private readonly removed: BothValues | null;
  private fragmentTimer = 0;
  /// Whether the core found the bearing surface; else it is the report's.
  private bearingIsFound: boolean;
  /// One of the report's poses, if the page cannot compute.
  private storedPose: StoredPose | null = null;
  private poseChoice: HTMLSelectElement | null = null;
  private readonly closed = new AbortController();

  /// `report` holds the arrays of figures and poses that a joint dropped on the page has not; `computes` if the core answers; `added` is
  /// not part of any report.
  constructor(
    private readonly text: ReportText, private readonly arrays: JointArrays, private readonly report: Report | null, private readonly computes: boolean,
    added: Added = {}) {
    this.bearingIsFound = arrays.bearing === "found";
    const names = { fixed: named(text.joint.fixed), mobile: named(text.joint.mobile) };
    const heading = headingOf(text);
    document.title = words.pageTitle(shortened(text.title));
    found("title").textContent = heading;
    found("title").title = heading;
    this.scene = sceneOf(arrays, text.parts, words.sceneLabel(names.fixed, names.mobile));
    this.scene?.setJointRadius(text.rom?.bearing?.head?.radius_mm ?? null);
    this.motion = new MotionPanel(text, {
      moved: (at) => this.moved(at), arrived: (motion) => this.arrived(motion), showStored: computes ? null : (name) => this.showStored(name),
    });
    const motion = added.motion ?? (report && text.recorded && recordedOf(report, text.recorded));
    this.recorded = motion ? new RecordedPanel(
      motion, (frame) => this.showFrame(frame), this.scene && ((said) => this.pictureOfFrame(said))) : null;
    const extremes = this.recorded?.extremes() ?? [];
    this.strip = new ResultStrip(text, (motion) => this.motion.goToEnd(motion), (motion) => this.motion.canGo(motion), extremes, () => this.showFold("checks"));
    found("strip-place").replaceChildren(this.strip.element);
    this.plan = report && text.plan && new PlanPanel(this.scene, report, text.plan, names);
    const { fixed: fixedCount, mobile: mobileCount } = this.counts();
    this.removed = this.plan && this.plan.values({ fixed: fixedCount[0], mobile: mobileCount[0] });
    const has = { pressure: text.layers !== null, removed: this.plan !== null } as Partial<Record<ShownQuantity, boolean>>;
    this.display = new DisplayPanel(this.scene, {
      names, parts: text.parts, marks: computes ? ["contact", "bearing"] : ["bearing"], removed_mm: this.plan?.deepest_mm ?? 0,
      quantities: (computes ? quantities : storedQuantities).filter((key) => has[key] ?? true),
    }, () => this.recolour(), () => this.rememberView());
    if (report && text.zones.length) {
      this.zones = new ZonePanel(this.scene, report, text.zones, () => this.rememberView());
      this.display.element.append(this.zones.element);
    }
    this.placeViewTools(names);
    this.notes = report && !added.isDropped ? new NotesPanel(this.scene, names, arrays, added.notes ?? { text: "", pins: [] }, () => this.putNotesOnPaper()) : null;
    const shape = text.measures ? shapePanel(text.measures, this.scene) : null;
    const compared = report && text.before ? new ComparePanel(this.scene, report, text.before, () => this.rememberView()) : null;
    if (compared) this.display.remember("before", compared.box, (on) => compared.show(on));
    this.tabs = this.placeTabs([compared?.details, shape?.details].filter((each) => each !== undefined));
    if (compared) addPlanPanel(compared.element);
    if (this.plan) addPlanPanel(this.plan.element);
    if (shape) addPlanPanel(shape.element);
    this.paper = new Paper(text, this.counts(), extremes);
    found("paper").replaceChildren(this.paper.element);
    this.putNotesOnPaper();
    this.placeActions();
    this.listen();
    this.applyFragment();
  }

  /// Takes the page's parts away, so that another page can be made of the same joint.
  close(): void {
    this.closed.abort();
    this.recorded?.stop();
    this.core?.close();
    this.scene?.canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context")?.loseContext();
    for (const place of ["scene", "strip-place", "view-tools", "legend-place", "side", "paper", "actions"]) found(place).replaceChildren();
    found("help").remove();
    document.body.classList.remove("wide");
  }

  /// Whether the page is about load: it opens on the recorded motion.
  private get opensOnLoad(): boolean {
    return this.text.layers !== null && this.recorded !== null;
  }

  private placeViewTools(names: Record<BodyName, string>): void {
    const { scene } = this, tools: HTMLElement[] = [];
    if (scene) {
      tools.push(button(words.fitJoint, () => scene.fitJoint()), button(words.fitAll, () => scene.fitAll()));
      const unit = () => (this.display.quantity === "none" ? "" : words.unit[this.display.quantity]);
      const pointer = new PointerPanel(scene, names, unit);
      this.display.element.append(this.display.legend, pointer.element);
      this.display.element.append(html("div", { class: "row" }, checkbox(words.orthographic, false, (on) => scene.setOrthographic(on)),
        button(words.saveSurfaces, () => void this.saveSurfaces())));
      found("legend-place").replaceChildren(pointer.readout);
      scene.onViewChange(() => this.rememberView());
    }
    const drawer = html("details", { id: "view-options", class: "popup" }, html("summary", {}, words.viewOptions), this.display.element);
    found("view-tools").replaceChildren(...tools, drawer);
  }

  private placeTabs(folds: readonly HTMLDetailsElement[]): Tabs {
    const { text } = this, details = html("section", { "aria-label": words.tab.details });
    const planPanels = html("div", { id: "plan-panels" }), planTab = html("section", { "aria-label": words.tab.plan }, planPanels);
    const licences = html("pre", { id: "licences", tabindex: 0 });
    const licencesFold = fold(words.licences, false, licences);
    licencesFold.addEventListener("toggle", () => void showLicences(licences), { once: true });
    details.append(
      ...(this.notes ? [this.notes.element] : []), ...numberFolds(text, this.counts(), [this.motion.answer, this.motion.depth, this.motion.took]), ...(this.plan ? [this.plan.details] : []),
      ...folds, html("p", {}, words.scope(scopeOf(text))), licencesFold);
    const figures = this.figures();
    const tabs = new Tabs(words.tabs, [
      { id: "motion", title: words.tab.motion, panel: this.motion.element }, { id: "figures", title: words.tab.figures, panel: figures },
      { id: "plan", title: words.tab.plan, panel: planTab }, { id: "details", title: words.tab.details, panel: details },
    ], () => undefined);
    tabs.setShown("plan", false);
    planPanels.addEventListener("filled", () => tabs.setShown("plan", true));
    found("side").replaceChildren(tabs.list, ...tabs.panels);
    const hasFigures = figures.querySelector("figure, button") !== null;
    const arrange = () => {
      tabs.setBeside("figures", wide.matches && hasFigures);
      document.body.classList.toggle("wide", wide.matches && hasFigures);
      if (!hasFigures) tabs.setShown("figures", false);
    };
    wide.addEventListener("change", arrange, { signal: this.closed.signal });
    arrange();
    if (this.opensOnLoad) tabs.show("figures");
    return tabs;
  }

  private placeActions(): void {
    found("actions").replaceChildren(...actions({
      picture: this.scene && (() => void this.savePicture()), print: () => window.print(), saveCopy: this.notes && (() => this.saveCopy()),
      copyLink: () => {
        this.writeView();
        void copyLink((message, ...parts) => post("status", message, ...parts));
      },
    }));
  }

  private listen(): void {
    const { signal } = this.closed;
    window.addEventListener("hashchange", () => this.applyFragment(), { signal });
    // Without a picture made for paper, paper shows the joint's present pose.
    window.addEventListener("beforeprint", () => this.takePictureForPaper(), { signal });
    window.addEventListener("beforeprint", () => this.putNotesOnPaper(), { signal });
    listenToKeys({
      "1": () => this.tabs.showNumber(1), "2": () => this.tabs.showNumber(2), "3": () => this.tabs.showNumber(3), "4": () => this.tabs.showNumber(4),
      f: () => this.scene?.fitJoint(), u: () => this.motion.undo(), "0": () => this.motion.set(this.text.reference_deg, this.text.reference_mm),
      " ": () => this.recorded?.toggle(), "?": () => found<HTMLDialogElement>("help").showModal(),
    }, signal);
  }

  sayIsCopy(copied: Copied): void {
    post("status", words.copyWith(countOf(copied)), button(words.readNotesOfUser, () => this.showFold("notes-of-user")));
  }

  /// A motion file as this joint's motion, and what is to be said of it. Rejects with the line of a file that is none.
  async readMotion(file: File): Promise<{ motion: RecordedMotion; remarks: string[] }> {
    if (!this.core) throw new Error(words.dropNeedsCore(named(file.name)));
    const columns = this.text.recorded_motion ? JSON.stringify(this.text.recorded_motion) : "";
    const frames = (await this.core.query({ of: "motion", file: { name: file.name, bytes: await file.arrayBuffer() }, columns })) as MotionFrames;
    return { motion: droppedMotion(file.name, frames, this.text), remarks: frames.remarks };
  }

  /// The user's notes and the address of the present view, for the page that takes this one's place.
  handOver(): UserNotes | undefined {
    this.writeView();
    this.close();
    return this.notes?.notes;
  }

  /// The curves, and the joint in the first frame.
  playFromStart(): void {
    this.tabs.show("figures");
    this.recorded?.show(0);
  }

  private showFold(id: string): void {
    this.tabs.show("details");
    const opened = found<HTMLDetailsElement>(id);
    opened.open = true;
    opened.scrollIntoView();
  }

  /// The page itself, with what the user added and the view at hand.
  private saveCopy(): void {
    this.writeView();
    saveBlob(`${this.fileName()}_copy.html`, pageWith(blockOf({ ...this.notes!.notes, view: location.hash })));
  }

  private putNotesOnPaper(): void {
    const { notes } = this;
    if (notes) this.paper.setNotes(notes.notes.text, notes.notes.pins.map((pin) => ({ place: notes.placeOf(pin), text: pin.text })));
  }

  private async savePicture(): Promise<void> {
    const { scene } = this;
    if (!scene) return;
    const title = `${headingOf(this.text)} · ${this.poseLine()}`;
    const blob = await scene.picture(title);
    saveBlob(`${this.fileName()}.png`, blob);
  }

  private async saveSurfaces(): Promise<void> {
    if (this.scene) saveBlob(`${this.fileName()}.glb`, await this.scene.exportGlb());
  }

  private fileName(): string {
    return shortened(this.text.title, 40).replaceAll(/[^\p{L}\p{N}]+/gu, "_");
  }

  /// "flexion 90.0°, adduction 0.0°, internal rotation 20.0°"
  private poseLine(): string {
    const { angles } = this.motion.coordinates;
    return this.text.coordinates.slice(0, this.text.joint.kind === "hinge" ? 1 : 3).map(({ name }, i) => `${spaced(name)} ${fixed(angles[i]!, 1)}°`).join(", ");
  }

  private hasWorstPicture = false;

  private takePictureForPaper(): void {
    if (this.hasWorstPicture || !this.scene) return;
    this.paper.setPicture(this.scene.pictureCanvas("").toDataURL("image/png"), `${words.poseHere} ${this.poseLine()}`);
  }

  /// The limit that the sentence is about, drawn for paper while nobody waits.
  private drawWorst(): void {
    const { text, arrays } = this, { rom, joint } = text;
    const headline = rom && headlineMotion(rom, joint.anatomy === "hip" && joint.kind !== "hinge");
    const pose = headline && text.poses.find(({ name }) => name === headline.name);
    if (!headline || !pose || headline.reason !== "contact" || !this.scene) return;
    window.setTimeout(() => {
      if (this.closed.signal.aborted) return;
      void pictureOf(text, arrays, pose, this.labelOf(headline), rom.bearing?.head?.radius_mm ?? null).then((picture) => {
        if (!picture) return;
        this.hasWorstPicture = true;
        this.paper.setPicture(picture, sentenceOf(headline, text));
      });
    }, pictureAfter_ms);
  }

  private labelOf(motion: MotionAnswer): string {
    return [motionName(motion.name), placeOf(motion, this.text)].filter(Boolean).join(": ");
  }

  /// The view in the address.
  private applyFragment(): void {
    const { coordinates, display, zone, camera } = readViewState(location.hash, Object.keys(this.referencePose()));
    const values = Object.entries(this.referencePose()).map(([name, reference]) => coordinates[name] ?? reference);
    if (camera && this.scene) this.scene.viewpoint = camera;
    this.display.apply(display);
    this.zones?.show(zone);
    if (this.computes) this.motion.set(values.slice(0, 3), values.slice(3));
    if (this.opensOnLoad && Object.keys(coordinates).length === 0) this.recorded?.show(0);
  }

  /// The joint is ready in the worker; poses are answered from now on.
  compute(core: CoreClient): void {
    const count = this.text.joint.kind === "hinge" ? 1 : 3;
    this.freeAngles = new FreeAngles(core, count, (vary, at, intervals) => this.motion.setFree(vary, at, intervals));
    this.clearance = new Clearance(core, this.arrays.mobile, (at, clear_mm) => this.motion.setClearance(at, clear_mm));
    if (this.arrays.bearing !== "found" && !this.arrays.bearing.counts) this.clearance.leaveOut(this.arrays.bearing.mobile ?? []);
    core.listen({
      shown: (at, shown, roundTrip_ms) => {
        this.stand(shown.pose);
        if (this.display.quantity === "none" || this.display.quantity === "removed") this.show(this.storedValues());
        const pairs = Array.from(shown.pairs);
        this.scene?.setMarked("contact", pairs.filter((_, i) => i % 2 === 0), pairs.filter((_, i) => i % 2 === 1));
        this.motion.show(shown, roundTrip_ms);
        this.freeAngles?.ask(at, shown.pose);
        if (!shown.inContact) this.clearance?.ask(at);
        document.documentElement.dataset["answered"] = String(Number(document.documentElement.dataset["answered"] ?? 0) + 1);
      },
      values: (values) => this.show(values),
      limit: () => undefined,
      depth: (depth) => this.motion.showDepth(depth),
      bearing: (triangles) => {
        if (this.bearingIsFound) this.clearance?.leaveOut(triangles);
        this.markBearing(triangles);
      },
      mapPoint: (point, intervals) => {
        this.mapPlot?.set(point, intervals);
        found("map-progress").textContent = this.mapPlot?.progress() ?? "";
      },
      failed: warn,
    });
    this.core = core;
    // For scripts in the console and for tests: docs/report.md, "From a script".
    Object.assign(globalThis, { condyle: { query: (query: Query) => core.query(query), scene: this.scene } });
    this.moved(this.motion.coordinates);
    core.askBearing();
    addEditPanels({
      core, scene: this.scene, text: this.text, arrays: this.arrays, report: this.report,
      brushed: (brushed, rests) => this.takeBrushed(brushed, rests), turned: (turned, rests) => this.takeTurned(turned, rests),
    });
    this.drawWorst();
  }

  /// The bone has changed, so the display of the pose is requested again.
  private takeBrushed({ body, vertices, depths_mm }: Brushed, rests: boolean): void {
    this.scene?.replaceBody(body, vertices);
    if (this.removed) this.removed[body] = { shown: Float32Array.from(depths_mm), marks: Uint8Array.from(depths_mm, (mm) => (mm > 0 ? 1 : 0)) };
    if (rests) this.ask(this.motion.coordinates);
  }

  /// The same for a joint whose parts turn: the bearing surface is found again.
  private takeTurned({ fixed: fixedBody, mobile }: Turned, rests: boolean): void {
    this.scene?.replaceBody("fixed", fixedBody);
    this.scene?.replaceBody("mobile", mobile);
    this.scene?.leaveLimit();
    this.strip.unmark();
    if (!rests) return;
    this.bearingIsFound = true;
    this.ask(this.motion.coordinates);
    this.core?.askBearing();
  }

  private show(values: BothValues | null): void {
    this.scene?.bodies.fixed.show(values?.fixed ?? null);
    this.scene?.bodies.mobile.show(values?.mobile ?? null);
    this.scene?.draw();
    const { quantity } = this.display;
    if (this.plateau && quantity !== "none") this.plateau.plot.show(values?.[this.plateau.body] ?? null, quantity, this.display.end);
  }

  private markBearing(triangles: Uint8Array): void {
    this.scene?.setMarked("bearing", [], [...triangles.keys()].filter((t) => triangles[t]));
  }

  /// For pages that cannot compute: poses that the report holds.
  useStoredPoses(why: string): void {
    warn(why);
    if ("mobile_roles" in this.text.arrays) this.markBearing(this.report!.array("mobile_roles", "u8").map((role) => role % 2));
    const names = this.text.poses.map(({ name }) => name);
    this.drawWorst();
    if (names.length === 0) return;
    const poses = choice<string>(
      words.precomputed, Object.fromEntries(names.map((name) => [name, spaced(name)])), names[0]!, (name) => this.showStored(name));
    this.poseChoice = poses.querySelector("select");
    this.motion.element.prepend(html("div", { class: "row" }, poses));
    this.showStored(names[0]!);
  }

  private showStored(name: string): void {
    const pose = this.text.poses.find((stored) => stored.name === name);
    if (!pose) return;
    if (this.poseChoice) this.poseChoice.value = name;
    this.motion.set(pose.coordinates_deg);
    this.storedPose = pose;
    this.stand(pose.pose);
    this.recolour();
    const motion = this.text.rom?.motions.find((known) => known.name === name) ?? null;
    this.motion.markEnd(motion);
    if (motion) return this.arrived({ ...motion, contact_point_mm: pose.contact_point_mm });
    this.scene?.leaveLimit();
    this.zones?.show(name);
  }

  /// Another quantity was requested.
  private recolour(): void {
    if (this.computes) return this.ask(this.motion.coordinates);
    const pose = this.display.quantity === "gap" ? this.storedPose : null;
    this.show(pose ? { fixed: this.storedGaps(pose.fixed_gaps), mobile: this.storedGaps(pose.mobile_gaps) } : this.storedValues());
  }

  /// Values that do not depend on the pose.
  private storedValues(): BothValues | null {
    return this.display.quantity === "removed" ? this.removed : null;
  }

  /// A frame of the recorded motion: its pose is in the report, its colours are computed. A gap has no pose: the joint stays.
  private showFrame({ angles, translation, X_FM }: Frame): void {
    if (angles.some(Number.isNaN)) return;
    this.motion.set(angles, translation);
    if (this.computes || X_FM.some(Number.isNaN)) return;
    this.storedPose = null;
    this.stand(X_FM);
    this.recolour();
  }

  private stand(X_FM: ArrayLike<number>): void {
    this.scene?.setPose(X_FM);
    this.notes?.setPose(X_FM);
  }

  /// The scene, once all of its colours belong to the pose requested last: the core answers in order.
  private async pictureOfFrame(said: string): Promise<Blob> {
    await this.core?.query({ of: "pose", at: this.motion.coordinates });
    return this.scene!.picture(`${headingOf(this.text)} · ${said}`);
  }

  private storedGaps(name: string): Values {
    const hundredths = this.report!.array(name, "i16"), none = 32767;
    return {
      shown: Float32Array.from(hundredths, (gap) => gap / 100), marks: Uint8Array.from(hundredths, (gap) => (gap === none ? 0 : 1)),
    };
  }

  private figures(): HTMLElement {
    const { rom, map, joint } = this.text;
    const go = this.computes || this.text.poses.length ? (motion: MotionAnswer) => this.motion.goToEnd(motion) : null;
    const hasLimits = rom?.motions.some(({ reason }) => reason !== "contact_at_start") ?? false;
    const clock = rom && clockDrawing(rom.motions, rom.clock_plane, go);
    return figuresPanel([
      { key: "curves", figures: [...this.plateaus(), ...(this.recorded ? [this.recorded.element] : [])] },
      { key: "map", figures: [
        ...(joint.kind !== "hinge" && (map || (this.computes && hasLimits)) ? [this.mapSection(map)] : []),
        ...(clock ? [clockSection(figure(clock))] : []),
      ] },
    ]);
  }

  /// The surface of a tibia that carries load.
  private plateaus(): HTMLElement[] {
    const { layers, joint } = this.text;
    if (!layers || joint.anatomy !== "knee" || !this.computes) return [];
    const height = (body: BodyName) => {
      const { vertices } = this.arrays[body];
      let sum = 0;
      for (let i = 1; i < vertices.length; i += 3) sum += vertices[i]!;
      return sum / vertices.length;
    };
    const body: BodyName = height("fixed") < height("mobile") ? "fixed" : "mobile";
    const plot = new Plateau(this.arrays[body], layers[body], named(joint[body]));
    this.plateau = { plot, body };
    return [plot.element];
  }

  /// The report's map, or a button that has the page compute one.
  private mapSection(map: MapAnswer | null): HTMLElement {
    const place = section(words.map);
    const showMap = (answer: MapAnswer) => {
      const angle = (name: string) => this.text.coordinates.findIndex((c) => c.name === name);
      const at = (column: number, row: number): [number, number, number] => {
        const { angles } = this.motion.coordinates;
        angles[angle(answer.columns.angle)] = column;
        angles[angle(answer.rows.angle)] = row;
        return angles;
      };
      this.mapPlot = new MapPlot(answer, this.computes ? {
        go: (column, row) => {
          const angles = at(column, row);
          angles[angle(answer.vary)] = answer.start_deg;
          this.motion.goTo(angles);
        },
        drag: (column, row) => this.motion.drag(at(column, row)),
      } : null);
      this.mapAngles = [angle(answer.columns.angle), angle(answer.rows.angle)];
      this.markOnMap(this.motion.coordinates);
      place.append(this.mapPlot.element);
    };
    if (map) {
      showMap(map);
      return place;
    }
    place.append(html("p", { id: "map-progress", role: "status" }));
    const ask = button(words.computeMap, () => {
      if (!this.core) return;
      ask.remove();
      const question = { ...coarseMap(), held: this.text.rom?.held_translation_mm ?? this.text.reference_mm } satisfies MapQuestion;
      const [column, row, vary] = [question.columnAngle, question.rowAngle, question.vary].map((i) => this.text.coordinates[i]!);
      showMap({
        columns: { angle: column!.name, opposite: column!.opposite, values_deg: question.columns },
        rows: { angle: row!.name, opposite: row!.opposite, values_deg: question.rows },
        vary: vary!.name, vary_opposite: vary!.opposite, start_deg: 0, intervals: [],
      });
      this.core.askMap(question);
    });
    place.append(ask);
    return place;
  }

  /// Numbers of the angles of the map's columns and rows.
  private mapAngles: [number, number] | null = null;

  private markOnMap({ angles }: Coordinates): void {
    if (this.mapAngles) this.mapPlot?.setPose(angles[this.mapAngles[0]]!, angles[this.mapAngles[1]]!);
  }

  private arrived(motion: MotionAnswer): void {
    this.scene?.arriveAt(motion.contact_point_mm, this.pinOf(motion), "mobile");
    this.zones?.show(motion.name);
    this.strip.describe(motion);
  }

  /// "1:08, neck on rim"
  private pinOf(motion: MotionAnswer): string {
    const place = placeOf({ ...motion, clock_hour: motion.clock_hour }, this.text);
    return motion.clock_hour === null ? place : `${clockTime(motion.clock_hour)}, ${place.replace(` at ${clockTime(motion.clock_hour)}`, "")}`;
  }

  private ask(at: Coordinates): void {
    const { quantity } = this.display;
    this.core?.ask(at, quantity === "removed" ? "none" : quantity, null);
  }

  private moved(at: Coordinates): void {
    this.clearance?.drop();
    this.ask(at);
    this.scene?.leaveLimit();
    this.strip.unmark();
    this.markOnMap(at);
    this.rememberView();
  }

  /// Coordinates by their names in the address.
  private referencePose(): Record<string, number> {
    const { coordinates, reference_deg, reference_mm } = this.text;
    return Object.fromEntries([
      ...coordinates.map(({ name }, i) => [name, reference_deg[i]!] as const),
      ...translationNames.map((name, i) => [name, reference_mm[i]!] as const),
    ]);
  }

  /// Browsers refuse an address that changes at every frame.
  private rememberView(): void {
    clearTimeout(this.fragmentTimer);
    this.fragmentTimer = window.setTimeout(() => this.writeView(), 300);
  }

  private writeView(): void {
    if (this.closed.signal.aborted) return;
    const { angles, translation } = this.motion.coordinates;
    const values = [...angles, ...translation];
    const coordinates = Object.fromEntries(
      Object.entries(this.referencePose()).map(([name, reference], i) => [name, values[i]!, reference] as const)
        .filter(([, value, reference]) => value !== reference));
    history.replaceState(null, "", writeViewState({
      coordinates, display: this.display.state, zone: this.zones?.motion ?? "", camera: this.scene?.viewpoint ?? null,
    }));
  }

  private counts(): { fixed: [number, number]; mobile: [number, number] } {
    const of = ({ vertices, triangles }: JointArrays["fixed"]): [number, number] => [vertices.length / 3, triangles.length / 3];
    return { fixed: of(this.arrays.fixed), mobile: of(this.arrays.mobile) };
  }
}

function clockSection(drawn: HTMLElement): HTMLElement {
  const made = section(words.clock, drawn);
  made.classList.add("clock-section");
  return made;
}

/// Internal rotation over flexion and adduction, every ten degrees.
function coarseMap(): MapQuestion {
  const every10 = (first: number, last: number) => Array.from({ length: (last - first) / 10 + 1 }, (_, i) => first + 10 * i);
  return { columnAngle: 0, rowAngle: 1, vary: 2, columns: every10(-20, 120), rows: every10(-40, 30) };
}

/// In full, once they are requested.
async function showLicences(place: HTMLElement): Promise<void> {
  const texts = new TextDecoder().decode(await inflated(bytesOf(textOf("licence-texts") ?? ""), "gzip"));
  place.textContent = `${textOf("licence-list") ?? ""}\n\n${texts}`;
}

/// The part of the file that computes cannot be read.
class CoreDamage extends Error {}

async function wasmBytes(): Promise<ArrayBuffer> {
  try {
    return await inflated(bytesOf(textOf("core") ?? ""), "gzip");
  } catch {
    throw new CoreDamage();
  }
}

function isCoreDamage(error: unknown): boolean {
  return error instanceof CoreDamage || /Aborted|WebAssembly|CompileError/.test(lineOf(error));
}

/// The page without a joint takes one from files; `shown` is called once it shows one. Returns what takes files.
function openEmpty(shown: () => void = () => undefined): DropPanel | undefined {
  if (!canCompute) return void warn(words.noWebAssemblyToRead);
  found("title").textContent = words.noData;
  found("scene").append(html("p", { class: "drop-hint" }, words.dropHint));
  const drops = new AbortController();
  const warnOnly = (message: string) => {
    clearMessages();
    warn(message);
  };
  const refuse = (error: unknown) => warnOnly(reasonOf(error));
  const leave = () => {
    clearMessages();
    panel.element.remove();
    found("scene").replaceChildren();
  };
  const show = (core: CoreClient, proposal: Proposal) => {
    leave();
    new Page(textOfProposal(proposal), proposal.joint, null, true).compute(core);
    shown();
  };
  const attempt = async (work: () => Promise<void>) => {
    try {
      await work();
      return true;
    } catch (error) {
      refuse(error);
      return false;
    }
  };
  const panel = new DropPanel({
    signal: drops.signal, labels: new LabelDrop(wasmBytes, show, refuse), refuse: warnOnly,
    meshes: (fixedFile, mobileFile, side) => attempt(async () => {
      const { core, proposal } = await CoreClient.propose(await wasmBytes(), fixedFile, mobileFile, side);
      show(core, proposal);
    }),
    jointFile: (files) => attempt(async () => {
      const report = await readJoint(files);
      drops.abort();
      leave();
      await showDropped(report);
      shown();
    }),
  });
  found("side").append(panel.element);
  return panel;
}

/// Reason why files were not taken, in a line.
function reasonOf(error: unknown): string {
  return isCoreDamage(error) ? words.coreDamagedToRead : lineOf(error);
}

/// The joint of a joint file and its meshes. Rejects with the line of a file that is not taken.
async function readJoint(files: readonly NamedFile[]): Promise<Report> {
  const [joint, other] = files.filter(({ path }) => isJointFile(path));
  if (other) throw new Error(words.dropOneJoint(named(joint!.path), named(other.path)));
  const paths = new Set<string>();
  for (const { path } of files) {
    if (paths.has(path)) throw new Error(words.dropSameName(named(path)));
    paths.add(path);
  }
  // A browser that is given two files of one name may number the second one.
  for (const path of paths) {
    const first = path.replace(/ \(\d+\)(\.[^./]*)$/, "$1");
    if (!path.includes("/") && first !== path && paths.has(first)) throw new Error(words.dropMaybeSameName(named(first), named(path)));
  }
  return Report.of(await CoreClient.blockOfJoint(await wasmBytes(), joint!, files));
}

/// The joint of dropped files, with what the page leaves to the command.
async function showDropped(report: Report): Promise<void> {
  await show(report, true);
  const { only_in_reports = [], taken_by_name = [] } = report.text;
  const lines = [
    ...(hasReport() ? [words.notTheReport] : []), ...taken_by_name.map(({ mesh, taken }) => words.takenByName(named(mesh), named(taken))),
    ...only_in_reports.map((table) => words.onlyInReports[table]),
  ];
  if (lines.length) post("status", lines.join(" "));
}

/// The notes of a saved copy; null for a page that is not a copy. It opens with the view it was saved with, unless the address gives another.
function copiedWith({ fixed, mobile }: JointArrays): Copied | null {
  const block = notesBlock();
  if (block === null) return null;
  try {
    const copied = copiedOf(block, { fixed: fixed.vertices.length / 3, mobile: mobile.vertices.length / 3 });
    if (!location.hash && copied.view) history.replaceState(null, "", copied.view);
    return copied;
  } catch (error) {
    warn(words.notesDamaged(lineOf(error)));
    return null;
  }
}

const canCompute = typeof WebAssembly !== "undefined";

/// Whether the file of this page is a report; else it is the page without a joint.
function hasReport(): boolean {
  return textOf("condyle-data") !== null;
}

async function open(): Promise<void> {
  keepPage();
  found("unfinished").remove();
  found("skip").textContent = words.skip;
  found("scope").textContent = words.footer;
  const data = textOf("condyle-data");
  if (data === null) return void openEmpty();
  await show(await Report.read(data), false);
}

/// The joint of a report, which takes the place of another page that was closed.
async function show(report: Report, isDropped: boolean): Promise<void> {
  const arrays = jointArraysOf(report), copied = isDropped ? null : copiedWith(arrays);
  const newPage = (computes: boolean, added: Added) => new Page(report.text, arrays, report, computes, { ...added, isDropped });
  let page = newPage(canCompute, { notes: copied ?? undefined });
  if (copied) page.sayIsCopy(copied);
  const compute = async () => page.compute(await CoreClient.open(await wasmBytes(), structuredClone(arrays)));
  const drops = new AbortController();
  const leave = () => {
    drops.abort();
    page.close();
    leaveReport();
  };
  takeDrops({
    signal: drops.signal, computes: canCompute, read: (file) => page.readMotion(file), isReport: !isDropped,
    play: async (motion) => {
      page = newPage(true, { notes: page.handOver(), motion });
      await compute();
      page.playFromStart();
    },
    replace: (files) => {
      leave();
      void openEmpty(hasReport() ? () => post("status", words.notTheReport) : undefined)?.add(files);
    },
    readJoint: async (files) => {
      const dropped = await readJoint(files).catch((error: unknown) => {
        throw new Error(reasonOf(error));
      });
      return () => {
        leave();
        return showDropped(dropped);
      };
    },
  });
  if (!canCompute) return page.useStoredPoses(words.noWebAssembly);
  try {
    await compute();
  } catch (error) {
    page = newPage(false, { notes: page.handOver() });
    page.useStoredPoses(isCoreDamage(error) ? words.coreDamaged : lineOf(error));
  }
}

/// Another joint has another view. The line in the foot stays.
function leaveReport(): void {
  history.replaceState(null, "", "#");
  clearMessages();
  if (hasReport()) found("scope").textContent = `${words.footer} ${words.notTheReport}`;
}

open().catch((error: unknown) => {
  warn(lineOf(error));
});
