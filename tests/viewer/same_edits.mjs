// Holds strokes, a moved centre and ligaments of the core compiled to WebAssembly against the same functions compiled natively, bit for bit, as same_bits.mjs
// does with all else:
//   node same_edits.mjs page_core.js FOLDER
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { bits, fromBits, readScene } from "./answers.mjs";
import { openCore } from "./core_module.mjs";

const [modulePath, folder] = process.argv.slice(2);
const { core, copied, checked, f64, u32, jointOf } = await openCore(modulePath);
const scene = readScene(join(folder, "scene.bin"));
const joint = jointOf(scene);
const vertexCount = [scene.mobile.length / 3, scene.fixed.length / 3];
const three = core._malloc(24), other = core._malloc(24), limit = core._malloc(64), outcome = core._malloc(12), removed = core._malloc(32), pose = core._malloc(128);
const put = (pointer, numbers) => f64(pointer, numbers.length).set(numbers);

/// FNV-1a of 32 bits.
function digestOf(pointer, count) {
  let hash = 2166136261;
  for (const byte of core.HEAPU8.subarray(pointer, pointer + 8 * count)) hash = Math.imul(hash ^ byte, 16777619) >>> 0;
  return hash;
}

function brushed(ofFixed) {
  checked(core._condyle_removed(joint, ofFixed, removed));
  const n = vertexCount[ofFixed], vertices = core._malloc(24 * n), depths = core._malloc(8 * n);
  checked(core._condyle_brushed(joint, ofFixed, vertices, depths));
  const said = [...Array.from(f64(removed, 4), bits), digestOf(vertices, 3 * n), digestOf(depths, n)].join(" ");
  [vertices, depths].forEach((pointer) => core._free(pointer));
  return said;
}

const answerers = {
  brush: ([ofFixed]) => `${checked(core._condyle_brush(joint, Number(ofFixed), 0))}`,
  stroke([ofFixed, action, radius, depth, ...along]) {
    const path = copied(new Uint32Array(along.map(Number)));
    checked(core._condyle_stroke(joint, Number(ofFixed), Number(action), path, along.length, fromBits(radius), fromBits(depth), outcome));
    core._free(path);
    return [...u32(outcome, 3), brushed(Number(ofFixed))].join(" ");
  },
  undo: ([ofFixed]) => `${checked(core._condyle_undo_stroke(joint, Number(ofFixed)))} ${brushed(Number(ofFixed))}`,
  centre(offset) {
    put(three, offset.map(fromBits));
    put(other, [0, 0, 0]);
    return `${checked(core._condyle_move_centre(joint, three, other))}`;
  },
  about([vary, positive, ...numbers]) {
    put(three, numbers.slice(0, 3).map(fromBits));
    checked(core._condyle_limit_about(joint, Number(vary), Number(positive), three, fromBits(numbers[3]), limit));
    return Array.from(f64(limit, 8), bits).join(" ");
  },
  strings: () => `${checked(core._condyle_set_ligaments(joint, copied(Buffer.concat([readFileSync(join(folder, "ligaments.toml")), Buffer.alloc(1)]))))}`,
  shown([flexion]) {
    put(three, [Number(flexion), 5, -10]);
    put(other, [0, 0, 0]);
    checked(core._condyle_pose(joint, three, other, pose));
    return core.UTF8ToString(core._condyle_ligaments(joint, pose));
  },
  // Without "=": its answer follows its six words.
  limit([vary, positive, ...numbers]) {
    put(three, numbers.slice(0, 3).map(fromBits));
    put(other, [0, 0, 0]);
    checked(core._condyle_limit(joint, Number(vary), Number(positive), three, other, fromBits(numbers[3]), limit));
    return Array.from(f64(limit, 8), bits).join(" ");
  },
};

const wrong = [], counts = {};
for (const line of readFileSync(join(folder, "edits.txt"), "utf8").trimEnd().split("\n")) {
  const words = line.split(" "), at = words[0] === "limit" ? 7 : words.indexOf("=");
  const native = words.slice(words[0] === "limit" ? at : at + 1).join(" ");
  // A point that there is not is any NaN.
  const page = answerers[words[0]](words.slice(1, at));
  counts[words[0]] = (counts[words[0]] ?? 0) + 1;
  const plain = (text) => text.replaceAll(/\b[7f]ff80{12}\b/g, "none");
  if (plain(page) !== plain(native)) wrong.push(`${words.slice(0, at).join(" ").slice(0, 120)}: ${page} and not ${native}`);
}
console.log(`${Object.entries(counts).map(([kind, count]) => `${kind} ${count}`).join(", ")}: ${wrong.length} wrong`);
for (const text of wrong.slice(0, 5)) console.error(text);
const complete = counts.brush === 2 && counts.stroke === 6 && counts.undo === 2 && counts.centre === 2 && counts.about === 24 && counts.limit === 60 && counts.strings === 1 && counts.shown === 8;
process.exit(wrong.length || !complete ? 1 : 0);
