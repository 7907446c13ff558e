import { button, html, namesOf, shortened } from "../dom";
import type { ReportText } from "../report";
import { words } from "../words";

/// "Right hip with an implant · femur / hip bone · date · version", beginning with the case if one was given.
export function headingOf(text: ReportText): string {
  const { joint, title, version, case: given, date } = text;
  return [
    ...(given ? [shortened(given)] : []), ...(title !== joint.name ? [shortened(title)] : []),
    words.heading(words.sides[joint.side], `${words.anatomies[joint.anatomy]}${text.rom?.implant ? words.withImplant : ""}`, namesOf(joint)), ...(date ? [shortened(date)] : []),
    ...(version ? [words.versionShown(version)] : []),
  ].join(" · ");
}

/// Actions on the whole page.
export function actions(does: { picture: (() => void) | null; print: () => void; copyLink: () => void; saveCopy: (() => void) | null }): HTMLElement[] {
  const card = helpCard();
  document.body.append(card);
  return [
    button(words.copyLink, does.copyLink), ...(does.saveCopy ? [button(words.saveCopy, does.saveCopy)] : []), ...(does.picture ? [button(words.picture, does.picture)] : []), button(words.print, does.print),
    button(words.help, () => card.showModal(), { "aria-label": words.helpLabel, id: "help-button" }),
  ];
}

function helpCard(): HTMLDialogElement {
  const card = html("dialog", { id: "help", "aria-label": words.helpLabel },
    html("p", {}, words.helpText), html("h2", {}, words.keysTitle),
    html("dl", {}, ...words.keys.flatMap(([key, does]) => [html("dt", {}, html("kbd", {}, key)), html("dd", {}, does)])),
    button(words.closeHelp, () => card.close()));
  card.addEventListener("click", (event) => {
    if (event.target === card) card.close();
  });
  return card;
}

/// Copies the address, or shows it if the browser does not let pages copy.
export async function copyLink(say: (message: string, ...parts: HTMLElement[]) => void): Promise<void> {
  try {
    await navigator.clipboard.writeText(location.href);
    say(words.linkCopied);
  } catch {
    const field = html("input", { type: "text", readonly: true, value: location.href, "aria-label": words.linkShown });
    say(words.linkShown, field);
    field.select();
  }
}

/// One key does what a button does, unless a field is typed in.
export function listenToKeys(does: Record<string, () => void>, signal: AbortSignal): void {
  document.addEventListener("keydown", (event) => {
    const { target, key } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    if (target instanceof HTMLElement && target.closest("input:not([type=range], [type=checkbox]), select, textarea")) return;
    // The space bar presses the focused element itself.
    if (key === " " && target instanceof Element && target.closest("button, summary, input, [role=button]")) return;
    const act = does[key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  }, { signal });
}
