import { html } from "../dom";
import { words } from "../words";

let isKnown = false;

/// What to do first, over the scene until something is done.
export function hintAt(scene: HTMLElement): void {
  if (isKnown) return;
  const hint = html("p", { class: "scene-hint no-print" }, words.firstHint), done = new AbortController();
  scene.append(hint);
  for (const gesture of ["pointerdown", "keydown", "wheel"])
    window.addEventListener(gesture, () => {
      isKnown = true;
      hint.remove();
      done.abort();
    }, { signal: done.signal, capture: true, passive: true });
}
