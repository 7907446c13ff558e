import { choice, html, named, section } from "../dom";
import type { DroppedFile, GivenSide } from "../core/protocol";
import { words } from "../words";

/// Where mesh files are dropped or chosen: two of them, the fixed bone first where they come one by one.
export class DropPanel {
  readonly element: HTMLElement;
  private readonly told = html("p", { "aria-live": "polite" });
  private waiting: DroppedFile[] = [];
  private side: GivenSide = "told";
  /// One pair is read at a time, and after one that makes a joint the page shows that.
  private state: "open" | "busy" | "done" = "open";

  /// `take` returns whether the files made a joint; `refuse` is called with the reason why files are not taken.
  constructor(
    private readonly take: (fixed: DroppedFile, mobile: DroppedFile, side: GivenSide) => Promise<boolean>,
    private readonly refuse: (why: string) => void) {
    const input = html("input", { type: "file", multiple: true, accept: ".stl,.obj,.ply,.vtp,.vtk", id: "files" });
    this.element = section(
      words.drop, html("p", {}, html("label", { for: "files" }, words.dropHere)), input,
      html("p", {}, choice(words.dropSide, words.dropSides, this.side, (side) => (this.side = side))), this.told);
    input.addEventListener("change", () => {
      const files = [...(input.files ?? [])];
      // The same file can be chosen again once it was mended.
      input.value = "";
      void this.add(files);
    });
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      void this.add([...(event.dataTransfer?.files ?? [])]);
    });
  }

  private async add(files: readonly File[]): Promise<void> {
    if (files.length === 0) return;
    if (this.state !== "open") return this.refuse(this.state === "busy" ? words.dropBusy : words.dropDone);
    if (this.waiting.length + files.length > 2) {
      this.waiting = [];
      this.told.textContent = words.dropTwo;
      return;
    }
    this.state = "busy";
    for (const file of files) this.waiting.push({ name: file.name, bytes: await file.arrayBuffer() });
    const [first, second] = this.waiting;
    this.told.textContent = second ? words.loading : words.dropSecond(named(first!.name));
    if (!second) {
      this.state = "open";
      return;
    }
    this.waiting = [];
    const [fixed, mobile] = inOrder(first!, second);
    this.state = (await this.take(fixed, mobile, this.side)) ? "done" : "open";
    this.told.textContent = "";
  }
}

/// A femur is what moves, whichever of the two came first.
function inOrder(first: DroppedFile, second: DroppedFile): [DroppedFile, DroppedFile] {
  const isMobile = /femur|thigh|mobile/i;
  return isMobile.test(first.name) && !isMobile.test(second.name) ? [second, first] : [first, second];
}
