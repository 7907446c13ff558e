// Holds the crates of `condyle rom`, `study`, `merge` and `hip` against RO-Crate by the npm package ro-crate, and against what a Process Run Crate
// must have (https://w3id.org/ro/wfrun/process/0.5): node check.mjs CONDYLE. Ends with 77 if the package is not there (make ro-crate).
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const require = createRequire(import.meta.url);
let context;
try {
  context = require("ro-crate/lib/context.json");
} catch {
  console.log("no npm package ro-crate: crates not held against it (make ro-crate)");
  process.exit(77);
}
// The package asks the network for contexts: here it gets its own, and of the profile's what this test knows of it.
const contexts = {
  "https://w3id.org/ro/crate/1.1/context": context,
  "https://w3id.org/ro/terms/workflow-run/context": { "@context": { sha256: "https://w3id.org/ro/terms/workflow-run#sha256" } },
};
globalThis.fetch = async (url) => ({ ok: url in contexts, json: async () => contexts[url] });
const { ROCrate } = require("ro-crate");
const { validate } = require("ro-crate/lib/validator.js");

const asList = (value) => [value ?? []].flat();

async function check(folder) {
  const text = readFileSync(join(folder, "ro-crate-metadata.json"), "utf8");
  const crate = new ROCrate(JSON.parse(text), { array: true, link: true });
  await crate.resolveContext();
  const there = readdirSync(folder, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name).slice(folder.length + 1)).filter((name) => !name.startsWith("shards/"));
  const files = Object.fromEntries(there.map((name) => [name, { exists: true, inCrate: false, isDir: false }]));
  const wrong = (await validate(crate, files)).filter(({ status }) => status !== "success");
  assert.deepEqual(wrong, [], folder);

  const graph = JSON.parse(text)["@graph"], entity = Object.fromEntries(graph.map((each) => [each["@id"], each]));
  assert.equal(graph.length, Object.keys(entity).length, "each entity once");
  for (const each of graph)
    for (const [key, value] of Object.entries(each)) {
      assert.ok(key.startsWith("@") || crate.resolveTerm(key), `${key} is a term of the contexts`);
      for (const { "@id": id } of asList(value).filter((one) => one?.["@id"]))
        assert.ok(id in entity || id === "https://w3id.org/ro/crate/1.1", `${id}, which ${each["@id"]} names, is an entity`);
    }
  const root = entity["./"], [run, ...others] = graph.filter((each) => each["@type"] === "CreateAction");
  assert.deepEqual(others, []);
  assert.ok(asList(root.conformsTo).some((each) => each["@id"] === "https://w3id.org/ro/wfrun/process/0.5"));
  assert.ok(asList(root.mentions).some((each) => each["@id"] === run["@id"]));
  assert.equal(entity[run.instrument["@id"]]["@type"], "SoftwareApplication");
  assert.match(execFileSync(condyle, ["--version"], { encoding: "utf8" }), new RegExp(entity[run.instrument["@id"]].softwareVersion));
  assert.ok(run.result.length > 0 && run.object.length > 0);
  for (const { "@id": id } of run.result)
    assert.equal(entity[id].sha256, createHash("sha256").update(readFileSync(join(folder, decodeURIComponent(id)))).digest("hex"), id);
  console.log(`${folder.slice(place.length + 1)}: ${run.object.length} files read, ${run.result.length} written, no fault`);
}

const condyle = process.argv[2], place = mkdtempSync(join(tmpdir(), "condyle-crate-"));
const run = (line) => execFileSync(condyle, line.split(" "), { cwd: place, stdio: ["ignore", "ignore", "pipe"] });
try {
  run("sample hip --scenario 1 --out bones");
  run("sample cohort --n 2 --seed 1 --out cohort");
  run("rom bones/hip.toml --motion flexion --past 5 --crate 2026-01-31 --out range");
  run("hip bones/hip_bone.ply bones/femur.ply --samples 0 --crate 2026-01-31 --out patient");
  run("study cohort/cohort.csv --motion flexion --crate 2026-01-31 --out study");
  for (const shard of ["1/2", "2/2"]) run(`study cohort/cohort.csv --motion flexion --out parted --shard ${shard}`);
  run("merge parted --crate 2026-01-31");
  for (const folder of ["range", "patient", "study", "parted"]) await check(join(place, folder));
} finally {
  rmSync(place, { recursive: true });
}
