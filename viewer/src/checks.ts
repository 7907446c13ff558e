import { words } from "./words";

/// Damage that the page reports in one line.
export class ReportError extends Error {}

/// Throws ReportError if a value is not of the kind that its key requires.
export type Check = (value: unknown, key: string) => void;

export function wrong(key: string): never {
  throw new ReportError(words.damaged + words.wrongKey(key));
}

export const text: Check = (value, key) => typeof value === "string" || wrong(key);
export const number: Check = (value, key) => typeof value === "number" || wrong(key);
export const count: Check = (value, key) => (Number.isSafeInteger(value) && (value as number) >= 0) || wrong(key);
export const flag: Check = (value, key) => typeof value === "boolean" || wrong(key);
export const oneOf = (...known: readonly string[]): Check => (value, key) => known.includes(value as string) || wrong(key);
export const orNull = (check: Check): Check => (value, key) => value === null || check(value, key);
export const ifThere = (check: Check): Check => (value, key) => value === undefined || check(value, key);
export const list = (check: Check, length?: number): Check => (value, key) => {
  if (!Array.isArray(value) || (length !== undefined && value.length !== length)) return wrong(key);
  value.forEach((item, i) => check(item, `${key}[${i}]`));
};
export function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
export const object = (keys: Record<string, Check>): Check => (value, key) => {
  if (!isObject(value)) return wrong(key);
  for (const [name, check] of Object.entries(keys)) check(value[name], key ? `${key}.${name}` : name);
};
export const each = (check: Check): Check => (value, key) => {
  if (!isObject(value)) return wrong(key);
  for (const [name, item] of Object.entries(value)) check(item, `${key}.${name}`);
};
export const three = list(number, 3);
