// Label maps of the sample hip in every form that the page reads, from the one that condyle sample writes.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync, gunzipSync, gzipSync } from "node:zlib";

/// NIfTI-1 of unsigned bytes, as the command writes it: its size, the rows of its sform (RAS) and its voxels.
function readNifti(path) {
  const bytes = gunzipSync(readFileSync(path));
  return {
    bytes, size: [42, 44, 46].map((at) => bytes.readInt16LE(at)),
    rows: [280, 296, 312].map((at) => [0, 4, 8, 12].map((i) => bytes.readFloatLE(at + i))), voxels: bytes.subarray(352),
  };
}

/// Label maps with voxels of `mm`, in `folder`: the paths of the files, each of the same labels in the same place.
export function makeLabelMaps(condyle, folder, mm) {
  mkdirSync(folder, { recursive: true });
  execFileSync(condyle, ["sample", "hip", "--voxel", String(mm), "--out", folder], { stdio: "ignore" });
  const nifti = join(folder, "labels.nii.gz"), { bytes, size, rows, voxels } = readNifti(nifti);
  const column = (j) => rows.map((row, i) => (i < 2 ? -row[j] : row[j]));
  const write = (name, ...parts) => {
    writeFileSync(join(folder, name), Buffer.concat(parts.map((part) => Buffer.from(part))));
    return join(folder, name);
  };
  const vector = (numbers) => `(${numbers.join(",")})`;
  const nrrd = (encoding, more = "", sizes = size, turned = (v) => v) => `NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n` +
    `sizes: ${sizes.join(" ")}\nspace directions: ${[0, 1, 2].map((j) => vector(turned(column(j)))).join(" ")}\nkinds: domain domain domain\n` +
    `encoding: ${encoding}\nspace origin: ${vector(turned(column(3)))}\n${more}\n`;
  // Turned by six degrees about two axes, without its lowest slices, which cuts the femur.
  const c = Math.cos(0.1), s = Math.sin(0.1), left_out = 20;
  const turned = ([x, y, z]) => [c * x - s * (s * y + c * z), c * y - s * z, s * x + c * (s * y + c * z)];
  const names = [["hip_right", 78], ["femur_right", 76]].map(([name, label], i) =>
    `Segment${i}_Name:=${name}\nSegment${i}_ID:=S${i}\nSegment${i}_LabelValue:=${label}\nSegment${i}_Layer:=0\n`).join("");
  const packed = deflateSync(voxels), spacing = [0, 1, 2].map((j) => Math.hypot(...column(j)));
  const mha = `ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = True\n` +
    `CompressedDataSize = ${packed.length}\nTransformMatrix = ${[0, 1, 2].flatMap((j) => column(j).map((x) => x / spacing[j])).join(" ")}\n` +
    `Offset = ${column(3).join(" ")}\nElementSpacing = ${spacing.join(" ")}\nDimSize = ${size.join(" ")}\nElementType = MET_UCHAR\n` +
    "ElementDataFile = LOCAL\n";
  const mask = (name, label) => write(name, gzipSync(Buffer.concat([bytes.subarray(0, 352), Buffer.from(voxels.map((v) => (v === label ? 1 : 0)))])));
  // In two members, as programs write it that compress in parallel.
  const half = voxels.length >> 1;
  return {
    nifti, raw: write("labels.nii", bytes), nrrd: write("labels.nrrd", nrrd("raw"), voxels),
    named: write("named.seg.nrrd", nrrd("gzip", names), gzipSync(voxels.subarray(0, half)), gzipSync(voxels.subarray(half))),
    oblique: write("oblique.nrrd", nrrd("raw", "", [size[0], size[1], size[2] - left_out], turned), voxels.subarray(left_out * size[0] * size[1])),
    metaimage: write("labels.mha", mha, packed), hipMask: mask("hip_right.nii.gz", 78), femurMask: mask("femur_right.nii.gz", 76),
  };
}
