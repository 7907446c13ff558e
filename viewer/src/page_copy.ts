import { html } from "./dom";

const blockId = "condyle-notes";

/// The page as its file has it, before the script changes anything.
let asInFile: HTMLElement | null = null;

/// To be called first. The script that runs was put into the page by the loader: the file has it compressed.
export function keepPage(): void {
  document.currentScript?.remove();
  asInFile = document.documentElement.cloneNode(true) as HTMLElement;
}

/// The block of notes of a page that is a copy; null of every other.
export function notesBlock(): string | null {
  return asInFile?.querySelector(`#${blockId}`)?.textContent ?? null;
}

/// The page as one HTML file with this block beside the report's data. Nothing else changes: a copy of a copy with the same block is the
/// same bytes.
export function pageWith(block: string): Blob {
  const page = asInFile!.cloneNode(true) as HTMLElement;
  page.querySelector(`#${blockId}`)?.remove();
  page.querySelector("#condyle-data")!.after(html("script", { type: "application/octet-stream", id: blockId }, block));
  return new Blob([`<!DOCTYPE html>\n${page.outerHTML}`], { type: "text/html" });
}
