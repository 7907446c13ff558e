// The data block of a report: docs/report.md.
import { readFileSync } from "node:fs";
import { inflateSync } from "node:zlib";

export const dataElement = /(<script type="application\/octet-stream" id="condyle-data">)([^<]*)(<\/script>)/;
const types = { f64: Float64Array, u32: Uint32Array, i16: Int16Array, u8: Uint8Array };

/// The JSON of a report, and its arrays by name.
export function readReport(path) {
  const block = inflateSync(Buffer.from(dataElement.exec(readFileSync(path, "utf8"))[2], "base64"));
  const end = 16 + block.readUInt32LE(12);
  const text = JSON.parse(block.subarray(16, end));
  const array = (name) => {
    const { type, offset, length } = text.arrays[name];
    const Type = types[type];
    return new Type(Uint8Array.from(block.subarray(end + offset, end + offset + length * Type.BYTES_PER_ELEMENT)).buffer);
  };
  return { text, array };
}
