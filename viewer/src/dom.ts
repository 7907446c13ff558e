/// Elements with attributes and children; text is only ever set as text.
type Attributes = Record<string, string | number | boolean>;
type Child = Node | string;

function filled<E extends Element>(element: E, attributes: Attributes, children: readonly Child[]): E {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false) continue;
    element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

export function html<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return filled(document.createElement(tag), attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  return filled(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

/// The element of the page that has this id.
export function found<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/// Its text; null if the page has no such element.
export function textOf(id: string): string | null {
  return document.getElementById(id)?.textContent ?? null;
}

/// A title over contents, as one landmark of the page.
export function section(title: string, ...children: Child[]): HTMLElement {
  const id = `section-${title.toLowerCase().replaceAll(/[^a-z]+/g, "-")}`;
  return html("section", { "aria-labelledby": id }, html("h2", { id }, title), ...children);
}

/// A title that opens its contents, as one landmark of the page.
export function fold(title: string, open: boolean, ...children: Child[]): HTMLDetailsElement {
  const id = `section-${title.toLowerCase().replaceAll(/[^a-z]+/g, "-")}`;
  return html("details", { class: "fold", open },
    html("summary", {}, html("h2", { id }, title)), html("section", { "aria-labelledby": id }, ...children));
}

export function button(text: string, pressed: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const element = html("button", { type: "button", ...attributes }, text);
  element.addEventListener("click", pressed);
  return element;
}

export function checkbox(text: string, checked: boolean, changed: (on: boolean) => void): HTMLLabelElement {
  const input = html("input", { type: "checkbox", checked });
  input.addEventListener("change", () => changed(input.checked));
  return html("label", { class: "check" }, input, " ", text);
}

export function choice<Key extends string>(
  text: string, options: Record<Key, string>, chosen: Key, changed: (key: Key) => void): HTMLElement {
  const id = `choice-${text.toLowerCase().replaceAll(/[^a-z]+/g, "-")}`;
  const select = html("select", { id });
  for (const [key, name] of Object.entries(options) as [Key, string][])
    select.append(html("option", { value: key, selected: key === chosen }, name));
  select.addEventListener("change", () => changed(select.value as Key));
  return html("span", {}, html("label", { for: id }, text), " ", select);
}

/// Marks the element of this name as the current one; null: none.
export function markCurrent(elements: ReadonlyMap<string, Element>, current: string | null): void {
  for (const [name, element] of elements)
    if (name === current) element.setAttribute("aria-current", "true");
    else element.removeAttribute("aria-current");
}

/// A name with underscores as words.
export function spaced(name: string): string {
  return name.replaceAll("_", " ");
}

const longest = 60;

/// A text shortened to a readable length.
export function shortened(text: string, most = longest): string {
  return text.length > most ? `${text.slice(0, most - 1)}…` : text;
}

/// Latin, Greek and Cyrillic letters, digits and punctuation: all of them run as the page's own sentences do.
const runsAlong = /^[\x20-\x7e\u00a0-\u052f\u2010-\u2027\u2030-\u205e]*$/;

/// A name that fits into a sentence without changing the direction of the text around it.
export function named(name: string): string {
  const short = shortened(name).replaceAll(/\p{Bidi_Control}/gu, "");
  return runsAlong.test(short) ? short : `\u2068${short}\u2069`;
}

/// The bodies of a joint in words; a file keeps its name.
export function namesOf({ fixed, mobile }: Record<"fixed" | "mobile", string>): Record<"fixed" | "mobile", string> {
  const inWords = (name: string) => (/\.\w+$/.test(name) ? named(name) : spaced(named(name)));
  return { fixed: inWords(fixed), mobile: inWords(mobile) };
}
