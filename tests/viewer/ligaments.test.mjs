// Ligaments on the page: the motions that they end, where the joint stands against them, and what is drawn, against the command.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { drop, keep, openPage, openTab, pixels, plain, region, reports, root, settled, sharedBrowser, tile, turnTo } from "./browser.mjs";
import { assertCommandLimits } from "./command_limits.mjs";

const condyle = join(root, "build/release/condyle"), browser = await sharedBrowser();
const run = (...words) => execFileSync(condyle, words, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
const limitsOf = (joint) => JSON.parse(run("rom", joint, "--json")).motions;

// Strings of nobody.
const strings = `
[[ligament]]
name = "anterior band"
fixed = [30, 28, 8]
mobile = [12, -38, 30]
slack_share = 1.05
stiffness_n = 500
ends_at_strain = 0.1
wrap = { shape = "sphere", body = "mobile", centre = [0, 0, 0], radius = 24 }

[[ligament]]
name = "posterior band"
fixed = [-28, -15, 10]
mobile = [2, 5, 48]
slack_share = 1.1
ends_at_strain = 0.1
`;
const sample = (name) => join(reports, "sample", name), sampleText = readFileSync(sample("hip.toml"), "utf8");

function jointWith(name, text) {
  writeFileSync(sample(name), text + strings);
  return sample(name);
}

async function opened(joint, name) {
  const path = join(reports, `${name}.html`);
  run("report", joint, "--map", "flexion=0:120:40", "adduction=-30:20:25", "--vary", "internal_rotation", "--out", path);
  const { page, complaints } = await openPage(browser, path, { reducedMotion: "reduce" });
  await settled(page);
  return { page, complaints };
}

const status = (page) => page.locator("#status-text").textContent();
const says = (page, wanted) => page.waitForFunction((text) => document.querySelector("#status-text").textContent === text, wanted);
const near = (colour) => (...rgb) => rgb.every((value, i) => Math.abs(value - colour[i]) <= 12);
const [slack, taut, atEnd] = [[110, 110, 110], [0, 158, 115], [213, 94, 0]].map(near);

test("a motion that a ligament ends has the command's limit, and the page says and draws which one is at its end", async () => {
  const joint = jointWith("strings.toml", sampleText), motions = limitsOf(joint), extension = motions.find(({ name }) => name === "extension");
  assert.deepEqual([extension.reason, extension.ligament], ["ligament", "anterior band"]);
  assert.ok(motions.some(({ reason }) => reason === "contact"));
  const { page, complaints } = await opened(joint, "strings");
  await assertCommandLimits(page, motions);
  await tile(page, "extension").click();
  await says(page, "At the limit: ligament anterior band at its end");
  assert.ok((await page.locator("#sentence").textContent()).startsWith(`Extension ends at ${extension.limit_deg.toFixed(1)}°, ligament anterior band at its end; `));
  await openTab(page, "Details");
  const rows = await page.locator("#ligaments tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map(({ textContent }) => textContent)));
  assert.deepEqual(rows.map(([name, is, , strain, tension]) => [name, is, strain, tension]),
    [["anterior band", "at its end", "10.0", "35.0"], ["posterior band", "slack", rows[1][3], "0.0"]]);
  assert.match(await page.locator("#panel-details").textContent(), /ligament anterior band/);
  await plain(page);
  const seen = await pixels(page);
  assert.ok(region(seen, atEnd).count > 50, "drawn in the colour of its end");
  assert.ok(region(seen, slack).count > 50, "and the slack one in grey");
  await keep(page, "ligaments");
  await openTab(page, "Motion");
  await turnTo(page, { flexion: -extension.limit_deg + 0.5 });
  assert.ok(region(await pixels(page), taut).count > 50, "taut before it");
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("past the end of a ligament the page says so, and how far the joint turns back", async () => {
  const joint = jointWith("strings.toml", sampleText), extension = limitsOf(joint).find(({ name }) => name === "extension");
  const { page } = await opened(joint, "strings");
  await turnTo(page, { flexion: -extension.limit_deg - 5 });
  await page.waitForFunction(() => document.querySelector("#status-text").textContent.startsWith("Past the end of ligament anterior band"));
  await page.locator("#exit", { hasText: /^free after [1-4]\.\d° of |^free after 5\.0° of flexion$/ }).waitFor();
  await page.locator("#exit").click();
  await says(page, "At the limit: ligament anterior band at its end");
  await openTab(page, "Figures");
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("section", { has: page.getByRole("heading", { name: "Range-of-motion map" }) }).last()
    .getByRole("button", { name: "Save data" }).click()]);
  const [head, ...rows] = readFileSync(await download.path(), "utf8").trimEnd().split("\n").map((line) => line.split(","));
  assert.deepEqual(head.slice(-4), ["contact_at_low", "contact_at_high", "ligament_at_low", "ligament_at_high"]);
  const ended = rows.flatMap((row) => [[row.at(-4), row.at(-2)], [row.at(-3), row.at(-1)]]);
  assert.ok(ended.some(([contact, ligament]) => contact === "0" && ligament === "1") && !ended.some(([contact, ligament]) => contact === "1" && ligament === "1"));
  assert.match(await page.locator(".map .cell").evaluateAll((cells) => cells.map((cell) => cell.getAttribute("aria-label")).join("\n")), /\(a ligament ends it\)/);
  await page.context().close();
});

test("about a moved centre ligaments end motions where they do in a joint with that centre", async () => {
  const { page } = await opened(jointWith("strings.toml", sampleText), "strings");
  await openTab(page, "Plan");
  await page.locator("summary", { hasText: "Move the joint centre" }).click();
  const panel = page.getByRole("region", { name: "Move the joint centre", exact: true });
  for (let i = 0; i < 4; ++i) {
    await panel.evaluate((element) => delete element.dataset.allAfter);
    await page.getByRole("button", { name: "+0.5 mm superior" }).click();
    await page.waitForFunction((element) => element.dataset.allAfter !== undefined, await panel.elementHandle());
  }
  // Points of strings are given from the mesh's origin, which is the centre before.
  const moved = limitsOf(jointWith("strings_moved.toml", sampleText.replace(/^centre = .*/m, "centre = [0, 2, 0]"))).filter(({ reason }) => reason === "ligament");
  const after = await page.getByRole("region", { name: "Limits about both centres", exact: true }).locator("tbody tr").evaluateAll((rows) => rows.map((row) => row.cells[2].textContent));
  assert.ok(moved.length > 1);
  for (const { limit_deg } of moved) assert.ok(after.includes(`${limit_deg.toFixed(1)}°`), `${limit_deg} in ${after}`);
  await page.context().close();
});

test("a joint file with ligaments is taken where it is dropped", async () => {
  const joint = jointWith("strings.toml", sampleText);
  const { page } = await openPage(browser, join(root, "build/release/report_template.html"), { answers: false });
  await drop(page, [joint, sample("hip_bone.ply"), sample("femur.ply")]);
  await page.waitForFunction(() => globalThis.condyle !== undefined);
  await settled(page);
  await assertCommandLimits(page, limitsOf(joint));
  await tile(page, "extension").click();
  await says(page, "At the limit: ligament anterior band at its end");
  assert.deepEqual(await page.getByRole("alert").allTextContents(), []);
  assert.equal(await status(page), "At the limit: ligament anterior band at its end");
  await page.context().close();
});
