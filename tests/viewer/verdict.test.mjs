// What a page judges limits by, and what a joint under load answers first.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { has, keep, openPage, openTab, panelsPlaced, pathOf, reports, root, settled, sharedBrowser } from "./browser.mjs";
import { readReport, withText } from "./report_block.mjs";

const browser = await sharedBrowser();
const condyle = join(root, "build/release/condyle");
// The knee's joint file names its meshes by this variable.
const data = process.env.CONDYLE_DATA ?? join(root, "../shared/data");
const run = (...words) => execFileSync(condyle, words, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], env: { ...process.env, CONDYLE_DATA: data } });

/// The page of a sample that is made here.
async function sampled(name, ...sample) {
  const folder = join(reports, name), path = join(reports, `${name}.html`), joint = join(folder, sample[0] === "reverse-shoulder" ? "shoulder.toml" : "hip.toml");
  run("sample", ...sample, "--out", folder);
  run("report", joint, "--out", path);
  const { page } = await openPage(browser, path, { reducedMotion: "reduce" });
  await settled(page);
  return { page, joint };
}

const tile = (page, name) => page.locator(".result", { hasText: new RegExp(`^${name} `) });
const rotation = "internal rotation at 90° flexion";

test("a hip with cam and pincer is short of simulated healthy hips, and page and command say so alike", async () => {
  const { page, joint } = await sampled("cam_pincer", "hip", "--alpha-angle", "80", "--centre-edge-angle", "40", "--anteversion", "5");
  const { bone_reference: bone, limit_deg } = JSON.parse(run("rom", joint, "--json")).motions.find(({ name }) => name === "internal_rotation_at_90_flexion");
  assert.deepEqual([bone.healthy_deg, bone.patients_deg, bone.people_each, bone.is_short], [27.9, 12.3, 10, true]);
  const sentence = await page.locator("#sentence").textContent();
  assert.ok(sentence.startsWith(`Internal rotation at 90° flexion ends at ${limit_deg.toFixed(1)}°, neck on rim at `), sentence);
  assert.ok(sentence.endsWith("; in simulated healthy hips at 27.9°, in patients with cam at 12.3° (Audenaert 2012)."), sentence);
  assert.ok((await tile(page, rotation).textContent()).endsWith(`${(27.9 - limit_deg).toFixed(0)}° short of 27.9°`));
  assert.equal(await tile(page, rotation).evaluate((element) => element.classList.contains("short")), true);
  assert.equal(await page.locator(".tile.short").count(), 1);
  assert.match(run("rom", joint, "--verbose"), /27\.9 deg in 10 simulated\s+healthy hips.* as early\s+as in hips with a cam/s);
  assert.ok((await page.locator("#paper").textContent()).includes(sentence));
  await keep(page, "cam_pincer");
  await page.context().close();
});

test("where nothing is short the sentence says what no motion ends before, and the clinical range is never passed", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await settled(page);
  const seen = await page.locator("#sentence").textContent();
  assert.match(seen, /; no motion ends before its clinical range or the 27\.9° of simulated healthy hips\.$/);
  assert.match(await tile(page, rotation).textContent(), /healthy bone 27\.9°$/);
  assert.equal(await page.locator(".tile.short, .result.short").count(), 0);
  assert.doesNotMatch(await page.locator("#strip").textContent(), /beyond|normal/);
  await page.context().close();
});

test("the second number of a limit is the command's: in its sentence, in Details with its sources, and on paper", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await settled(page);
  const { motions } = readReport(pathOf("sample")).text.rom, flexion = motions.find(({ name }) => name === "flexion");
  const said = JSON.parse(run("rom", join(reports, "sample/hip.toml"), "--band=20", "--json")).motions;
  assert.deepEqual(motions.map(({ living }) => living), said.map(({ living }) => living));
  assert.equal(flexion.living.text, `some ${(flexion.limit_deg - 3.1).toFixed(0)} (SD ${flexion.living.expected_sd_deg.toFixed(0)})`);
  await page.locator(".tile", { hasText: /^flexion/ }).click();
  assert.match(await page.locator("#sentence").textContent(), /^Flexion ends at .*, living hips some 3° earlier; /);
  await page.locator(".tile", { hasText: /^extension/ }).click();
  assert.doesNotMatch(await page.locator("#sentence").textContent(), /living/, "of weak motions nothing is subtracted");
  const details = await page.locator("#panel-details").textContent();
  for (const { living } of motions) if (living) assert.ok(details.includes(living.text), living.text);
  assert.match(details, /soft tissue ended motions earlier than bone in 9 cadaver hips.*extension 51\.9° \(SD 14\.4°\)/);
  assert.equal(await page.locator("#paper .living").count(), motions.filter(({ living }) => living?.expected_deg).length);
  await page.context().close();
});

