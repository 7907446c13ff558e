import { unzlibSync } from "fflate";

/// The sum that ends a zlib stream (RFC 1950), most significant byte first: fflate does not look at it.
function adler32(bytes: Uint8Array): number {
  let a = 1, b = 0;
  for (let i = 0; i < bytes.length;) {
    // As many as the sums hold before they are reduced.
    for (const end = Math.min(i + 3800, bytes.length); i < end; ++i) b += a += bytes[i]!;
    a %= 65521;
    b %= 65521;
  }
  return ((b << 16) | a) >>> 0;
}

/// Undoes a zlib stream that has to fill `to`; false where it does not, or where its sum is not that of what came out.
export function unzip(from: Uint8Array, to: Uint8Array): boolean {
  if (from.length < 6) return false;
  try {
    // A byte more than it may give: fflate stops where its place is full.
    const out = unzlibSync(from, { out: new Uint8Array(to.length + 1) });
    const sum = new DataView(from.buffer, from.byteOffset + from.length - 4).getUint32(0);
    if (out.length !== to.length || adler32(out) !== sum) return false;
    to.set(out);
    return true;
  } catch {
    return false;
  }
}
