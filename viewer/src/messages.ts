import { button, html } from "./dom";
import { words } from "./words";

function place(): HTMLElement {
  return document.getElementById("messages")!;
}

/// A line over the scene: nothing else moves for it.
export function post(role: "alert" | "status", message: string, ...parts: HTMLElement[]): void {
  const line = html("p", { class: "warning" }, html("span", { role }, message), ...parts);
  if (role === "status") place().querySelectorAll("[role=status]").forEach((old) => old.parentElement!.remove());
  line.append(button("×", () => line.remove(), { "aria-label": words.dismiss, class: "quiet-button" }));
  place().append(line);
}

export function warn(message: string): void {
  // The same line once.
  const known = [...place().querySelectorAll("[role=alert]")];
  if (!known.some(({ textContent }) => textContent === message)) post("alert", message);
}

export function clearMessages(): void {
  place().replaceChildren();
}
