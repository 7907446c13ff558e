import { html, shortened } from "../dom";

/// More of a note, or of a path in the first column of a table, is not read.
export const longestLine = 1000, longestHead = 200;

/// A table under its title; the first cell of each row heads it.
export function table(head: readonly string[], rows: readonly (readonly (string | Node)[])[], title: string): HTMLElement {
  const caption = shortened(title, longestLine);
  return html("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    html("table", {}, html("caption", {}, caption),
      html("thead", {}, html("tr", {}, ...head.map((text) => (text ? html("th", { scope: "col" }, text) : html("td"))))),
      html("tbody", {}, ...rows.map(([first, ...cells]) =>
        html("tr", {}, html("th", { scope: "row" }, typeof first === "string" ? shortened(first, longestHead) : first!), ...cells.map((cell) => html("td", {}, cell)))))));
}

export function lines(texts: readonly string[]): HTMLElement {
  return html("ul", {}, ...texts.map((text) => html("li", {}, shortened(text, longestLine))));
}
