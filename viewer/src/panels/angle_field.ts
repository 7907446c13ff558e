import { html } from "../dom";
import { fixed, plain, typed } from "../numbers";
import { words } from "../words";

/// A number that is typed, or stepped by arrow keys. Anything but a number in its range is refused, and the field says so: typed
/// text never silently becomes another number.
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
    this.input.addEventListener("input", () => this.read());
    this.input.addEventListener("blur", () => this.show(this.value));
    this.input.addEventListener("keydown", (event) => {
      const steps = ({ ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 } as Record<string, number>)[event.key];
      if (event.key === "Enter" || event.key === "Escape") this.show(this.value);
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
    this.clear();
  }

  private read(): void {
    const said = typed(this.input.value);
    if (said !== null && said >= this.low && said <= this.high) return this.take(said);
    this.input.setAttribute("aria-invalid", "true");
    this.refused(said === null ? words.noNumber : words.notTaken(...this.texts(said, this.low, this.high)));
  }

  private texts(...numbers: [number, number, number]): [string, string, string] {
    return numbers.map((number) => `${plain(number, this.digits)}${this.unit}`) as [string, string, string];
  }

  private take(value: number): void {
    this.value = value;
    this.input.setAttribute("aria-valuenow", String(value));
    this.clear();
    this.taken(value);
  }

  private clear(): void {
    if (!this.input.hasAttribute("aria-invalid")) return;
    this.input.removeAttribute("aria-invalid");
    this.refused(null);
  }
}
