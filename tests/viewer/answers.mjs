// Scenes and answers of page_core_answers, as files.
import { readFileSync, writeFileSync } from "node:fs";

/// Copies a typed array's bytes from an offset that is a multiple of its elements.
function reader(path) {
  const file = readFileSync(path);
  const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
  let at = 0;
  return (Type, count) => new Type(bytes, (at += Type.BYTES_PER_ELEMENT * count) - Type.BYTES_PER_ELEMENT * count, count);
}

export function readScene(path) {
  const take = reader(path);
  const [nFixed, nMobile, nQuestions, , nFixedTriangles, nMobileTriangles] = take(Uint32Array, 6);
  return {
    fixed: take(Float64Array, nFixed), mobile: take(Float64Array, nMobile), questions: take(Float64Array, nQuestions),
    fixedTriangles: take(Uint32Array, nFixedTriangles), mobileTriangles: take(Uint32Array, nMobileTriangles),
  };
}

export function writeScene(path, { fixed, mobile, questions, fixedTriangles, mobileTriangles }) {
  const head = Uint32Array.of(fixed.length, mobile.length, questions.length, 0, fixedTriangles.length, mobileTriangles.length);
  writeFileSync(path, Buffer.concat([head, fixed, mobile, questions, fixedTriangles, mobileTriangles].map(
    ({ buffer, byteOffset, byteLength }) => Buffer.from(buffer, byteOffset, byteLength))));
}

/// A double as 16 hexadecimal digits, and back. Self-contained: it is run in the page too.
export function bits(value) {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  return view.getBigUint64(0).toString(16).padStart(16, "0");
}

export function fromBits(text) {
  const view = new DataView(new ArrayBuffer(8));
  view.setBigUint64(0, BigInt("0x" + text));
  return view.getFloat64(0);
}

/// Lines as lists of words.
export function readAnswers(path) {
  return readFileSync(path, "utf8").trimEnd().split("\n").map((line) => line.split(" "));
}
