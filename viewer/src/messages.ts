import { button, found, html } from "./dom";
import { lines } from "./panels/table";
import { words } from "./words";

/// A line over the scene: nothing else moves for it.
export function post(role: "alert" | "status", message: string, ...parts: HTMLElement[]): void {
  const line = html("p", { class: "warning" }, html("span", { role }, message), ...parts);
  if (role === "status") found("messages").querySelectorAll("[role=status]").forEach((old) => old.parentElement!.remove());
  line.append(button("×", () => line.remove(), { "aria-label": words.dismiss, class: "quiet-button" }));
  found("messages").append(line);
}

/// The cause in the first line of the message; lines below it are how that was inferred, and are folded away.
export function warn(message: string): void {
  const [cause, ...votes] = message.split("\n"), known = [...found("messages").querySelectorAll("[role=alert]")];
  // The same line once.
  if (known.some(({ textContent }) => textContent === cause)) return;
  post("alert", cause!, ...(votes.length ? [html("details", {}, html("summary", {}, words.votes), lines(votes))] : []));
}

export function clearMessages(): void {
  found("messages").replaceChildren();
}
