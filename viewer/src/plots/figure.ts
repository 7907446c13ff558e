import { button, html, svg } from "../dom";
import { csv, save } from "../save";
import { words } from "../words";

/// Before its place is known.
const usual = { width: 560, height: 340 };

/// A drawing with a caption, and what is in it as SVG and as CSV.
export interface Drawing {
  name: string;
  caption: string;
  picture: SVGSVGElement;
  /// "slider" where arrow keys move through it, else it is a group of what is in it.
  role?: "slider";
  /// Draws for a picture of this size: letters have the size of the page's, whatever the picture's.
  lay: (width: number, height: number) => void;
  data: () => (string | number | null)[][];
}

export function layOut({ picture, lay }: Pick<Drawing, "picture" | "lay">, width: number, height: number): void {
  picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
  lay(width, height);
}

/// As large as its place, and drawn anew when that changes. `beside` stands between the picture and its caption.
export function figure(drawing: Drawing, ...beside: HTMLElement[]): HTMLElement {
  const { name, caption, picture, role, data } = drawing, place = html("div", { class: "picture" }, picture);
  picture.setAttribute("role", role ?? "group");
  picture.setAttribute("aria-label", caption);
  layOut(drawing, usual.width, usual.height);
  new ResizeObserver(() => {
    // Letters of a large screen are larger, and all else with them.
    const enlarged = parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
    if (place.clientWidth > 0 && place.clientHeight > 0) layOut(drawing, place.clientWidth / enlarged, place.clientHeight / enlarged);
  }).observe(place);
  return html("figure", {},
    place, ...beside,
    html("div", { class: "under" }, html("figcaption", {}, caption),
      html("div", { class: "row no-print" },
        button(words.saveSvg, () => save(`${name}.svg`, "image/svg+xml", standalone(picture)), { class: "quiet-button" }),
        button(words.saveData, () => save(`${name}.csv`, "text/csv", csv(data())), { class: "quiet-button" }))));
}

/// Other programs show a browser's `transparent` as black.
const transparent = "rgba(0, 0, 0, 0)";

/// The SVG with the styles that the page gives it on paper.
function standalone(picture: SVGSVGElement): string {
  const copy = picture.cloneNode(true) as SVGSVGElement;
  picture.classList.add("on-paper");
  const originals = [picture, ...picture.querySelectorAll<SVGElement>("*")];
  [copy, ...copy.querySelectorAll<SVGElement>("*")].forEach((element, i) => {
    const style = getComputedStyle(originals[i]!);
    for (const property of ["fill", "stroke", "stroke-width", "stroke-dasharray", "font-size", "font-family", "text-anchor", "opacity", "paint-order", "clip-path"])
      element.setAttribute(property, style.getPropertyValue(property).replace(transparent, "none"));
    element.removeAttribute("class");
    element.removeAttribute("tabindex");
  });
  picture.classList.remove("on-paper");
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  return new XMLSerializer().serializeToString(copy);
}

/// The pattern of what is not free.
export function hatching(id: string): SVGElement {
  return svg("pattern", { id, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
    svg("rect", { width: 6, height: 6, class: "unfree-back" }), svg("rect", { width: 2, height: 6, class: "unfree-line" }));
}

/// An element of a drawing that is pressed with mouse, finger or keyboard; as it is where there is nothing to press it for.
export function pressable<E extends SVGElement>(element: E, label: string, pressed: (() => void) | null): E {
  if (!pressed) return element;
  element.setAttribute("role", "button");
  element.setAttribute("tabindex", "0");
  element.setAttribute("aria-label", label);
  element.classList.add("pressable");
  element.addEventListener("click", pressed);
  element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    pressed();
  });
  return element;
}
