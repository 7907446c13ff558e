/// Numbers for readers: a true minus sign, and no minus before a zero.
export const minusSign = "\u2212";

export function fixed(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", minusSign);
}

/// With its sign, but for zero: +12.3, −3.0, 0.0.
export function signed(value: number, digits: number): string {
  const text = fixed(value, digits);
  return value > 0 && Number(text) !== 0 ? `+${text}` : text;
}

/// The shortest form: 120, 0.5, −30.
export function plain(value: number, digits = 1): string {
  return String(Number(value.toFixed(digits))).replace("-", minusSign);
}

/// A bound in one digit, never below it: 3e-8.
export function atMost(bound: number): string {
  let value = bound, text = bound.toExponential(0);
  while (Number(text) < bound) text = (value *= 1.01).toExponential(0);
  return text;
}

/// The number in typed text, with either minus sign and a decimal point or comma; null for anything else.
export function typed(text: string): number | null {
  const said = text.trim().replaceAll(minusSign, "-").replace(",", ".").replace(/°$/, "");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(said) ? Number(said) : null;
}

/// 1.5 as "1:30".
export function clockTime(hour: number): string {
  const minutes = Math.round(hour * 60) % 720;
  return `${Math.floor(minutes / 60) || 12}:${String(minutes % 60).padStart(2, "0")}`;
}
