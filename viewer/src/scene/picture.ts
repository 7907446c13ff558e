import { html } from "../dom";
import { words } from "../words";
import type { ColourScale } from "./colour_scale";
import { drawBar, drawSwatch, legendParts, tickTexts } from "./legend";
import { placeOfLabel, scaleBarText, type Written } from "./overlay";

const ink = "#1b1f24", paper = "#ffffff", pinPaper = "#fff8e1", ribbonGround = "#6a3d9a";
const titleHeight = 34, ribbonHeight = 28;
const font = (size: number, weight = "") => `${weight} ${size}px system-ui, sans-serif`;

/// The scene on white paper with its title, ribbon, letters, scale bar, legend and pin, at `ratio` pixels to one of the page.
export function composedPicture(
  scene: HTMLCanvasElement, ratio: number, title: string, ribbon: string | null, written: Written, scale: ColourScale | null): HTMLCanvasElement {
  const head = title ? titleHeight + (ribbon ? ribbonHeight : 0) : 0, { width, height } = written;
  const canvas = html("canvas", { width: Math.round(width * ratio), height: Math.round((height + head) * ratio) });
  const context = canvas.getContext("2d")!;
  context.scale(ratio, ratio);
  context.fillStyle = paper;
  context.fillRect(0, 0, width, height + head);
  context.fillStyle = ink;
  context.textBaseline = "middle";
  if (title) {
    context.font = font(16, "600");
    context.fillText(title, 10, titleHeight / 2, width - 20);
  }
  if (title && ribbon) {
    context.fillStyle = ribbonGround;
    context.fillRect(0, titleHeight, width, ribbonHeight);
    context.fillStyle = paper;
    context.fillText(ribbon, 10, titleHeight + ribbonHeight / 2, width - 20);
  }
  context.translate(0, head);
  context.drawImage(scene, 0, 0, width, height);
  drawLetters(context, written);
  drawScaleBar(context, written);
  if (scale) drawLegend(context, scale, written);
  for (const { x, y, number } of written.numbered) drawNumber(context, x, y, String(number));
  if (written.pin) drawPin(context, written);
  return canvas;
}

/// Text that stays readable over bone.
function lettered(context: CanvasRenderingContext2D, text: string, x: number, y: number): void {
  context.strokeStyle = paper;
  context.lineWidth = 4;
  context.lineJoin = "round";
  context.strokeText(text, x, y);
  context.fillStyle = ink;
  context.fillText(text, x, y);
}

function drawLetters(context: CanvasRenderingContext2D, { width, height, edges }: Written): void {
  context.font = font(15, "700");
  context.textAlign = "center";
  lettered(context, edges.top, width / 2, 14);
  lettered(context, edges.bottom, width / 2, height - 14);
  lettered(context, edges.left, 16, height / 2);
  lettered(context, edges.right, width - 16, height / 2);
  context.textAlign = "left";
}

function drawScaleBar(context: CanvasRenderingContext2D, { height, scaleBar }: Written): void {
  const left = 12, top = height - 18;
  context.font = font(13);
  lettered(context, scaleBarText(scaleBar), left, top - 12);
  for (const [colour, wide] of [[paper, 5], [ink, 2]] as const) {
    context.strokeStyle = colour;
    context.lineWidth = wide;
    context.beginPath();
    context.moveTo(left, top - 3);
    context.lineTo(left, top + 4);
    context.lineTo(left + scaleBar.length, top + 4);
    context.lineTo(left + scaleBar.length, top - 3);
    context.stroke();
  }
}

function drawLegend(context: CanvasRenderingContext2D, scale: ColourScale, { width }: Written): void {
  const { title, ticks, below, above, bound } = legendParts(scale);
  const x = 12, y = 10, swatch = 22, gap = 4, bar = Math.min(170, 0.4 * width - 2 * swatch), high = 12;
  const left = below ? x + swatch + gap : x;
  context.font = font(13);
  lettered(context, title, x, y + 6);
  const top = y + 18;
  if (below) drawSwatch(context, below, x, top, swatch, high);
  drawBar(context, scale, left, top, bar, high);
  drawSwatch(context, above, left + bar + gap, top, swatch, high);
  context.strokeStyle = ink;
  context.lineWidth = 0.75;
  for (const [from, wide] of [...(below ? [[x, swatch]] : []), [left, bar], [left + bar + gap, swatch]] as [number, number][])
    context.strokeRect(from, top, wide, high);
  const base = top + high + 10;
  context.textAlign = "center";
  context.font = font(12);
  if (below) lettered(context, "<", x + swatch / 2, base);
  lettered(context, ">", left + bar + gap + swatch / 2, base);
  for (const { text, share } of tickTexts(scale, ticks)) {
    context.textAlign = share === 0 ? "left" : share === 1 ? "right" : "center";
    lettered(context, text, left + share * bar, base);
  }
  context.textAlign = "left";
  if (!bound) return;
  drawSwatch(context, bound, x, base + 12, swatch, high);
  lettered(context, words.onlyABound, x + swatch + 6, base + 18);
}

function drawNumber(context: CanvasRenderingContext2D, x: number, y: number, number: string): void {
  context.font = font(13, "700");
  context.beginPath();
  context.arc(x, y, Math.max(10, context.measureText(number).width / 2 + 5), 0, 2 * Math.PI);
  context.fillStyle = paper;
  context.fill();
  context.strokeStyle = ink;
  context.lineWidth = 2;
  context.stroke();
  context.fillStyle = ink;
  context.textAlign = "center";
  context.fillText(number, x, y + 1);
  context.textAlign = "left";
}

function drawPin(context: CanvasRenderingContext2D, written: Written): void {
  const { x, y, label } = written.pin!;
  context.font = font(14, "600");
  const width = Math.min(context.measureText(label).width + 16, written.width - 12), height = 26, at = placeOfLabel(written, width, height);
  context.strokeStyle = ink;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(at.x + width / 2, at.y + height / 2);
  context.stroke();
  context.beginPath();
  context.arc(x, y, 5, 0, 2 * Math.PI);
  context.stroke();
  context.fillStyle = pinPaper;
  context.fillRect(at.x, at.y, width, height);
  context.strokeRect(at.x, at.y, width, height);
  context.fillStyle = ink;
  context.fillText(label, at.x + 8, at.y + height / 2 + 1, width - 16);
}
