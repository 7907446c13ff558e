import { CoreClient } from "./core/client";
import { lineOf } from "./core/error_line";
import type { BothValues, Coordinates, JointArrays, MapQuestion, Query, ShownQuantity, Values } from "./core/protocol";
import { button, choice, html, named, section, shortened, spaced } from "./dom";
import { DisplayPanel } from "./panels/display";
import { DropPanel } from "./panels/drop";
import { MotionPanel } from "./panels/motion";
import { numbersPanel } from "./panels/numbers";
import { PlanPanel } from "./panels/plan";
import { PointerPanel } from "./panels/pointer";
import { RecordedPanel, type Frame } from "./panels/recorded";
import { shapePanel } from "./panels/shape";
import { ZonePanel } from "./panels/zones";
import { clockDrawing } from "./plots/clock";
import { figure } from "./plots/figure";
import { limitsDrawing } from "./plots/limits";
import { MapPlot } from "./plots/map";
import {
  bytesOf, inflated, Report, scopeOf, textOfProposal, type MapAnswer, type MotionAnswer, type ReportText, type StoredPose,
} from "./report";
import { jointArraysOf } from "./joint_arrays";
import { JointScene } from "./scene/scene";
import { readViewState, writeViewState } from "./view_state";
import { words } from "./words";

const translationNames = ["x", "y", "z"];
const quantities = Object.keys(words.quantity) as ShownQuantity[];
const canCompute = typeof WebAssembly !== "undefined";
const storedQuantities: readonly ShownQuantity[] = ["gap", "removed", "none"];

function found<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

function textOf(id: string): string | null {
  return document.getElementById(id)?.textContent ?? null;
}

function warn(message: string): void {
  found("messages").append(html("p", { class: "warning", role: "alert" }, message));
}

/// A scene, or nothing but a line where the browser shows none.
function sceneOf(arrays: JointArrays, parts: ReportText["parts"], label: string): JointScene | null {
  try {
    return new JointScene(found("scene"), arrays.fixed, arrays.mobile, parts, label);
  } catch {
    warn(words.noWebGl);
    return null;
  }
}

/// The page of one report.
class Page {
  private readonly scene: JointScene | null;
  private readonly display: DisplayPanel;
  private readonly motion: MotionPanel;
  private core: CoreClient | null = null;
  private mapPlot: MapPlot | null = null;
  private zones: ZonePanel | null = null;
  private readonly plan: PlanPanel | null;
  private readonly removed: BothValues | null;
  private fragmentTimer = 0;
  /// One of the report's poses, if the page cannot compute.
  private storedPose: StoredPose | null = null;
  private poseChoice: HTMLSelectElement | null = null;

  /// `report` holds the arrays of figures and poses that a joint dropped on the page has not.
  constructor(private readonly text: ReportText, private readonly arrays: JointArrays, private readonly report: Report | null) {
    const { anatomy, side } = text.joint, names = { fixed: named(text.joint.fixed), mobile: named(text.joint.mobile) };
    document.title = words.pageTitle(shortened(text.title));
    found("title").textContent = text.title;
    found("subtitle").textContent = words.subtitle(words.sides[side], words.anatomies[anatomy], names);
    this.scene = sceneOf(arrays, text.parts, words.sceneLabel(names.fixed, names.mobile));
    this.motion = new MotionPanel(
      text, (at) => this.moved(at), (motion) => this.arrived(motion), canCompute ? null : (name) => this.showStored(name));
    this.plan = report && text.plan && new PlanPanel(this.scene, report, text.plan, names);
    const { fixed, mobile } = this.counts();
    this.removed = this.plan && this.plan.values({ fixed: fixed[0], mobile: mobile[0] });
    const has = { pressure: text.layers !== null, removed: this.plan !== null } as Partial<Record<ShownQuantity, boolean>>;
    this.display = new DisplayPanel(this.scene, {
      names, parts: text.parts, marks: canCompute ? ["contact", "bearing"] : ["bearing"], removed_mm: this.plan?.deepest_mm ?? 0,
      quantities: (canCompute ? quantities : storedQuantities).filter((key) => has[key] ?? true),
    }, () => this.recolour(), () => this.rememberView());
    if (report && text.zones.length) {
      this.zones = new ZonePanel(this.scene, report, text.zones, () => this.rememberView());
      this.display.element.append(this.zones.element);
    }
    found("legend-place").append(this.display.legend);
    if (this.scene) {
      const unit = () => (this.display.quantity === "none" ? "" : words.unit[this.display.quantity]);
      found("pointer-place").append(new PointerPanel(this.scene, names, unit).element);
      this.scene.onViewChange(() => this.rememberView());
    }
    found("panels").append(this.motion.element, this.display.element, ...this.plots(), numbersPanel(text, this.counts()));
    this.applyFragment();
    window.addEventListener("hashchange", () => this.applyFragment());
  }

