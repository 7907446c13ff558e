import { button, choice, html } from "../dom";
import type { BodyName } from "../scene/body_names";
import type { Picked } from "../scene/picking";
import { words } from "../words";

const clickTolerance_px = 4;

/// A press on the scene that did not turn the joint.
export function listenToPresses(canvas: HTMLCanvasElement, pressed: (event: MouseEvent) => void): void {
  let [x, y] = [0, 0];
  canvas.addEventListener("pointerdown", (event) => ([x, y] = [event.clientX, event.clientY]));
  canvas.addEventListener("click", (event) => {
    if (Math.hypot(event.clientX - x, event.clientY - y) <= clickTolerance_px) pressed(event);
  });
}

/// A vertex by its number, for who has no pointer: `last` of each body. `refused` gets the reason for one that there is not.
export function vertexByNumber(
  said: Record<"body" | "number" | "button", string>, names: Record<BodyName, string>, last: (body: BodyName) => number,
  chosen: (picked: Picked) => void, refused: (why: string) => void): { bodies: HTMLElement; number: HTMLInputElement; submit: HTMLElement } {
  const number = html("input", { type: "number", min: 0, max: last("mobile"), step: 1, value: 0, "aria-label": said.number });
  const bodies = choice<BodyName>(said.body, { mobile: names.mobile, fixed: names.fixed }, "mobile", (body) => (number.max = String(last(body))));
  const submit = () => {
    const vertex = number.valueAsNumber, body = bodies.querySelector("select")!.value as BodyName;
    if (Number.isInteger(vertex) && vertex >= 0 && vertex <= last(body)) chosen({ body, vertex });
    else refused(words.noVertex(names[body], last(body)));
  };
  number.addEventListener("keydown", ({ key }) => {
    if (key === "Enter") submit();
  });
  return { bodies, number, submit: button(said.button, submit) };
}
