import type { CoreClient } from "./core/client";
import type { BothValues, Brushed, Coordinates, JointArrays, LiveLimit, ShownQuantity, Turned } from "./core/protocol";
import { button, checkbox, found, html, named, namesOf, shortened } from "./dom";
import { post, warn } from "./messages";
import { fixed } from "./numbers";
import { blockOf, countOf, type Copied, type UserNotes } from "./notes_block";
import { pageWith } from "./page_copy";
import { ComparePanel } from "./panels/compare";
import { DisplayPanel } from "./panels/display";
import { addEditPanels, sweepOf } from "./panels/edits";
import { freeAngles } from "./panels/free_angles";
import { actions, copyLink, headingOf, listenToKeys } from "./panels/header";
import { hintAt } from "./panels/hint";
import { clearance, Idle } from "./panels/idle";
import { JointFigures } from "./panels/joint_figures";
import { licencesFold } from "./panels/licences";
import { questionsOf } from "./panels/live_limits";
import { MotionPanel } from "./panels/motion";
import { NotesPanel } from "./panels/notes";
import { numberFolds } from "./panels/numbers";
import { placeTabs } from "./panels/page_tabs";
import { Paper } from "./panels/paper";
import { PlanPanel } from "./panels/plan";
import { addPlanPanel } from "./panels/plan_tab";
import { PointerPanel } from "./panels/pointer";
import { RecordedPanel, type Frame, type Loaded } from "./panels/recorded";
import { fileName, poseLine, savePicture, saveSurfaces } from "./panels/saved_files";
import { shapePanel } from "./panels/shape";
import { StoredPoses } from "./panels/stored_poses";
import { pinOf, ResultStrip, type Extreme } from "./panels/strip";
import type { Tabs } from "./panels/tabs";
import { drawWorst } from "./panels/worst_picture";
import { ZonePanel } from "./panels/zones";
import { changedByHand, ribbonOf } from "./planned";
import { droppedMotion, recordedOf, type RecordedMotion } from "./recorded_motion";
import { scopeOf, type MotionAnswer, type Report, type ReportText } from "./report";
import { wrongOf } from "./result";
import { saveBlob } from "./save";
import type { BodyName } from "./scene/body_names";
import { JointScene } from "./scene/scene";
import { ViewAddress } from "./view_address";
import { inWords, words } from "./words";

const quantities = Object.keys(words.quantity) as ShownQuantity[];
const large_bytes = 5e6;
const storedQuantities: readonly ShownQuantity[] = ["gap", "removed", "none"];

/// A scene, or only a line if the browser shows none.
function sceneOf(arrays: JointArrays, parts: ReportText["parts"], label: string): JointScene | null {
  try {
    return new JointScene(found("scene"), arrays.fixed, arrays.mobile, parts, label);
  } catch {
    warn(words.noWebGl);
    return null;
  }
}

/// Content that no report holds: its user's notes, and the motion of a dropped file. A joint of dropped files takes no notes: no copy of the
/// page would have it.
export interface Added {
  notes?: UserNotes | undefined;
  motion?: RecordedMotion;
  isDropped?: boolean;
}

/// The page of one report.
export class Page {
  private readonly scene: JointScene | null;
  private readonly display: DisplayPanel;
  private readonly motion: MotionPanel;
  private strip: ResultStrip;
  private readonly tabs: Tabs;
  private readonly figures: JointFigures;
  private paper: Paper;
  private readonly address: ViewAddress;
  private readonly recorded: RecordedPanel | null;
  private readonly loaded: Loaded | null;
  private readonly notes: NotesPanel | null;
  private core: CoreClient | null = null;
  private readonly idle = new Idle();
  private zones: ZonePanel | null = null;
  private readonly plan: PlanPanel | null;
  private readonly removed: BothValues | null;
  /// The report's poses, if the page cannot compute.
  private readonly stored: StoredPoses | null;
  private hasWorstPicture = false;
  private readonly strokes: Partial<Record<BodyName, { volume_mm3: number; areByHand: boolean }>> = {};
  /// The report's text, as a change by hand has it.
  private shownText: ReportText;
  /// Whether the address is of a joint that was changed by hand, elsewhere.
  private isLinked = false;
  private readonly closed = new AbortController();

