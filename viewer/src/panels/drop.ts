import { choice, html, named, section } from "../dom";
import type { DroppedFile, NamedFile, SideChoice } from "../core/protocol";
import { words } from "../words";
import { isLabelMap, LabelDrop, type LabelDropHooks } from "./label_drop";
import { catchDrops, withNames } from "./page_drop";

/// Whether a file of this name is a joint file.
export function isJointFile(name: string): boolean {
  return /\.toml$/i.test(name);
}

/// Whether a file of this name is a mesh.
export function isMesh(name: string): boolean {
  return /\.(stl|obj|ply|vtp|vtk)$/i.test(name);
}

export function isMotionFile(name: string): boolean {
  return /\.(mot|sto|csv|tsv)$/i.test(name);
}

/// The line for the first of files that the page reads nothing from; null if there is none. A joint file names what it needs of the others.
export function unknownAmong(files: readonly NamedFile[]): string | null {
  const knows = [isJointFile, isMesh, isLabelMap, isMotionFile], unknown = files.find(({ path }) => !knows.some((is) => is(path)));
  return unknown && !files.some(({ path }) => isJointFile(path)) ? words.dropUnknown(named(unknown.path)) : null;
}

/// Which joint the page makes of files.
export interface DropTaker {
  signal: AbortSignal;
  /// Two meshes; returns whether they made a joint.
  meshes: (fixed: DroppedFile, mobile: DroppedFile, side: SideChoice) => Promise<boolean>;
  /// The same of a joint file and its meshes.
  jointFile: (files: NamedFile[]) => Promise<boolean>;
  /// And of label maps.
  labels: Pick<LabelDropHooks, "wasm" | "take" | "refuse">;
  /// The reason why files are not taken.
  refuse: (why: string) => void;
}

/// Where files are dropped or chosen: a joint file with its meshes, two meshes, the fixed bone first if they come one by one, or label maps.
export class DropPanel {
  readonly element: HTMLElement;
  private readonly progress = html("p", { "aria-live": "polite", id: "drop-progress" });
  private waiting: DroppedFile[] = [];
  private readonly labels: LabelDrop;
  private side: SideChoice = "automatic";
  /// One pair is read at a time; once a pair makes a joint, the page shows it.
  private state: "open" | "busy" | "done" = "open";

  constructor(private readonly taker: DropTaker) {
    this.labels = new LabelDrop({
      ...taker.labels, side: () => this.side, progress: (said) => (this.progress.textContent = said), busy: (state) => (this.state = state),
    });
    const input = html("input", {
      type: "file", multiple: true, accept: ".toml,.stl,.obj,.ply,.vtp,.vtk,.nii,.gz,.nrrd,.mha", id: "files",
    });
    this.element = section(
      words.drop, html("p", {}, html("label", { for: "files" }, words.dropHere)), input,
      html("p", {}, choice(words.dropSide, words.dropSides, this.side, (side) => (this.side = side))), this.progress, this.labels.place);
    input.addEventListener("change", () => {
      const files = withNames(input.files ?? []);
      // The same file can be chosen again after a repair.
      input.value = "";
      void this.add(files);
    });
    catchDrops((files) => void this.add(files), taker.signal);
  }

  /// As if they were dropped.
  async add(dropped: NamedFile[]): Promise<void> {
    if (dropped.length === 0) return;
    const { labels } = this, { refuse } = this.taker;
    if (this.state !== "open") return refuse(this.state === "busy" ? words.dropBusy : words.dropDone);
    if (dropped.some(({ path }) => isJointFile(path))) return this.addJointFile(dropped);
    const motion = dropped.find(({ path }) => isMotionFile(path)), unknown = unknownAmong(dropped);
    if (unknown) return refuse(unknown);
    if (motion) return refuse(words.dropMotionLater(named(motion.path)));
    const files = dropped.map(({ file }) => file);
    const maps = files.filter(({ name }) => isLabelMap(name));
    if (maps.length > 0) {
      const hasMeshes = maps.length < files.length || this.waiting.length > 0;
      this.waiting = [];
      return hasMeshes ? refuse(words.dropMixed) : labels.add(maps);
    }
    const { isWaiting } = labels;
    labels.reset();
    return isWaiting ? refuse(words.dropMixed) : this.addMeshes(files);
  }

  /// What was dropped before it is left: a joint file names all of its meshes.
  private async addJointFile(files: NamedFile[]): Promise<void> {
    this.waiting = [];
    this.labels.reset();
    await this.readBy(() => this.taker.jointFile(files));
  }

  private async addMeshes(files: readonly File[]): Promise<void> {
    if (this.waiting.length + files.length > 2) {
      this.waiting = [];
      return void (this.progress.textContent = words.dropTwo);
    }
    this.state = "busy";
    for (const file of files) this.waiting.push({ name: file.name, bytes: await file.arrayBuffer() });
    const [first, second] = this.waiting;
    if (second) {
      this.waiting = [];
      return this.readBy(() => this.taker.meshes(...inOrder(first!, second), this.side));
    }
    this.progress.textContent = words.dropSecond(named(first!.name), isMobile(first!));
    this.state = "open";
  }

  /// `work` returns whether there is a joint.
  private async readBy(work: () => Promise<boolean>): Promise<void> {
    this.state = "busy";
    this.progress.textContent = words.loading;
    this.state = (await work()) ? "done" : "open";
    this.progress.textContent = "";
  }
}

const isMobile = ({ name }: DroppedFile) => /femur|thigh|mobile/i.test(name);

/// A femur is the mobile body, whichever of the two came first.
function inOrder(first: DroppedFile, second: DroppedFile): [DroppedFile, DroppedFile] {
  return isMobile(first) && !isMobile(second) ? [second, first] : [first, second];
}
