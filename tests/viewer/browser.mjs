// Common to tests of the page: a real browser without a network, and a report opened in it from disk.
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { after } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const reports = join(root, "build/page");
export const require = createRequire(join(root, "viewer/package.json"));  // packages of the page
const { chromium } = require("playwright-core");
export const axeSource = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

// Software draws here, and draws less: the page is put together without WebGL, and scenes are not smoothed at their edges. Pictures in
// build/page/seen are rougher than what a user sees.
const quiet = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing",
  "--webgl-antialiasing-mode=none"];

export function launchedBrowser() {
  return chromium.launch({ executablePath: "/usr/bin/chromium", args: quiet });
}

/// One browser for all tests of a file, closed after them.
export async function sharedBrowser() {
  const browser = await launchedBrowser();
  after(() => browser.close());
  return browser;
}

export function pathOf(name) {
  return join(reports, `${name}.html`);
}

export function has(name) {
  return existsSync(pathOf(name));
}

/// A page with what it asked of the outside and complained of. `seen` are the requests beyond the file and the worker in it.
export async function openPage(browser, path, { width = 1280, height = 800, fragment = "", script = null, answers = true, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, offline: true, ...options });
  const page = await context.newPage();
  const complaints = [], requests = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall|WebGL|GroupMarker/.test(message.text())) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => {
    if (!request.url().startsWith("blob:") && request.url().split("#")[0] !== pathToFileURL(path).href) requests.push(request.url());
  });
  if (script) await page.addInitScript(script);
  const begun = performance.now();
  await page.goto(pathToFileURL(path).href + fragment);
  if (answers) await page.waitForFunction(() => Number(document.documentElement.dataset.answered) > 0);
  return { page, complaints, requests, firstAnswer_ms: performance.now() - begun };
}

/// Waits until what was asked of the core is answered and drawn. A joint that takes the place of another brings a core of its own, and
/// what was asked of the one before may have no answer.
export async function settled(page) {
  await page.waitForFunction(() => globalThis.condyle !== undefined);
  await page.evaluate(async () => {
    for (let asked; asked !== globalThis.condyle;) {
      asked = globalThis.condyle;
      let isAnswered = false;
      const replaced = async () => {
        while (!isAnswered && asked === globalThis.condyle) await new Promise((later) => setTimeout(later, 50));
      };
      await Promise.race([asked.query({ of: "pose", at: { angles: [0, 0, 0], translation: [0, 0, 0] } }), replaced()]);
      isAnswered = true;
    }
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
  });
}

/// Waits until the page has its panels: its script is unpacked after it is loaded.
export async function panelsPlaced(page) {
  await page.locator("#side > *").first().waitFor({ state: "attached" });
}

/// Drops files by their paths on the page, as a hand does.
export async function drop(page, files) {
  await panelsPlaced(page);
  const client = await page.context().newCDPSession(page);
  for (const type of ["dragEnter", "dragOver", "drop"])
    await client.send("Input.dispatchDragEvent", { type, x: 300, y: 300, data: { items: [], files, dragOperationsMask: 1 } });
}

/// Types a number into a field, and finishes it.
export async function type(field, value) {
  await field.fill(String(value));
  await field.press("Enter");
}

/// Turns the joint as typing into the fields does.
export async function turnTo(page, angles) {
  for (const [name, degrees] of Object.entries(angles))
    await type(page.getByRole("spinbutton", { name: `${name.replaceAll("_", " ")}, degrees`, exact: true }), degrees);
  await settled(page);
}

/// Red, green, blue and opacity of the scene's pixels, row by row from the top.
export async function pixels(page) {
  // As text: millions of numbers one by one take a browser's protocol minutes.
  const { width, height, text } = await page.evaluate(() => {
    const canvas = document.querySelector("#scene > canvas");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let characters = "";
    for (let i = 0; i < data.length; i += 32768) characters += String.fromCharCode(...data.subarray(i, i + 32768));
    return { width: copy.width, height: copy.height, text: btoa(characters) };
  });
  const data = Buffer.from(text, "base64");
  return { width, height, at: (x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 4)] };
}

/// Pixels that identify a colour: how many, and their middle in shares of the picture.
export function region({ width, height, at }, is) {
  let count = 0, x = 0, y = 0;
  // The gizmo is in the corner.
  for (let row = 0; row < height; ++row)
    for (let column = 0; column < width; ++column) {
      if (column > width - 150 && row > height - 150) continue;
      const [r, g, b, a] = at(column, row);
      if (a < 250 || !is(r, g, b)) continue;
      ++count, x += column, y += row;
    }
  return { count, x: x / count / width, y: y / count / height };
}

export async function keep(page, name, options = {}) {
  mkdirSync(join(reports, "seen"), { recursive: true });
  await page.screenshot({ path: join(reports, "seen", `${name}.png`), ...options });
}

// The hip bone is the colour of sand, the femur bluish; shading changes how bright they are.
export const isHipBone = (r, g, b) => r > b + 12 && r >= g;
export const isFemur = (r, g, b) => b > r + 8;

/// Opens the drawer of what the scene shows, or closes it.
export async function viewOptions(page, open = true) {
  const drawer = page.locator("#view-options");
  if ((await drawer.evaluate((element) => element.open)) !== open) await drawer.locator("summary").click();
}

export async function openTab(page, name) {
  await page.getByRole("tab", { name, exact: true }).click();
}

/// Opens one of the figures: "Map", "Clock" or "Curves".
export async function openFigure(page, name) {
  await openTab(page, "Figures");
  if (await page.locator(".segments").isVisible()) await page.locator(".segments label", { hasText: name }).click();
}

/// A motion as people call it.
export function asSaid(name) {
  return name.replace(/^(fadir|faber)$/, (short) => short.toUpperCase()).replaceAll("_", " ").replace(/ at (\d+) /, " at $1° ");
}

/// The tile of a motion, by the words that are on it: "flexion", "internal rotation at 90° flexion", "FADIR".
export function tile(page, name) {
  return page.locator(".tile", { has: page.locator(".tile-name", { hasText: new RegExp(`^${name}$`) }) });
}

/// All of its digits: the field shows a tenth of a degree.
export async function angleOf(page, name) {
  return Number(await page.locator(`input[role=spinbutton][aria-label="${name.replaceAll("_", " ")}, degrees"]`).getAttribute("aria-valuenow"));
}

/// Plain bones, without colours of contact.
export async function plain(page) {
  await viewOptions(page);
  await page.getByLabel("Colour", { exact: true }).selectOption("none");
  await page.getByLabel("Mark triangles in contact").uncheck();
  await settled(page);
}
