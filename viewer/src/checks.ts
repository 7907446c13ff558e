import { words } from "./words";

/// Damage that the page reports in one line.
export class ReportError extends Error {}

/// Throws ReportError if a value is not of the kind that its key requires. A value that passes has the type `Type`.
export interface Check<Type = unknown> {
  (value: unknown, key: string): void;
  readonly passes?: Type;
}
export type Passed<Of> = Of extends Check<infer Type> ? Type : never;

export function wrong(key: string): never {
  throw new ReportError(words.damaged + words.wrongKey(key));
}

export const text: Check<string> = (value, key) => typeof value === "string" || wrong(key);
export const number: Check<number> = (value, key) => typeof value === "number" || wrong(key);
export const count: Check<number> = (value, key) => (Number.isSafeInteger(value) && (value as number) >= 0) || wrong(key);
export const flag: Check<boolean> = (value, key) => typeof value === "boolean" || wrong(key);
export const oneOf = <Word extends string>(...known: readonly Word[]): Check<Word> => (value, key) => known.includes(value as Word) || wrong(key);
export const orNull = <Type>(check: Check<Type>): Check<Type | null> => (value, key) => value === null || check(value, key);
export const ifThere = <Type>(check: Check<Type>): Check<Type | undefined> => (value, key) => value === undefined || check(value, key);
export const list = <Type>(check: Check<Type>, length?: number): Check<Type[]> => (value, key) => {
  if (!Array.isArray(value) || (length !== undefined && value.length !== length)) return wrong(key);
  value.forEach((item, i) => check(item, `${key}[${i}]`));
};
export function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
/// Keys whose values may lack are optional.
type Shape<Keys> = { [Key in keyof Keys as undefined extends Passed<Keys[Key]> ? never : Key]: Passed<Keys[Key]> } &
  { [Key in keyof Keys as undefined extends Passed<Keys[Key]> ? Key : never]?: Passed<Keys[Key]> };
export const object = <Keys extends Record<string, Check>>(keys: Keys): Check<Shape<Keys>> => (value, key) => {
  if (!isObject(value)) return wrong(key);
  for (const [name, check] of Object.entries(keys)) check(value[name], key ? `${key}.${name}` : name);
};
export const each = <Type>(check: Check<Type>): Check<Record<string, Type>> => (value, key) => {
  if (!isObject(value)) return wrong(key);
  for (const [name, item] of Object.entries(value)) check(item, `${key}.${name}`);
};
export const three = list(number, 3) as Check<[number, number, number]>;
