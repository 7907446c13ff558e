// The module of the npm package in a browser, bundled and as it is, with files that a user chooses: node browser.mjs FOLDER_OF_INSTALLATION JOINT.toml
// Prints the list that npm/examples/browser.mjs makes, once for each way.
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, dirname, extname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../.."), [installed, jointFile] = process.argv.slice(2).map((path) => resolve(path));
const require = createRequire(join(root, "viewer/package.json"));
const { chromium } = require("playwright-core"), { build } = require("esbuild");
const example = readFileSync(join(root, "npm/examples/browser.mjs"), "utf8");
const inFolder = join(installed, "node_modules/condyle");

const { outputFiles } = await build({
  stdin: { contents: example, resolveDir: installed }, bundle: true, write: false, format: "esm", platform: "browser", target: "es2022",
});
const page = (map) => `<!doctype html>${map}<input type="file" multiple><ul></ul><script type="module">
  import { showLimits } from "./example.mjs";
  document.querySelector("input").onchange = ({ target }) => showLimits(target.files, document.querySelector("ul"))
    .catch((error) => { document.querySelector("ul").textContent = "failed: " + error.message; });
  document.documentElement.dataset.ready = "";
</script>`;
const types = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript" };
const ways = {
  "bundled/": { "index.html": page(""), "example.mjs": outputFiles[0].text, "report_template.html": join(inFolder, "report_template.html") },
  "as_it_is/": {
    "index.html": page('<script type="importmap">{"imports": {"condyle": "./condyle/index.js"}}</script>'), "example.mjs": example,
    ...Object.fromEntries(readdirSync(inFolder).map((name) => [`condyle/${name}`, join(inFolder, name)])),
  },
};

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const context = await browser.newContext();
await context.route("**/*", (route) => {
  const { pathname, host } = new URL(route.request().url());
  const way = Object.keys(ways).find((prefix) => pathname.startsWith(`/${prefix}`));
  const name = pathname.slice(1 + (way ?? "").length) || "index.html", found = host === "condyle.test" ? ways[way]?.[name] : undefined;
  if (found === undefined) return route.fulfill({ status: 404, body: "" });
  return route.fulfill({ contentType: types[extname(name)] ?? "application/octet-stream", body: found.startsWith(inFolder) ? readFileSync(found) : found });
});
for (const way of Object.keys(ways)) {
  const opened = await context.newPage();
  const complaints = [];
  opened.on("pageerror", (error) => complaints.push(error.message));
  await opened.goto(`http://condyle.test/${way}`);
  await opened.waitForFunction(() => "ready" in document.documentElement.dataset, null, { timeout: 20000 }).catch(() => { throw new Error(complaints.join("; ")); });
  const folder = dirname(jointFile);
  await opened.setInputFiles("input", [jointFile, ...readdirSync(folder).filter((name) => name !== basename(jointFile)).map((name) => join(folder, name))]);
  await opened.waitForFunction(() => document.querySelector("ul").textContent !== "", null, { timeout: 60000 });
  console.log((await opened.locator("li").allTextContents()).join("\n") || (await opened.locator("ul").textContent()));
}
await browser.close();
