import { html } from "../dom";
import { fixed, plain, typed } from "../numbers";
import { words } from "../words";

/// Why typed text is no number from `low` to `high`; null if it is one.
export function refusalOf(text: string, low: number, high: number, unit: string, digits = 1): string | null {
  const said = typed(text), shown = (value: number) => `${plain(value, digits)}${unit}`;
  return said === null ? words.noNumber : said >= low && said <= high ? null : words.notTaken(shown(said), shown(low), shown(high));
}

/// A number that is typed, and taken once it is finished, or stepped by arrow keys. Anything but a number in its range is refused, and a
/// line says so: typed text never silently becomes another number.
export class NumberField {
  readonly input: HTMLInputElement;
  private value = 0;

  /// `refused` with the reason, or null once there is none.
  constructor(
    label: string, private readonly low: number, private readonly high: number, private readonly step: number, private readonly unit: string,
    disabled: boolean, private readonly taken: (value: number) => void, private readonly refused: (why: string | null) => void,
    private readonly digits = 1) {
    this.input = html("input", {
      type: "text", inputmode: "decimal", role: "spinbutton", autocomplete: "off", spellcheck: "false", class: "number", "aria-label": label,
      "aria-valuemin": low, "aria-valuemax": high, disabled,
    });
    this.input.addEventListener("change", () => this.read());
    this.input.addEventListener("input", () => this.input.removeAttribute("aria-invalid"));
    // A field that is left shows its value again; the line on what was refused stays.
    this.input.addEventListener("blur", () => {
      this.input.value = fixed(this.value, this.digits);
      this.input.removeAttribute("aria-invalid");
    });
    this.input.addEventListener("keydown", (event) => {
      const steps = ({ ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 } as Record<string, number>)[event.key];
      if (event.key === "Escape") this.show(this.value);
      if (steps === undefined) return;
      event.preventDefault();
      this.take(Math.min(this.high, Math.max(this.low, this.value + steps * this.step)));
      this.show(this.value);
    });
    this.show(0);
  }

  /// The value accepted last.
  get number(): number {
    return this.value;
  }

  /// Rounded to `digits`; the number itself keeps all of its digits.
  show(value: number): void {
    this.value = value;
    if (document.activeElement !== this.input || typed(this.input.value) !== value) this.input.value = fixed(value, this.digits);
    this.input.setAttribute("aria-valuenow", String(value));
    this.input.removeAttribute("aria-invalid");
  }

  private read(): void {
    // What is shown is rounded, and is not another number.
    if (this.input.value === fixed(this.value, this.digits)) return;
    const why = refusalOf(this.input.value, this.low, this.high, this.unit, this.digits);
    if (why === null) return this.take(typed(this.input.value)!);
    this.input.setAttribute("aria-invalid", "true");
    this.refused(why);
  }

  private take(value: number): void {
    this.value = value;
    this.input.setAttribute("aria-valuenow", String(value));
    this.input.removeAttribute("aria-invalid");
    this.refused(null);
    this.taken(value);
  }
}
