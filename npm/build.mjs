// Makes the folder of the npm package of what `emcmake cmake -S npm` has built: node build.mjs FOLDER_OF_BUILD FOLDER VERSION
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url)), root = dirname(here);
const [built, folder, version] = [resolve(process.argv[2]), resolve(process.argv[3]), process.argv[4]];
const { build } = createRequire(join(root, "viewer/package.json"))("esbuild");
mkdirSync(folder, { recursive: true });

await build({
  entryPoints: [join(here, "package/command.js"), join(here, "package/worker.js")],
  bundle: true, minify: true, outdir: folder, format: "esm", platform: "node", target: "node18", charset: "ascii", legalComments: "none",
  alias: { "condyle-wasm": join(built, "condyle.js"), pako: join(root, "viewer/node_modules/pako/dist/pako.mjs") },
  // The module of emscripten asks for node's own by require.
  banner: { js: 'import { createRequire as requireOf } from "node:module"; import { dirname as folderOf } from "node:path"; import { fileURLToPath as pathOf } from "node:url"; const require = requireOf(import.meta.url), __filename = pathOf(import.meta.url), __dirname = folderOf(__filename);' },
});
const command = join(folder, "command.js");
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
