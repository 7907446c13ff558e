// Makes the page's template of what is in src/, and beside it the core compiled to WebAssembly, which goes where the template has @core@: the same
// bytes from the same sources wherever they are made. Two files, so that the history keeps the core once for all changes of the page.
//   node build.mjs FOLDER_OF_PAGE_CORE FOLDER
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipAsync } from "@gfx/zopfli";
import { build, transform } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const [coreFolder, folder] = process.argv.slice(2).map((path) => resolve(path));
const source = (path) => readFileSync(join(here, path), "utf8");

/// Names of packages that the bundles were made of.
const taken = new Set();

async function bundled(entry, define = {}) {
  const { outputFiles, metafile } = await build({
    entryPoints: [join(here, "src", entry)],
    bundle: true, metafile: true, minify: true, write: false, format: "iife", target: "es2022", charset: "ascii", legalComments: "none", define,
    alias: { "page-core": join(coreFolder, "page_core.js") },
    // Imports of emscripten's glue, for node.
    external: ["fs", "path", "crypto"],
    absWorkingDir: here,
  });
  for (const path of Object.keys(metafile.inputs)) {
    const name = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1];
    if (name) taken.add(name);
  }
  return outputFiles[0].text;
}

const hashOf = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const worker = await bundled("core/worker.ts");
const script = await bundled("main.ts", { workerSource: JSON.stringify(worker) });
const loader = (await transform(source("src/loader.js"), { loader: "js", minify: true, target: "es2022" })).code.trim();
const style = (await transform(source("src/page.css") + source("src/scene/scene.css"), { loader: "css", minify: true })).code;
// A twelfth smaller than by zlib's own search, for some ten seconds; zopfli is WebAssembly too, so that its bytes are those of every machine.
const packed = async (bytes) => Buffer.from(await gzipAsync(bytes, { numiterations: 5 })).toString("base64");
const core = await packed(readFileSync(join(coreFolder, "page_core.wasm")));
const policy = `default-src 'none'; script-src ${hashOf(loader)} ${hashOf(script)} 'wasm-unsafe-eval'; style-src ${hashOf(style)}; worker-src blob:; ` +
  "img-src data: blob:; base-uri 'none'; form-action 'none'";

const manifest = (name) => JSON.parse(source(`node_modules/${name}/package.json`));
// With what they need, as the list of materials has it. A set is gone through to the names that are added meanwhile.
for (const name of taken) for (const needed of Object.keys(manifest(name).dependencies ?? {})) taken.add(needed);
// Name, version and licence of each; texts in full behind them, compressed as the core is.
const packages = [...taken].sort().map((name) => {
  const { version, license } = manifest(name);
  return { title: `${name} ${version}: ${license}`, text: source(`node_modules/${name}/LICENSE`).trim() };
});
const licenceList = [source("../NOTICE").trim(), packages.map(({ title }) => title).join("\n")].join("\n\n");
const texts = [
  source("licences/core.txt"), ...packages.map(({ title, text }) => `${title}\n\n${text}`), source("licences/zlib.txt"), source("../LICENSE"), source("licences/MPL-2.0.txt"),
].map((text) => text.trim()).join("\n\n--------\n\n");

// Texts for a page whose script does not run.
const { outputFiles: [table] } = await build({ entryPoints: [join(here, "src/words.ts")], write: false, format: "esm" });
const { words } = await import(`data:text/javascript;base64,${Buffer.from(table.contents).toString("base64")}`);

const parts = { policy, style, licenceList, licences: await packed(Buffer.from(texts)), core: "@core@", script: await packed(Buffer.from(script)), loader, noScripts: words.noScripts, unfinished: words.unfinished };
const page = source("src/page.html").replaceAll(/@(\w+)@/g, (_, part) => parts[part]);
writeFileSync(join(folder, "report_template.html"), page);
writeFileSync(join(folder, "page_core.base64"), core);
writeFileSync(join(folder, "page_core.js"), (await transform(readFileSync(join(coreFolder, "page_core.js"), "utf8"), { minify: true, target: "es2022" })).code);
console.log(`${folder}: template ${(page.length / 1e6).toFixed(2)} MB, of it script ${(parts.script.length / 1e6).toFixed(2)}, and core ${(core.length / 1e6).toFixed(2)} MB`);
