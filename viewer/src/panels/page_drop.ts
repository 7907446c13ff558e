/// A file dropped anywhere on the page does not replace it: `taken` gets it.
export function catchDrops(taken: (files: File[]) => void, signal: AbortSignal): void {
  document.addEventListener("dragover", (event) => event.preventDefault(), { signal });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length) taken(files);
  }, { signal });
}
