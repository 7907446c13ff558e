/// Paper has the picture with all text over the scene in `place`.
export function drawWhenPrinted(place: HTMLElement, picture: () => HTMLCanvasElement): void {
  let printed: HTMLCanvasElement | null = null;
  window.addEventListener("beforeprint", () => {
    printed?.remove();
    printed = picture();
    printed.className = "scene-print";
    place.prepend(printed);
    place.classList.add("has-print-picture");
  });
  window.addEventListener("afterprint", () => {
    printed?.remove();
    place.classList.remove("has-print-picture");
  });
}
