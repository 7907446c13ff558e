import { html } from "../dom";
import { words } from "../words";
import { plainBone, strength, stripeColour, tickText, type ColourScale } from "./colour_scale";

const barSteps = 256;

/// Swatches beside the bar: colours of values beyond its ends, and of bounds.
export interface Swatch {
  fill: "striped" | "plain" | "hatched";
  colour: string;
}

/// A legend in numbers and colours: the page's element and its picture are drawn from it.
export interface LegendParts {
  title: string;
  ticks: number[];
  below: Swatch | null;
  above: Swatch;
  bound: Swatch | null;
}

const hatchDark = "#7c7c7c", hatchLight = "#c4c4c4";

export function legendParts(scale: ColourScale): LegendParts {
  const { quantity, low, high } = scale;
  return {
    title: words.legendTitle(words.quantity[quantity], words.unit[quantity]),
    ticks: [low, (low + high) / 2, high],
    below: low < 0 ? { fill: "striped", colour: scale.colour(low) } : null,
    above: scale.plainAbove ? { fill: "plain", colour: plainBone } : { fill: "striped", colour: scale.colour(high) },
    bound: quantity === "depth" ? { fill: "hatched", colour: hatchLight } : null,
  };
}

/// Ticks as words: each with how far along the bar it is.
export function tickTexts({ low, high }: ColourScale, ticks: readonly number[]): { text: string; share: number }[] {
  return ticks.map((tick) => ({ text: tickText(tick), share: (tick - low) / (high - low) }));
}

export function drawBar(context: CanvasRenderingContext2D, scale: ColourScale, x: number, y: number, width: number, height: number): void {
  context.fillStyle = plainBone;
  context.fillRect(x, y, width, height);
  for (let i = 0; i < barSteps; ++i) {
    const amount = scale.low + ((scale.high - scale.low) * i) / (barSteps - 1), left = x + (width * i) / barSteps;
    context.globalAlpha = strength(scale, amount);
    context.fillStyle = scale.colour(amount);
    context.fillRect(left, y, x + (width * (i + 1)) / barSteps - left, height);
  }
  context.globalAlpha = 1;
}

/// Drawn as on the surface.
export function drawSwatch(context: CanvasRenderingContext2D, { fill, colour }: Swatch, x: number, y: number, width: number, height: number): void {
  context.save();
  context.beginPath();
  context.rect(x, y, width, height);
  context.clip();
  context.fillStyle = colour;
  context.fillRect(x, y, width, height);
  if (fill !== "plain") {
    context.strokeStyle = fill === "striped" ? stripeColour : hatchDark;
    context.lineWidth = fill === "striped" ? 1.5 : 2.5;
    const sense = fill === "striped" ? 1 : -1, step = 5.5;
    for (let at = -height; at < width + height; at += step) {
      context.beginPath();
      context.moveTo(x + at, y);
      context.lineTo(x + at + sense * height, y + height);
      context.stroke();
    }
  }
  context.restore();
}

function swatchElement(swatch: Swatch, where: string): HTMLCanvasElement {
  const canvas = html("canvas", { width: 22, height: 12, class: `swatch ${where}`, "aria-hidden": "true" });
  drawSwatch(canvas.getContext("2d")!, swatch, 0, 0, canvas.width, canvas.height);
  return canvas;
}

/// The legend within the scene.
export function legendElement(scale: ColourScale): HTMLElement[] {
  const { title, ticks, below, above, bound } = legendParts(scale);
  const bar = html("canvas", { width: barSteps, height: 1, class: "bar", "aria-hidden": "true" });
  drawBar(bar.getContext("2d")!, scale, 0, 0, barSteps, 1);
  return [
    html("span", { class: "title" }, title), bar,
    ...(below ? [swatchElement(below, "below"), html("span", { class: "below" }, "<")] : []),
    swatchElement(above, "above"), html("span", { class: "above" }, ">"),
    html("span", { class: "ticks" }, ...tickTexts(scale, ticks).map(({ text }) => html("span", {}, text))),
    ...(bound ? [html("span", { class: "bound" }, swatchElement(bound, "hatched"), " ", words.onlyABound)] : []),
  ];
}
