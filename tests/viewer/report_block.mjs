// The data block of a report: docs/report-data.md.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync, inflateSync } from "node:zlib";
import { pathOf, reports } from "./browser.mjs";

const dataElement = /(<script type="application\/octet-stream" id="condyle-data">)([^<]*)(<\/script>)/;
const types = { f64: Float64Array, u32: Uint32Array, i16: Int16Array, u8: Uint8Array };

/// The JSON of a report, and its arrays by name.
export function readReport(path) {
  return readBlock(inflateSync(Buffer.from(dataElement.exec(readFileSync(path, "utf8"))[2], "base64")));
}

/// The same of a block that is not compressed.
export function readBlock(block) {
  const end = 16 + block.readUInt32LE(12);
  const text = JSON.parse(block.subarray(16, end));
  const array = (name) => {
    const { type, offset, length } = text.arrays[name];
    const Type = types[type];
    return new Type(Uint8Array.from(block.subarray(end + offset, end + offset + length * Type.BYTES_PER_ELEMENT)).buffer);
  };
  return { text, array };
}

/// A report whose data block was changed.
export function changed(name, change, from = "sample") {
  const path = join(reports, `${name}.html`);
  writeFileSync(path, readFileSync(pathOf(from), "utf8").replace(dataElement, (_, before, data, end) =>
    before + change(Buffer.from(data, "base64")).toString("base64") + end));
  return path;
}

/// The same with other text in it; arrays follow the text at a multiple of 8.
export function withText(name, change, from = "sample") {
  return changed(name, (zipped) => {
    const block = inflateSync(zipped);
    const end = 16 + block.readUInt32LE(12);
    const said = JSON.parse(block.subarray(16, end));
    change(said);
    let text = Buffer.from(JSON.stringify(said));
    text = Buffer.concat([text, Buffer.alloc((8 - (text.length % 8)) % 8, " ")]);
    const head = Buffer.from(block.subarray(0, 16));
    head.writeUInt32LE(text.length, 12);
    return deflateSync(Buffer.concat([head, text, block.subarray(end)]));
  }, from);
}
