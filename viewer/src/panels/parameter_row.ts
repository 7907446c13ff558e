import { html, named, spaced } from "../dom";
import { fixed, plain } from "../numbers";
import type { StoredParameter } from "../report";
import { words } from "../words";
import { NumberField } from "./angle_field";

/// Steps of a slider, in its unit; a size has as many as a hundred.
const step = 0.5, stepsOfSize = 100;

/// The slider and the field of one parameter of a part.
export class ParameterRow {
  readonly element: HTMLElement;
  readonly name: string;
  private readonly field: NumberField;
  private readonly slider: HTMLInputElement;
  private readonly unit: string;
  private readonly digits: number;

  /// `moved` with the new value taken; `refused` as of NumberField.
  constructor(part: string, private readonly parameter: StoredParameter, moved: () => void, refused: (why: string | null) => void) {
    const { range: [low, high], kind } = parameter, isSize = kind === "size";
    this.name = `${part}.${parameter.name}`;
    this.unit = words.partUnit[parameter.unit] ?? "";
    const by = isSize ? (high - low) / stepsOfSize : step;
    this.digits = by < 0.1 ? 3 : 1;
    const title = `${spaced(named(part))} ${spaced(named(parameter.name))}`, label = words.parameterLabel(title, this.unit.trim());
    this.field = new NumberField(label, low, high, by, this.unit, false, (value) => {
      this.write(value);
      moved();
    }, refused, this.digits);
    this.slider = html("input", { type: "range", min: low, max: high, step: by, "aria-label": words.sliderOf(label) });
    this.slider.addEventListener("input", () => {
      this.show(this.slider.valueAsNumber);
      moved();
    });
    this.element = html("div", { class: "row no-print parameter-row" }, html("span", { "aria-hidden": "true" }, title), this.slider, this.field.input,
      html("span", { class: "small quiet" }, this.rangeText()));
    this.show(parameter.value);
  }

  get value(): number {
    return this.field.number;
  }
  get reported(): number {
    return this.parameter.value;
  }
  get inFile(): number {
    return this.parameter.in_joint_file;
  }
  get isTurned(): boolean {
    return this.value !== this.reported;
  }

  show(value: number): void {
    this.field.show(value);
    this.write(value);
  }

  /// A slider shows what its steps can; the field keeps every digit.
  private write(value: number): void {
    this.slider.value = String(value);
    this.slider.setAttribute("aria-valuetext", `${fixed(value, this.digits)}${this.unit}`);
  }

  private rangeText(): string {
    const { range: [low, high], sigma } = this.parameter, { unit, digits } = this;
    return words.parameterRange(`${plain(low, digits)} to ${plain(high, digits)}${unit}`, sigma > 0 ? `${plain(sigma, digits)}${unit}` : null);
  }
}
