import { html } from "../dom";

/// Puts a panel into the tab of plans, under its title. Panels stand there one at a time: one that is opened closes the others.
export function addPlanPanel(element: HTMLElement): void {
  const place = document.getElementById("plan-panels");
  if (!place) return;
  const title = element.querySelector("h2");
  place.append(html("details", { name: "plan-panels", class: "fold", open: place.childElementCount === 0 },
    html("summary", {}, title ?? ""), html("p", { class: "small must-wait", role: "status" }), element));
  place.dispatchEvent(new Event("filled", { bubbles: true }));
}

/// Replaces a panel by the reason why it waits: only one panel changes the joint at a time. Null: it works.
export function setBlocked(element: HTMLElement, why: string | null): void {
  element.hidden = why !== null;
  const said = element.previousElementSibling;
  if (said) said.textContent = why;
}