  /// `report` holds the arrays of figures and poses that a joint dropped on the page has not; `computes` if the core answers; `added` is
  /// not part of any report.
  constructor(
    private readonly text: ReportText, private readonly arrays: JointArrays, private readonly report: Report | null, private readonly computes: boolean,
    added: Added = {}) {
    for (const note of text.rom?.notes ?? []) note.text = inWords(note.text);
    this.shownText = text;
    this.address = new ViewAddress(text, () => ({
      at: this.motion.coordinates, display: this.display.state, zone: this.zones?.motion ?? "", camera: this.scene?.camera.viewpoint ?? null,
      isByHand: this.isLinked || this.shownText.by_hand !== undefined,
    }), this.closed.signal);
    const names = namesOf(text.joint);
    document.body.classList.toggle("set-up-wrongly", wrongOf(text.rom) !== null);
    document.title = words.pageTitle(shortened(text.title));
    found("title").textContent = found("title").title = headingOf(text);
    this.scene = sceneOf(arrays, text.parts, words.sceneLabel(names.fixed, names.mobile));
    this.scene?.setJointRadius(text.rom?.bearing?.head?.radius_mm ?? null);
    this.motion = new MotionPanel(text, {
      moved: (at) => this.moved(at), arrived: (motion, requested) => this.arrived(motion, requested), showStored: computes ? null : (name) => this.showStored(name),
      undo: () => this.undo(), begins: () => {
        this.address.begin();
        this.motion.setUndo(true);
      },
    });
    this.stored = report && !computes ? new StoredPoses(report, (name) => this.showStored(name)) : null;
    const motion = added.motion ?? (report && text.recorded && recordedOf(report, text.recorded));
    this.recorded = motion ? new RecordedPanel(
      motion, (frame) => this.showFrame(frame), this.scene && ((said) => this.pictureOfFrame(said))) : null;
    // A joint that is set up wrongly says that first.
    this.loaded = text.layers && wrongOf(text.rom) === null ? this.recorded?.loaded() ?? null : null;
    this.strip = this.placedStrip();
    this.plan = report && text.plan && new PlanPanel(this.scene, report, text.plan, names);
    const { fixed: fixedCount, mobile: mobileCount } = this.counts();
    this.removed = this.plan && this.plan.values({ fixed: fixedCount[0], mobile: mobileCount[0] });
    const has = { pressure: text.layers !== null, removed: this.plan !== null } as Partial<Record<ShownQuantity, boolean>>;
    this.display = new DisplayPanel(this.scene, {
      names, parts: text.parts, marks: computes ? ["contact", "bearing"] : ["bearing"], removed_mm: this.plan?.deepest_mm ?? 0,
      quantities: (computes ? quantities : storedQuantities).filter((key) => has[key] ?? true),
    }, () => this.recolour(), () => this.address.remember());
    if (report && text.zones.length) {
      this.zones = new ZonePanel(this.scene, report, text.zones, () => this.address.remember());
      this.display.element.append(this.zones.element);
    }
    this.placeViewTools(names);
    this.notes = report && !added.isDropped ? new NotesPanel(this.scene, names, arrays, added.notes ?? { text: "", pins: [] }, () => this.putNotesOnPaper()) : null;
    const shape = text.measures ? shapePanel(text.measures, this.scene) : null;
    const compared = report && text.before ? new ComparePanel(this.scene, report, text.before, () => this.address.remember()) : null;
    if (compared) this.display.remember("before", compared.box, (on) => compared.show(on));
    this.figures = new JointFigures(text, arrays, this.motion, this.recorded?.element ?? null, computes, () => this.core);
    const details = this.details([compared?.details, shape?.details].filter((each) => each !== undefined));
    this.tabs = placeTabs({ motion: this.motion.element, figures: this.figures.element, details }, this.closed.signal);
    if (this.opensOnLoad) this.tabs.show("figures");
    if (compared) addPlanPanel(compared.element);
    if (this.plan) addPlanPanel(this.plan.element);
    if (shape) addPlanPanel(shape.element);
    this.paper = this.placedPaper();
    this.putNotesOnPaper();
    this.placeActions();
    this.listen();
    this.applyAddress();
    if (this.scene) hintAt(found("scene"));
  }

