import { html, section } from "../dom";
import type { DroppedFile } from "../core/protocol";
import { words } from "../words";

/// Where mesh files are dropped or chosen: two of them, the fixed bone first where they come one by one.
export function dropPanel(dropped: (fixed: DroppedFile, mobile: DroppedFile) => void): HTMLElement {
  let waiting: DroppedFile[] = [];
  const told = html("p", { "aria-live": "polite" });
  const input = html("input", { type: "file", multiple: true, accept: ".stl,.obj,.ply,.vtp,.vtk", id: "files" });
  const place = section(words.drop, html("p", {}, html("label", { for: "files" }, words.dropHere)), input, told);
  const take = async (files: Iterable<File>) => {
    for (const file of files) waiting.push({ name: file.name, bytes: await file.arrayBuffer() });
    told.textContent = waiting.length === 1 ? words.dropSecond(waiting[0]!.name) : "";
    if (waiting.length < 2) return;
    const [fixed, mobile] = inOrder(waiting[0]!, waiting[1]!);
    waiting = [];
    told.textContent = words.loading;
    dropped(fixed, mobile);
  };
  input.addEventListener("change", () => void take(input.files ?? []));
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    void take(event.dataTransfer?.files ?? []);
  });
  return place;
}

/// A femur is what moves, whichever of the two came first.
function inOrder(first: DroppedFile, second: DroppedFile): [DroppedFile, DroppedFile] {
  const isMobile = /femur|thigh|mobile/i;
  return isMobile.test(first.name) && !isMobile.test(second.name) ? [second, first] : [first, second];
}