  /// The view that the address says.
  private applyFragment(): void {
    const { coordinates, display, zone, camera } = readViewState(location.hash, Object.keys(this.referencePose()));
    const values = Object.entries(this.referencePose()).map(([name, reference]) => coordinates[name] ?? reference);
    if (camera && this.scene) this.scene.viewpoint = camera;
    this.display.apply(display);
    this.zones?.show(zone);
    if (canCompute) this.motion.set(values.slice(0, 3), values.slice(3));
  }

  /// The joint is ready in the worker; poses are answered from now on.
  compute(core: CoreClient): void {
    core.listen({
      shown: (_, shown, roundTrip_ms) => {
        this.scene?.setPose(shown.pose);
        if (this.display.quantity === "none" || this.display.quantity === "removed") this.show(this.storedValues());
        const pairs = Array.from(shown.pairs);
        this.scene?.setMarked("contact", pairs.filter((_, i) => i % 2 === 0), pairs.filter((_, i) => i % 2 === 1));
        this.motion.show(shown, roundTrip_ms);
        document.documentElement.dataset["answered"] = String(Number(document.documentElement.dataset["answered"] ?? 0) + 1);
      },
      values: (values) => this.show(values),
      limit: (at, limit) => this.motion.setLimit(at, limit),
      depth: (depth) => this.motion.showDepth(depth),
      bearing: (triangles) => this.markBearing(triangles),
      mapPoint: (point, intervals) => {
        this.mapPlot?.set(point, intervals);
        found("map-progress").textContent = this.mapPlot?.progress() ?? "";
      },
      failed: warn,
    });
    this.core = core;
    // For scripts in the console and for tests: docs/report.md, "From a script".
    Object.assign(globalThis, { condyle: { query: (query: Query) => core.query(query) } });
    this.moved(this.motion.coordinates);
    core.askBearing();
  }

  private show(values: BothValues | null): void {
    this.scene?.bodies.fixed.show(values?.fixed ?? null);
    this.scene?.bodies.mobile.show(values?.mobile ?? null);
    this.scene?.draw();
  }

  private markBearing(triangles: Uint8Array): void {
    this.scene?.setMarked("bearing", [], [...triangles.keys()].filter((t) => triangles[t]));
  }

  /// For browsers without WebAssembly: poses that the report holds.
  useStoredPoses(): void {
    warn(words.noWebAssembly);
    if ("mobile_roles" in this.text.arrays) this.markBearing(this.report!.array("mobile_roles", "u8").map((role) => role % 2));
    const names = this.text.poses.map(({ name }) => name);
    if (names.length === 0) return;
    const poses = choice<string>(
      words.precomputed, Object.fromEntries(names.map((name) => [name, spaced(name)])), names[0]!, (name) => this.showStored(name));
    this.poseChoice = poses.querySelector("select");
    found("panels").prepend(section(words.precomputed, poses));
    this.showStored(names[0]!);
  }

  private showStored(name: string): void {
    const pose = this.text.poses.find((stored) => stored.name === name);
    if (!pose) return;
    if (this.poseChoice) this.poseChoice.value = name;
    this.motion.set(pose.coordinates_deg);
    this.storedPose = pose;
    this.scene?.setPose(pose.pose);
    this.recolour();
    this.scene?.showContactPoint(pose.contact_point_mm);
    this.zones?.show(name);
  }

  /// Another quantity is asked for.
  private recolour(): void {
    if (canCompute) return this.moved(this.motion.coordinates);
    const pose = this.display.quantity === "gap" ? this.storedPose : null;
    this.show(pose ? { fixed: this.storedGaps(pose.fixed_gaps), mobile: this.storedGaps(pose.mobile_gaps) } : this.storedValues());
  }

  /// Values that do not depend on the pose.
  private storedValues(): BothValues | null {
    return this.display.quantity === "removed" ? this.removed : null;
  }

  /// A frame of the recorded motion: its pose is in the report, its colours are computed.
  private showFrame({ angles, translation, X_FM }: Frame): void {
    this.motion.set(angles, translation);
    if (canCompute || X_FM.some(Number.isNaN)) return;
    this.storedPose = null;
    this.scene?.setPose(X_FM);
    this.recolour();
  }

  private storedGaps(name: string): Values {
    const hundredths = this.report!.array(name, "i16"), none = 32767;
    return {
      shown: Float32Array.from(hundredths, (gap) => gap / 100), marks: Uint8Array.from(hundredths, (gap) => (gap === none ? 0 : 1)),
    };
  }

  private plots(): HTMLElement[] {
    const { rom, map, recorded } = this.text;
    const made: HTMLElement[] = [];
    if (recorded && this.report)
      made.push(new RecordedPanel(this.report, recorded, (frame) => this.showFrame(frame)).element);
    const go = canCompute || this.text.poses.length ? (motion: MotionAnswer) => this.motion.goToEnd(motion) : null;
    if (rom) {
      made.push(section(words.limits, figure(limitsDrawing(rom.motions, go))));
      const clock = clockDrawing(rom.motions, rom.clock_plane, go);
      if (clock) made.push(section(words.clock, figure(clock)));
    }
    if (this.plan) made.unshift(this.plan.element);
    if (this.text.joint.kind !== "hinge" && (map || canCompute)) made.push(this.mapSection(map));
    if (this.text.measures) made.push(shapePanel(this.text.measures, this.scene));
    return made;
  }