  /// Takes the page's parts away, so that another page can be made of the same joint.
  close(): void {
    this.closed.abort();
    this.recorded?.stop();
    this.core?.close();
    this.scene?.canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context")?.loseContext();
    for (const place of ["scene", "strip-place", "view-tools", "legend-place", "side", "paper", "actions"]) found(place).replaceChildren();
    found("help").remove();
    document.body.classList.remove("wide", "set-up-wrongly", "limits-wait");
    document.body.dataset["byHand"] = "";
  }

  private placedStrip(): ResultStrip {
    const strip = new ResultStrip(this.shownText, (motion) => this.motion.goToEnd(motion), ({ name }) => this.motion.hasPose(name),
      this.extremes(), () => this.showFold("checks"), this.loaded?.sentence ?? null);
    found("strip-place").replaceChildren(strip.element);
    return strip;
  }

  private placedPaper(): Paper {
    const paper = new Paper(this.shownText, this.counts(), this.extremes(), sweepOf(this.report), this.loaded?.sentence ?? null, this.recorded?.drawing() ?? null);
    found("paper").replaceChildren(paper.element);
    return paper;
  }

  private extremes(): readonly Extreme[] {
    return this.loaded?.figures ?? this.recorded?.extremes() ?? [];
  }

  /// Whether the page is about load: it opens on the recorded motion.
  private get opensOnLoad(): boolean {
    return this.text.layers !== null && this.recorded !== null;
  }

  private placeViewTools(names: Record<BodyName, string>): void {
    const { scene } = this, tools: HTMLElement[] = [];
    if (scene) {
      tools.push(button(words.fitJoint, () => scene.fitTo("joint")), button(words.fitAll, () => scene.fitTo("all")));
      const unit = () => (this.display.quantity === "none" ? "" : words.unit[this.display.quantity]);
      const pointer = new PointerPanel(scene, names, unit);
      this.display.element.append(this.display.legend, pointer.element);
      this.display.element.append(html("div", { class: "row" }, checkbox(words.orthographic, false, (on) => scene.setOrthographic(on)),
        button(words.saveSurfaces, () => void saveSurfaces(scene, this.text))));
      found("legend-place").replaceChildren(pointer.readout);
      scene.camera.onEnd(() => this.address.remember());
    }
    const drawer = html("details", { id: "view-options", class: "popup" }, html("summary", {}, words.viewOptions), this.display.element);
    found("view-tools").replaceChildren(...tools, drawer);
  }

  /// The tab of details: the user's notes, numbers, `folds` of other panels, scope and licences.
  private details(folds: readonly HTMLDetailsElement[]): HTMLElement {
    const { text, motion } = this;
    return html("section", { "aria-label": words.tab.details },
      ...(this.notes ? [this.notes.element] : []), ...numberFolds(text, this.counts(), [motion.answer, motion.depth, motion.ligaments, motion.took]),
      ...(this.plan ? [this.plan.details] : []), ...folds, html("p", {}, words.scope(scopeOf(text))), licencesFold());
  }

  private placeActions(): void {
    const { scene } = this;
    found("actions").replaceChildren(...actions({
      picture: scene && (() => void savePicture(scene, this.shownText, this.motion.coordinates)), print: () => window.print(),
      saveCopy: this.notes && (() => this.saveCopy()),
      copyLink: () => {
        this.address.write();
        void copyLink((message, ...parts) => post("status", message, ...parts));
      },
    }));
  }

