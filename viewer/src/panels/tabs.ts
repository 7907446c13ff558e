import { html } from "../dom";

/// One panel at a time. A tab whose panel has nothing, or stands elsewhere, is hidden.
export class Tabs {
  readonly list: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private chosen = 0;

  constructor(
    label: string, private readonly tabs: readonly { id: string; title: string; panel: HTMLElement }[], private readonly changed: (id: string) => void) {
    this.buttons = tabs.map(({ id, title, panel }, i) => {
      panel.id = `panel-${id}`;
      panel.classList.add("panel");
      panel.setAttribute("role", "tabpanel");
      panel.setAttribute("aria-labelledby", `tab-${id}`);
      const tab = html("button", { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": panel.id }, title);
      tab.addEventListener("click", () => this.choose(i));
      tab.addEventListener("keydown", (event) => this.move(event));
      return tab;
    });
    this.list = html("div", { role: "tablist", "aria-label": label }, ...this.buttons);
    this.choose(0);
  }

  get panels(): HTMLElement[] {
    return this.tabs.map(({ panel }) => panel);
  }

  show(id: string): void {
    const i = this.tabs.findIndex((tab) => tab.id === id);
    if (i >= 0 && !this.buttons[i]!.hidden) this.choose(i);
  }

  /// The tab at that place, from 1, as the keys 1 to 4 name it.
  showNumber(number: number): void {
    const tab = this.tabs[number - 1];
    if (tab) this.show(tab.id);
  }

  setShown(id: string, shown: boolean): void {
    const i = this.tabs.findIndex((tab) => tab.id === id);
    this.buttons[i]!.hidden = !shown;
    if (!shown && this.chosen === i) this.choose(this.buttons.findIndex(({ hidden }) => !hidden));
  }

  /// A panel that stands beside the others on a wide screen is shown whatever the tab.
  setBeside(id: string, beside: boolean): void {
    const panel = this.tabs.find((tab) => tab.id === id)!.panel;
    panel.classList.toggle("beside", beside);
    this.setShown(id, !beside);
    this.choose(this.chosen);
  }

  private choose(chosen: number): void {
    this.chosen = chosen;
    this.buttons.forEach((button, i) => {
      button.setAttribute("aria-selected", String(i === chosen));
      button.tabIndex = i === chosen ? 0 : -1;
      this.tabs[i]!.panel.hidden = i !== chosen && !this.tabs[i]!.panel.classList.contains("beside");
    });
    this.changed(this.tabs[chosen]!.id);
  }

  private move(event: KeyboardEvent): void {
    const open = this.buttons.map((_, i) => i).filter((i) => !this.buttons[i]!.hidden);
    const at = open.indexOf(this.chosen);
    const to = ({ ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: open.length - 1 } as Record<string, number>)[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.choose(open[(to + open.length) % open.length]!);
    this.buttons[this.chosen]!.focus();
  }
}
