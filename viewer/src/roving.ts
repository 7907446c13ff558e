/// Only one of many buttons is a tab stop; arrow keys lead from it to the others.
export function roving(elements: readonly (HTMLElement | SVGElement)[], columns = 1): void {
  elements.forEach((element, i) => element.setAttribute("tabindex", i === 0 ? "0" : "-1"));
  elements.forEach((element, i) => {
    element.addEventListener("focus", () => {
      for (const other of elements) other.setAttribute("tabindex", other === element ? "0" : "-1");
    });
    element.addEventListener("keydown", (event) => {
      const { key } = event as KeyboardEvent;
      const to = ({
        ArrowLeft: i - 1, ArrowRight: i + 1, ArrowUp: i - columns, ArrowDown: i + columns, Home: 0, End: elements.length - 1,
      } as Record<string, number>)[key];
      if (to === undefined) return;
      event.preventDefault();
      elements[to]?.focus();
    });
  });
}