  private listen(): void {
    const { signal } = this.closed;
    for (const event of ["popstate", "hashchange"]) window.addEventListener(event, () => this.applyAddress(this.address.returned()), { signal });
    // Without a picture made for paper, paper shows the joint's present pose.
    window.addEventListener("beforeprint", () => this.takePictureForPaper(), { signal });
    window.addEventListener("beforeprint", () => this.putNotesOnPaper(), { signal });
    listenToKeys({
      "1": () => this.tabs.showNumber(1), "2": () => this.tabs.showNumber(2), "3": () => this.tabs.showNumber(3), "4": () => this.tabs.showNumber(4),
      f: () => this.scene?.fitTo("joint"), u: () => this.undo(), "0": () => this.motion.goTo(this.text.reference_deg, () => undefined, this.text.reference_mm),
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
    const frames = await this.core.query({ of: "motion", file: { name: file.name, bytes: await file.arrayBuffer() }, columns });
    return { motion: droppedMotion(file.name, frames, this.text), remarks: frames.remarks };
  }

  /// The user's notes and the address of the present view, for the page that takes this one's place.
  handOver(): UserNotes | undefined {
    this.address.write();
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
    this.address.write();
    const copy = pageWith(blockOf({ ...this.notes!.notes, view: location.hash }));
    saveBlob(`${fileName(this.text)}_copy.html`, copy);
    if (copy.size > large_bytes) post("status", words.copyIsLarge((copy.size / 1e6).toFixed(1)));
  }

  private putNotesOnPaper(): void {
    const { notes } = this;
    if (notes) this.paper.setNotes(notes.notes.text, notes.notes.pins.map((pin) => ({ place: notes.placeOf(pin), text: pin.text })));
  }

  private takePictureForPaper(): void {
    if (this.hasWorstPicture || !this.scene) return;
    this.paper.setPicture(this.scene.pictureCanvas("", null, 0, this.paper.pictureSize).toDataURL("image/png"), `${words.poseHere} ${poseLine(this.text, this.motion.coordinates)}`);
  }

  /// The limit that the sentence is about, on paper.
  private drawWorst(): void {
    if (!this.scene || this.loaded) return;
    drawWorst(this.text, this.arrays, this.paper.pictureSize, this.closed.signal, (picture, caption) => {
      if (this.shownText.by_hand) return;
      this.hasWorstPicture = true;
      this.paper.setPicture(picture, caption);
    });
  }

  /// The browser's own Back is the same.
  private undo(): void {
    if (this.address.step > 0) history.back();
  }

  /// The view in the address; of a step back or forth the pose and the camera.
  private applyAddress(isStep = false): void {
    const { coordinates, values, refused, display, zone, camera, isByHand } = this.address.read();
    if (refused.length) warn(refused.join(" "));
    if (camera && this.scene) this.scene.camera.viewpoint = camera;
    if (this.computes) this.motion.step(values.slice(0, 3), values.slice(3));
    this.motion.setUndo(this.address.step > 0);
    if (isStep) return;
    this.display.apply(display);
    this.zones?.show(zone);
    this.isLinked = isByHand;
    this.sayRibbon();
    if (this.opensOnLoad && Object.keys(coordinates).length === 0) this.recorded?.show(this.loaded?.frame ?? 0);
  }

  private sayRibbon(waits = false): void {
    const ribbon = found("ribbon"), { by_hand } = this.shownText;
    const said = [this.isLinked && !by_hand ? words.changedInLink : null, ribbonOf(this.shownText), waits ? words.limitsBefore : null].filter(Boolean).join(" · ");
    ribbon.hidden = said === "";
    ribbon.classList.toggle("by-hand", by_hand !== undefined && !ribbonOf(this.text));
    ribbon.textContent = ribbon.title = said;
    document.body.classList.toggle("limits-wait", waits);
  }

  /// The joint is ready in the worker; poses are answered from now on.
  compute(core: CoreClient): void {
    const count = this.text.joint.kind === "hinge" ? 1 : 3;
    const askFree = freeAngles(core, count, this.motion);
    core.listen({
      shown: (at, shown, roundTrip_ms) => {
        this.stand(shown.pose);
        if (this.display.quantity === "none" || this.display.quantity === "removed") this.show(this.storedValues());
        const pairs = Array.from(shown.pairs);
        this.scene?.setMarked("contact", pairs.filter((_, i) => i % 2 === 0), pairs.filter((_, i) => i % 2 === 1));
        this.scene?.annotations.showLigaments(shown.ligaments);
        this.motion.show(shown, roundTrip_ms);
        askFree({ at, held: [shown.pose[3]!, shown.pose[7]!, shown.pose[11]!] });
        this.askIdle(core, at, shown.inContact);
        document.documentElement.dataset["answered"] = String(Number(document.documentElement.dataset["answered"] ?? 0) + 1);
      },
      values: (values) => this.show(values),
      depth: (depth) => this.motion.showDepth(depth),
      bearing: (triangles) => this.markBearing(triangles),
      openness: (body, openness) => this.scene?.bodies[body].setOpenness(openness),
      mapPoint: (point, intervals) => this.figures.map?.set(point, intervals),
      failed: warn,
    });
    this.core = core;
    // For scripts in the console and for tests: docs/report-data.md, "From a script".
    Object.assign(globalThis, { condyle: { query: core.query.bind(core), scene: this.scene } });
    this.moved(this.motion.coordinates);
    core.request("bearing", {});
    if (this.scene) core.request("openness", {});
    addEditPanels({
      core, scene: this.scene, text: this.text, arrays: this.arrays, report: this.report,
      brushed: (brushed, rests) => this.takeBrushed(brushed, rests), turned: (turned, rests, done) => this.takeTurned(turned, rests, done),
      limited: (limits) => this.showChange(limits),
    });
    this.drawWorst();
  }

  /// The bone has changed, so the display of the pose is requested again.
  private takeBrushed({ body, vertices, depths_mm, volume_mm3, steps }: Brushed, rests: boolean): void {
    this.scene?.bodies[body].replaceVertices(vertices);
    this.strokes[body] = { volume_mm3, areByHand: steps !== (this.text.plan?.surfaces[body] ? 1 : 0) };
    const { fixed: ofFixed, mobile } = this.strokes, gone = ([["fixed", ofFixed], ["mobile", mobile]] as const)
      .flatMap(([each, by]) => (by?.volume_mm3 ? [words.volumeOf(fixed(by.volume_mm3, 1), named(this.text.joint[each]))] : []));
    this.change(ofFixed?.areByHand || mobile?.areByHand ? words.afterStrokes(gone.join(" and ")) : null);
    if (this.removed) this.removed[body] = { shown: Float32Array.from(depths_mm), marks: Uint8Array.from(depths_mm, (mm) => (mm > 0 ? 1 : 0)) };
    if (rests) this.ask(this.motion.coordinates);
  }

  /// The joint is another one by hand, or the report's again: null. Limits shown are those before, until showChange().
  private change(done: string | null): void {
    this.shownText = done === null ? this.text : { ...this.text, by_hand: { done, before: this.shownText.by_hand?.before ?? this.text.rom!.motions }, rom: this.shownText.rom };
    this.motion.markEnd(null);
    this.leaveLimit();
    document.body.dataset["byHand"] = done ?? "";
    for (const each of document.querySelectorAll<HTMLElement>(".of-report")) {
      each.querySelector("h2 .before")?.remove();
      if ((each.dataset["of"] ?? "") !== (done ?? "")) each.querySelector("h2")?.append(html("span", { class: "before" }, words.beforeByHand));
    }
    this.sayRibbon(true);
  }

  /// All limits of the joint as it is now.
  private showChange(limits: readonly LiveLimit[]): void {
    const { by_hand } = this.shownText, known = questionsOf(this.text).map(({ motion }, i) => ({ motion, limit: limits[i]! }));
    if (by_hand) this.shownText = changedByHand(this.text, by_hand.done, known);
    this.strip = this.placedStrip();
    this.motion.setReport(this.shownText);
    this.paper = this.placedPaper();
    this.hasWorstPicture = false;
    this.putNotesOnPaper();
    if (!by_hand) this.drawWorst();
    this.sayRibbon();
  }

  /// The same for a joint whose parts turn: the bearing surface is found again.
  private takeTurned({ fixed: fixedBody, mobile }: Turned, rests: boolean, done: string): void {
    this.scene?.bodies.fixed.replaceVertices(fixedBody);
    this.scene?.bodies.mobile.replaceVertices(mobile);
    this.change(done ? words.afterTurning(done) : null);
    if (!rests) return;
    this.ask(this.motion.coordinates);
    this.core?.request("bearing", {});
  }

  private show(values: BothValues | null): void {
    this.scene?.bodies.fixed.show(values?.fixed ?? null);
    this.scene?.bodies.mobile.show(values?.mobile ?? null);
    this.scene?.draw();
    const { quantity } = this.display, { plateau } = this.figures;
    if (plateau && quantity !== "none") plateau.show(values?.[plateau.body] ?? null, quantity, this.display.end);
  }

  private markBearing(triangles: Uint8Array): void {
    this.scene?.setMarked("bearing", [], [...triangles.keys()].filter((t) => triangles[t]));
  }

  /// For pages that cannot compute: poses that the report holds.
  useStoredPoses(why: string): void {
    warn(why);
    if ("mobile_roles" in this.text.arrays) this.markBearing(this.report!.array("mobile_roles", "u8").map((role) => role % 2));
    this.drawWorst();
    const { element, names } = this.stored!;
    if (names.length === 0) return;
    this.motion.element.prepend(element);
    this.showStored(names[0]!);
  }

  private showStored(name: string): void {
    const pose = this.stored?.take(name);
    if (!pose) return;
    this.motion.set(pose.coordinates_deg);
    this.stand(pose.pose);
    this.recolour();
    const motion = this.text.rom?.motions.find((known) => known.name === name) ?? null;
    this.motion.markEnd(motion);
    if (motion) return this.arrived({ ...motion, contact_point_mm: pose.contact_point_mm }, true);
    this.scene?.leaveLimit();
    this.zones?.show(name);
  }

  /// Another quantity was requested.
  private recolour(): void {
    if (this.computes) return this.ask(this.motion.coordinates);
    this.show((this.display.quantity === "gap" ? this.stored?.gaps : null) ?? this.storedValues());
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
    this.stored?.leave();
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
    return this.scene!.picture(`${headingOf(this.shownText)} · ${said}`, ribbonOf(this.shownText));
  }

  /// The camera turns to a limit that was requested, and stays at one that a pose happens to be.
  private arrived(motion: MotionAnswer, requested: boolean): void {
    this.scene?.arriveAt(motion.contact_point_mm, pinOf(motion, this.shownText), "mobile", requested ? "slowly" : "not");
    this.zones?.show(motion.name);
    this.strip.describe(motion);
  }

  private ask(at: Coordinates): void {
    const { quantity } = this.display;
    this.core?.ask({ at, quantity: quantity === "removed" ? "none" : quantity });
  }

  /// What takes longer than a frame of a slider.
  private askIdle(core: CoreClient, at: Coordinates, inContact: boolean): void {
    const { before } = this.motion;
    if (!inContact) this.idle.ask(() => clearance(core, at, this.text.rom?.implant !== undefined), (nearest) => this.motion.setNearest(at, nearest));
    else if (before) this.idle.ask(() => core.query({ of: "screw", before, at }), (screw) => this.motion.showScrew(at, screw));
  }

  private moved(at: Coordinates): void {
    this.idle.drop();
    this.ask(at);
    this.leaveLimit();
    this.figures.map?.mark(at);
    this.address.remember();
  }

  private leaveLimit(): void {
    this.scene?.leaveLimit();
    this.strip.unmark();
  }

  private counts(): { fixed: [number, number]; mobile: [number, number] } {
    const of = ({ vertices, triangles }: JointArrays["fixed"]): [number, number] => [vertices.length / 3, triangles.length / 3];
    return { fixed: of(this.arrays.fixed), mobile: of(this.arrays.mobile) };
  }
}