test("a limit between healthy hips and those with a cam is compared and not called short", async () => {
  const between = withText("between", ({ rom }) => {
    const motion = rom.motions.find(({ name }) => name === "internal_rotation_at_90_flexion");
    Object.assign(motion, { limit_deg: 24, bone_reference: { ...motion.bone_reference, is_short: false } });
  });
  const { page } = await openPage(browser, between, { answers: false });
  await panelsPlaced(page);
  assert.match(await page.locator("#sentence").textContent(), / ends at 24\.0°.*; in simulated healthy hips at 27\.9° \(Audenaert 2012\)\.$/);
  assert.equal(await tile(page, rotation).evaluate((element) => element.classList.contains("short")), false);
  await page.context().close();
});

test("samples of implants are called so, have no box of notes, and no caveats of native hips", async () => {
  for (const sample of [["replacement"], ["replacement", "--bones", "none"], ["reverse-shoulder"]]) {
    const { page, joint } = await sampled(sample.join("_").replaceAll("-", ""), ...sample);
    assert.match(await page.locator("#title").textContent(), /Right (hip|shoulder) with an implant · /);
    assert.equal(await page.locator("#noted").count(), 0, `${sample}: ${await page.locator("#noted").allTextContents()}`);
    for (const said of [await page.locator("#side").textContent(), run("rom", joint)]) assert.doesNotMatch(said, /labrum|cadaver|native hips|capsule/);
    await page.context().close();
  }
});

test("a loaded knee opens on its largest pressure, in that frame, with area, force and the share of either side", { skip: !has("knee") && "not made" }, async () => {
  const { page, complaints } = await openPage(browser, pathOf("knee"), { reducedMotion: "reduce" });
  await settled(page);
  const { text, array } = readReport(pathOf("knee")), { curves, times_s } = text.recorded;
  const curve = (name) => array(curves.find((each) => each.name === name).values), pressure = curve("max_pressure_mpa");
  const frame = pressure.indexOf(Math.max(...pressure)), at = `${array(times_s)[frame].toFixed(2)} s`;
  const [medial, lateral] = ["medial", "lateral"].map((side) => curve(`${side}_share_percent`)[frame]);
  const force = Math.hypot(...["x", "y", "z"].map((axis) => curve(`force_in_mobile_${axis}_n`)[frame]));
  assert.ok(Math.abs(medial + lateral - 100) < 1e-9);
  const sentence = await page.locator("#sentence").textContent();
  assert.equal(sentence, `Peak pressure ${pressure[frame].toFixed(2)} MPa at ${at}: ${curve("area_mm2")[frame].toFixed(0)} mm² in contact carry ${force.toFixed(0)} N, ` +
    `medial : lateral ${medial.toFixed(0)} : ${lateral.toFixed(0)}.`);
  assert.deepEqual(await page.locator(".result-name").allTextContents(), ["peak pressure", "area then", "force then", "medial : lateral"]);
  assert.equal(await page.locator("input[aria-label=Frame]").inputValue(), String(frame));
  assert.ok((await page.locator("#paper").textContent()).includes(sentence));
  await keep(page, "loaded_knee");
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("limits of a loaded knee stand under how far from the scan's place it is held, and never in place of the load", { skip: !has("knee") && "not made" }, async () => {
  const path = join(reports, "knee_apart.html");
  run("report", join(root, "tests/support/knee_by_hand/tibiofemoral.toml"), "--translation", "y=-3", "--load", "--out", path,
    "--motion", join(data, "knee_lenhart2015_right/passive_flexion_states.sto"));
  const { page, complaints } = await openPage(browser, path, { reducedMotion: "reduce" });
  await settled(page);
  assert.match(await page.locator("#sentence").textContent(), /^Peak pressure /);
  assert.match(await page.locator("#paper").textContent(), /Limits held 3\.0 mm from the scan's place/);
  await openTab(page, "Motion");
  await page.getByRole("heading", { name: "Limits held 3.0 mm from the scan's place", exact: true }).waitFor();
  await page.locator(".tile", { hasText: /^flexion / }).click();
  await page.waitForFunction(() => /^Flexion ends at [\d.]+°, held 3\.0 mm from the scan's place, .*; no clinical range known\.$/.test(document.getElementById("sentence").textContent));
  assert.deepEqual(complaints, []);
  await page.context().close();
});
