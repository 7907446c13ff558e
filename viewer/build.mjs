// Makes the page's template of what is in src/ and of the core compiled to WebAssembly: one file, the same bytes from the same
// sources wherever it is made.
//   node build.mjs FOLDER_OF_PAGE_CORE TEMPLATE
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build, transform } from "esbuild";
import { gzipSync } from "fflate";

const here = dirname(fileURLToPath(import.meta.url));
const [coreFolder, template] = process.argv.slice(2).map((path) => resolve(path));
const source = (path) => readFileSync(join(here, path), "utf8");

async function bundled(entry, define = {}) {
  const { outputFiles } = await build({
    entryPoints: [join(here, "src", entry)],
    bundle: true, minify: true, write: false, format: "iife", target: "es2022", charset: "ascii", legalComments: "none", define,
    alias: { "page-core": join(coreFolder, "page_core.js") },
    // Of emscripten's glue, for node.
    external: ["fs", "path", "crypto"],
    absWorkingDir: here,
  });
  return outputFiles[0].text;
}

// What would end the element that holds a script.
const inScript = (text) => text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const hashOf = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const worker = await bundled("core/worker.ts");
const script = inScript(await bundled("main.ts", { workerSource: JSON.stringify(worker) }));
const style = (await transform(source("src/page.css"), { loader: "css", minify: true })).code;
// The level and the date are said, so that the bytes are those of every machine.
const core = Buffer.from(gzipSync(readFileSync(join(coreFolder, "page_core.wasm")), { level: 9, mtime: 0 })).toString("base64");
const policy = `default-src 'none'; script-src ${hashOf(script)} 'wasm-unsafe-eval'; style-src ${hashOf(style)}; worker-src blob:; ` +
  "img-src data: blob:; base-uri 'none'; form-action 'none'";

const packages = ["three", "d3-array", "d3-color", "d3-format", "d3-interpolate", "d3-path", "d3-scale", "d3-scale-chromatic", "d3-shape",
  "d3-time", "d3-time-format", "fflate", "internmap"];
const licences = [
  source("../NOTICE").trim(),
  source("licences.txt").trim(),
  ...packages.map((name) => {
    const { version } = JSON.parse(source(`node_modules/${name}/package.json`));
    return `${name} ${version}\n\n${source(`node_modules/${name}/LICENSE`).trim()}`;
  }),
].join("\n\n--------\n\n").replaceAll("<", "‹").replaceAll(">", "›");

// What is shown where the script does not run.
const { outputFiles: [table] } = await build({ entryPoints: [join(here, "src/words.ts")], write: false, format: "esm" });
const { words } = await import(`data:text/javascript;base64,${Buffer.from(table.contents).toString("base64")}`);

const parts = { policy, style, licences, core, script, noScripts: words.noScripts, unfinished: words.unfinished };
const page = source("src/page.html").replaceAll(/@(\w+)@/g, (_, part) => parts[part]);
writeFileSync(template, page);
console.log(`${template}: ${(page.length / 1e6).toFixed(2)} MB, of it script ${(script.length / 1e6).toFixed(2)}, core ${(core.length / 1e6).toFixed(2)}`);
