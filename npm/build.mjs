// Makes the folder of the npm package of what `emcmake cmake -S npm` has built, and of the page's core:
//   node build.mjs FOLDER_OF_BUILD FOLDER_OF_PAGE_CORE FOLDER VERSION
import { copyFileSync, cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url)), root = dirname(here);
const [built, pageCore, folder] = process.argv.slice(2, 5).map((path) => resolve(path)), version = process.argv[5];
const { build } = createRequire(join(root, "viewer/package.json"))("esbuild");
const pako = join(root, "viewer/node_modules/pako/dist/pako.mjs");
mkdirSync(folder, { recursive: true });

await build({
  entryPoints: [join(here, "package/command.js"), join(here, "package/worker.js")],
  bundle: true, minify: true, outdir: folder, format: "cjs", outExtension: { ".js": ".cjs" }, platform: "node", target: "node18", charset: "ascii", legalComments: "none",
  alias: { "condyle-wasm": join(built, "condyle.js"), pako }, inject: [join(here, "package/random.js")],
});
// The module, for browsers too. What emscripten's glue asks of node is there in node only.
await build({
  entryPoints: [join(here, "package/index.ts")],
  bundle: true, minify: true, outdir: folder, format: "esm", platform: "neutral", target: "es2022", charset: "ascii", legalComments: "none",
  alias: { "page-core": join(pageCore, "page_core.js"), pako }, external: ["fs", "path", "crypto"], define: { __dirname: '""' },
  banner: { js: 'const require = globalThis.process?.versions?.node ? (await import(/* @vite-ignore */ /* webpackIgnore: true */ ["node", "module"].join(":"))).createRequire(import.meta.url) : undefined;' },
});
cpSync(join(built, "types"), join(folder, "types"), { recursive: true });
copyFileSync(join(root, "viewer/src/core/wasm.d.ts"), join(folder, "types/viewer/src/core/wasm.d.ts"));
const command = join(folder, "command.cjs");
const text = readFileSync(command, "utf8");
if (!text.startsWith("#!")) throw new Error("the command has no first line for the shell");
copyFileSync(join(built, "condyle.wasm"), join(folder, "condyle.wasm"));
const page = readFileSync(join(root, "viewer/report_template.html"), "utf8"), core = readFileSync(join(root, "viewer/page_core.base64"), "utf8");
writeFileSync(join(folder, "report_template.html"), page.replaceAll("@core@", core));
copyFileSync(join(root, "LICENSE"), join(folder, "LICENSE"));
// The page's list of what its core holds, which all of it is here too; and what is here alone.
const licences = ["viewer/licences/core.txt", "viewer/node_modules/pako/LICENSE", "viewer/licences/zlib.txt", "/usr/share/doc/libcli11-dev/copyright", "viewer/licences/MPL-2.0.txt"];
writeFileSync(join(folder, "LICENCES.txt"), licences.map((path) => readFileSync(resolve(root, path), "utf8").trim()).join("\n\n--------\n\n"));
copyFileSync(join(here, "README.md"), join(folder, "README.md"));
writeFileSync(join(folder, "package.json"), JSON.stringify({ version, ...JSON.parse(readFileSync(join(here, "package.json"), "utf8")) }, null, 2));