  /// The report's map, or a button that has the page compute one.
  private mapSection(map: MapAnswer | null): HTMLElement {
    const place = section(words.map);
    const showMap = (answer: MapAnswer) => {
      const angle = (name: string) => this.text.coordinates.findIndex((c) => c.name === name);
      this.mapPlot = new MapPlot(answer, canCompute ? (column, row) => {
        const angles: number[] = [0, 0, 0];
        angles[angle(answer.columns.angle)] = column;
        angles[angle(answer.rows.angle)] = row;
        angles[angle(answer.vary)] = answer.start_deg;
        this.motion.goTo(angles);
      } : null);
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

  private arrived(motion: MotionAnswer): void {
    this.scene?.showContactPoint(motion.contact_point_mm);
    this.zones?.show(motion.name);
  }

  private moved(at: Coordinates): void {
    const { quantity } = this.display;
    this.core?.ask(at, quantity === "removed" ? "none" : quantity, this.motion.ranges());
    this.scene?.showContactPoint(null);
    this.rememberView();
  }

  /// Coordinates by the names they have in the address.
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
    this.fragmentTimer = window.setTimeout(() => {
      const { angles, translation } = this.motion.coordinates;
      const values = [...angles, ...translation];
      const coordinates = Object.fromEntries(
        Object.entries(this.referencePose()).map(([name, reference], i) => [name, values[i]!, reference] as const)
          .filter(([, value, reference]) => value !== reference));
      history.replaceState(null, "", writeViewState({
        coordinates, display: this.display.state, zone: this.zones?.motion ?? "", camera: this.scene?.viewpoint ?? null,
      }));
    }, 300);
  }

  private counts(): { fixed: [number, number]; mobile: [number, number] } {
    const of = ({ vertices, triangles }: JointArrays["fixed"]): [number, number] => [vertices.length / 3, triangles.length / 3];
    return { fixed: of(this.arrays.fixed), mobile: of(this.arrays.mobile) };
  }
}

/// Internal rotation over flexion and adduction, every ten degrees.
function coarseMap(): MapQuestion {
  const every10 = (first: number, last: number) => Array.from({ length: (last - first) / 10 + 1 }, (_, i) => first + 10 * i);
  return { columnAngle: 0, rowAngle: 1, vary: 2, columns: every10(-20, 120), rows: every10(-40, 30) };
}

/// In full, once they are asked for.
async function showLicences(): Promise<void> {
  const texts = new TextDecoder().decode(await inflated(bytesOf(textOf("licence-texts") ?? ""), "gzip"));
  found("licences").textContent = `${textOf("licence-list") ?? ""}\n\n${texts}`;
}

function wasmBytes(): Promise<ArrayBuffer> {
  return inflated(bytesOf(textOf("core") ?? ""), "gzip");
}

/// The page without a joint takes one from files.
function openEmpty(): void {
  if (!canCompute) return warn(words.noWebAssemblyToRead);
  found("subtitle").textContent = words.noData;
  found("scene").append(html("p", { class: "drop-hint" }, words.dropHint));
  const warnOnly = (message: string) => {
    found("messages").replaceChildren();
    warn(message);
  };
  const panel = new DropPanel(async (fixed, mobile, side) => {
    try {
      const { core, proposal } = await CoreClient.propose(await wasmBytes(), fixed, mobile, side);
      found("messages").replaceChildren();
      panel.element.remove();
      found("scene").replaceChildren();
      const text = textOfProposal(proposal, fixed.name, mobile.name);
      found("scope").textContent = words.scope(scopeOf(text));
      new Page(text, proposal.joint, null).compute(core);
      return true;
    } catch (error) {
      warnOnly(lineOf(error));
      return false;
    }
  }, warnOnly);
  found("panels").append(panel.element);
}

async function open(): Promise<void> {
  found("unfinished").remove();
  found("licences-title").textContent = words.licences;
  found("licences-place").addEventListener("toggle", () => void showLicences(), { once: true });
  found("scope").textContent = words.scope(null);
  const data = textOf("condyle-data");
  if (data === null) return openEmpty();
  const report = await Report.read(data);
  found("scope").textContent = words.scope(scopeOf(report.text));
  const arrays = jointArraysOf(report);
  const page = new Page(report.text, arrays, report);
  if (!canCompute) return page.useStoredPoses();
  page.compute(await CoreClient.open(await wasmBytes(), structuredClone(arrays)));
}

open().catch((error: unknown) => {
  warn(lineOf(error));
});
