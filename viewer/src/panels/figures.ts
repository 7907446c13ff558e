import { choice, html } from "../dom";
import { words } from "../words";

export interface FigureGroup {
  key: string;
  figures: readonly HTMLElement[];
}

/// Figures, as many at once as fit: if there are more, a group of them is chosen; a wide screen shows them all.
export function figuresPanel(groups: readonly FigureGroup[]): HTMLElement {
  const filled = groups.filter(({ figures }) => figures.length > 0);
  const places = filled.map(({ figures }) => html("div", { class: "figure-group" }, ...figures));
  const show = (key: string) => places.forEach((place, i) => place.classList.toggle("chosen", filled[i]!.key === key));
  const panel = html("section", { "aria-label": words.figures });
  if (filled.length > 1)
    panel.append(html("div", { class: "row no-print group-choice" },
      choice(words.figureGroup, Object.fromEntries(filled.map(({ key }) => [key, words.figureGroups[key] ?? ""])), filled[0]!.key, show)));
  if (filled.length) show(filled[0]!.key);
  panel.append(...places);
  return panel;
}
