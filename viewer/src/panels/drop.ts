import { choice, html, named, section } from "../dom";
import type { DroppedFile, SideChoice } from "../core/protocol";
import { words } from "../words";
import { isLabelMap, type LabelDrop } from "./label_drop";

/// Whether a file of this name is a mesh.
export function isMesh(name: string): boolean {
  return /\.(stl|obj|ply|vtp|vtk)$/i.test(name);
}

/// Where files are dropped or chosen: two meshes, the fixed bone first if they come one by one, or label maps.
export class DropPanel {
  readonly element: HTMLElement;
  private readonly progress = html("p", { "aria-live": "polite", id: "drop-progress" });
  private waiting: DroppedFile[] = [];
  private side: SideChoice = "automatic";
  /// One pair is read at a time; once a pair makes a joint, the page shows it.
  private state: "open" | "busy" | "done" = "open";

  /// `take` returns whether two meshes made a joint; `refuse` is called with the reason why files are not taken.
  constructor(
    private readonly take: (fixed: DroppedFile, mobile: DroppedFile, side: SideChoice) => Promise<boolean>,
    private readonly labels: LabelDrop, private readonly refuse: (why: string) => void) {
    const input = html("input", {
      type: "file", multiple: true, accept: ".stl,.obj,.ply,.vtp,.vtk,.nii,.gz,.nrrd,.mha", id: "files",
    });
    this.element = section(
      words.drop, html("p", {}, html("label", { for: "files" }, words.dropHere)), input,
      html("p", {}, choice(words.dropSide, words.dropSides, this.side, (side) => (this.side = side))), this.progress, labels.place);
    labels.listen({
      side: () => this.side, progress: (said) => (this.progress.textContent = said), busy: (state) => (this.state = state),
    });
    input.addEventListener("change", () => {
      const files = [...(input.files ?? [])];
      // The same file can be chosen again after a repair.
      input.value = "";
      void this.add(files);
    });
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      void this.add([...(event.dataTransfer?.files ?? [])]);
    });
  }

  /// As if they were dropped.
  async add(files: readonly File[]): Promise<void> {
    if (files.length === 0) return;
    if (this.state !== "open") return this.refuse(this.state === "busy" ? words.dropBusy : words.dropDone);
    const maps = files.filter(({ name }) => isLabelMap(name));
    if (maps.length > 0) {
      const hasMeshes = maps.length < files.length || this.waiting.length > 0;
      this.waiting = [];
      return hasMeshes ? this.refuse(words.dropMixed) : this.labels.add(maps);
    }
    const { isWaiting } = this.labels;
    this.labels.reset();
    return isWaiting ? this.refuse(words.dropMixed) : this.addMeshes(files);
  }

  private async addMeshes(files: readonly File[]): Promise<void> {
    if (this.waiting.length + files.length > 2) {
      this.waiting = [];
      this.progress.textContent = words.dropTwo;
      return;
    }
    this.state = "busy";
    for (const file of files) this.waiting.push({ name: file.name, bytes: await file.arrayBuffer() });
    const [first, second] = this.waiting;
    this.progress.textContent = second ? words.loading : words.dropSecond(named(first!.name));
    if (!second) {
      this.state = "open";
      return;
    }
    this.waiting = [];
    const [fixed, mobile] = inOrder(first!, second);
    this.state = (await this.take(fixed, mobile, this.side)) ? "done" : "open";
    this.progress.textContent = "";
  }
}

/// A femur is the mobile body, whichever of the two came first.
function inOrder(first: DroppedFile, second: DroppedFile): [DroppedFile, DroppedFile] {
  const isMobile = /femur|thigh|mobile/i;
  return isMobile.test(first.name) && !isMobile.test(second.name) ? [second, first] : [first, second];
}
