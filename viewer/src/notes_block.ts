import { bytesOf } from "./packed";
import { bodyNames } from "./scene/body_names";
import type { Picked } from "./scene/picking";

/// A user's additions to a page: they are saved with a copy of the page, in a block of its own beside the report's data.
export interface UserNotes {
  text: string;
  pins: Pin[];
}

export interface Pin extends Picked {
  text: string;
}

/// Notes and the view that a copy opens with, as the address has it.
export interface Copied extends UserNotes {
  view: string;
}

export const longestNotes = 20_000, longestPinText = 300, mostPins = 99;

/// A block that is none; the message is the key.
export class NotesError extends Error {}

const version = 1;

/// In base 64, which has no sign that HTML knows.
export function blockOf({ text, pins, view }: Copied): string {
  const stored = { condyle_notes: version, text, pins: pins.map(({ body, vertex, text: said }) => ({ body, vertex, text: said })), view };
  return btoa(Array.from(new TextEncoder().encode(JSON.stringify(stored)), (byte) => String.fromCharCode(byte)).join(""));
}

/// `vertices` are how many each body has.
export function copiedOf(block: string, vertices: Record<Pin["body"], number>): Copied {
  const check = (right: boolean, key: string) => {
    if (!right) throw new NotesError(key);
  };
  const isText = (value: unknown, most: number) => typeof value === "string" && value.length <= most;
  let said: Partial<Copied> & { condyle_notes?: number };
  try {
    said = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytesOf(block))) as typeof said;
  } catch {
    throw new NotesError("condyle-notes");
  }
  check(typeof said === "object" && said !== null && said.condyle_notes === version, "condyle_notes");
  check(isText(said.text, longestNotes), "text");
  check(isText(said.view, longestNotes) && (said.view === "" || said.view!.startsWith("#")), "view");
  check(Array.isArray(said.pins) && said.pins.length <= mostPins, "pins");
  said.pins!.forEach((pin: Partial<Pin> | null, i) => {
    const { body, vertex, text } = pin ?? {};
    check(body !== undefined && bodyNames.includes(body), `pins[${i}].body`);
    check(Number.isInteger(vertex) && vertex! >= 0 && vertex! < vertices[body!], `pins[${i}].vertex`);
    check(isText(text, longestPinText), `pins[${i}].text`);
  });
  return said as Copied;
}

/// The text, if there is one, and every pin.
export function countOf({ text, pins }: UserNotes): number {
  return pins.length + (text.trim() ? 1 : 0);
}
