import { html } from "../dom";
import { words } from "../words";

/// One figure at a time, by a row of buttons if there are more.
export function figuresPanel(figures: readonly { key: string; parts: readonly HTMLElement[] }[]): HTMLElement {
  const places = figures.map(({ parts }) => html("div", { class: "figure-place" }, ...parts));
  const choices = figures.map(({ key }) => html("label", {}, html("input", { type: "radio", name: "figure", value: key }), words.figureNames[key] ?? ""));
  choices.forEach((choice, i) => choice.firstElementChild!.addEventListener("change", () => show(i)));
  const show = (chosen: number) => places.forEach((place, i) => {
    place.hidden = i !== chosen;
    (choices[i]!.firstElementChild as HTMLInputElement).checked = i === chosen;
  });
  // Who recorded a motion asks for it first.
  show(Math.max(0, figures.findIndex(({ key }) => key === "curves")));
  return html("section", { "aria-label": words.figures },
    ...(figures.length > 1 ? [html("div", { class: "segments no-print", role: "radiogroup", "aria-label": words.figures }, ...choices)] : []), ...places);
}
