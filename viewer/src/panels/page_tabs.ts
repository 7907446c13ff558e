import { found, html } from "../dom";
import { words } from "../words";
import { Tabs } from "./tabs";

/// From here on figures stand beside the other panels.
const wide = matchMedia("(min-width: 150rem)");

/// Places the tabs of the page. The tab of plans is shown once a panel comes into it, the tab of figures only if it has any; on a wide screen
/// figures stand beside the other panels until `signal` is aborted.
export function placeTabs({ motion, figures, details }: Record<"motion" | "figures" | "details", HTMLElement>, signal: AbortSignal): Tabs {
  const planPanels = html("div", { id: "plan-panels" }), planTab = html("section", { "aria-label": words.tab.plan }, planPanels);
  const tabs = new Tabs(words.tabs, [
    { id: "motion", title: words.tab.motion, panel: motion }, { id: "figures", title: words.tab.figures, panel: figures },
    { id: "plan", title: words.tab.plan, panel: planTab }, { id: "details", title: words.tab.details, panel: details },
  ], () => document.getElementById("view-options")?.removeAttribute("open"));
  tabs.setShown("plan", false);
  planPanels.addEventListener("filled", () => tabs.setShown("plan", true));
  found("side").replaceChildren(tabs.list, ...tabs.panels);
  const hasFigures = figures.querySelector("figure, button") !== null;
  const arrange = () => {
    tabs.setBeside("figures", wide.matches && hasFigures);
    document.body.classList.toggle("wide", wide.matches && hasFigures);
    if (!hasFigures) tabs.setShown("figures", false);
  };
  wide.addEventListener("change", arrange, { signal });
  arrange();
  return tabs;
}
