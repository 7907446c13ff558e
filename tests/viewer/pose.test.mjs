// What the page says of a pose: by the rule of the limits, wherever the pose came from.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { angleOf, has, keep, openPage, pathOf, reports, root, settled, sharedBrowser, tile, turnTo } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const motionOf = (report, name) => readReport(pathOf(report)).text.rom.motions.find((motion) => motion.name === name);

/// Waits until the page says this state of the pose; its words.
async function saidOf(page, state) {
  await page.waitForFunction((wanted) => document.getElementById("status").dataset.state === wanted, state);
  return page.locator("#status-text").textContent();
}

const readoutOf = (page, i) => page.locator(".slider-readout").nth(i).textContent();

/// Waits until an angle is this one: the browser goes back in its own time.
const isAngle = (page, name, deg) => page.waitForFunction(([label, value]) =>
  Number(document.querySelector(`input[role=spinbutton][aria-label="${label}, degrees"]`).getAttribute("aria-valuenow")) === value, [name, deg]);

test("contact in the socket ends no motion, and chip and sliders say so alike", async () => {
  const { bearing_contact_deg, limit_deg } = motionOf("shifted", "flexion");
  const { page } = await openPage(browser, pathOf("shifted"), { reducedMotion: "reduce" });
  await turnTo(page, { flexion: (bearing_contact_deg + limit_deg) / 2 });
  assert.equal(await saidOf(page, "bearing"), "Bearing contact, ends no motion");
  assert.match(await page.locator("#answer").textContent(), /^In contact/);
  assert.equal(await page.locator("#exit").isVisible(), false);
  for (const i of [0, 1, 2]) assert.match(await readoutOf(page, i), /^free /);
  await tile(page, "flexion").click();
  assert.match(await saidOf(page, "limit"), /^At the limit, first contact: /);
  assert.equal(await tile(page, "flexion").getAttribute("aria-current"), "true");
  await turnTo(page, { flexion: limit_deg + 5 });
  assert.match(await saidOf(page, "contact"), /^Impinging/);
  assert.equal(await readoutOf(page, 0), `blocked, free from ${limit_deg.toFixed(1)}°`);
  await page.context().close();
});

test("where bearing contact counts, contact that ends motions is not called impingement", async () => {
  const { page } = await openPage(browser, pathOf("counted"));
  await turnTo(page, { flexion: 140 });
  assert.match(await saidOf(page, "contact"), /^In contact/);
  // The bound of the volume is rounded up.
  await page.waitForFunction(() => /to within/.test(document.getElementById("depth").textContent));
  const inWords = Number((await page.locator("#depth").textContent()).match(/to within ([^;]+)/)[1]);
  const { volumeError_mm3 } = await page.evaluate((at) => condyle.query({ of: "depth", at }), { angles: [140, 0, 0], translation: [0, 0, 0] });
  assert.ok(inWords >= volumeError_mm3 && inWords < 2 * volumeError_mm3, `to within ${inWords}, of ${volumeError_mm3}`);
  await page.context().close();
});

/// The page says that the joint is at the end of flexion, as if that had been pressed.
async function isAtFlexion(page, sentence) {
  assert.match(await saidOf(page, "limit"), /^At the limit, first contact: femur on hip bone/);
  await page.locator(".tile[aria-current]").waitFor();
  assert.equal(await tile(page, "flexion").getAttribute("aria-current"), "true");
  assert.equal(await page.locator("#sentence").textContent(), sentence);
  assert.match(await page.locator("#scene .scene-pin").textContent(), /femur on hip bone/);
}

test("the pose of a limit is that limit from a link, a field, undo or a copy, with pin and sentence", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await settled(page);
  await tile(page, "flexion").click();
  const sentence = await page.locator("#sentence").textContent();
  assert.match(sentence, /^Flexion ends at /);
  await isAtFlexion(page, sentence);
  await page.waitForFunction(() => location.hash.includes("flexion="));
  const { hash } = new URL(page.url());
  const link = await openPage(browser, pathOf("sample"), { fragment: hash });
  await isAtFlexion(link.page, sentence);
  await link.page.context().close();
  await turnTo(page, { flexion: 20 });
  await saidOf(page, "free");
  assert.equal(await page.locator(".tile[aria-current]").count(), 0);
  await page.getByRole("button", { name: "Undo" }).click();
  await isAngle(page, "flexion", motionOf("sample", "flexion").limit_deg);
  await isAtFlexion(page, sentence);
  const typed = await openPage(browser, pathOf("sample"));
  await turnTo(typed.page, { flexion: motionOf("sample", "flexion").limit_deg.toFixed(1) });
  await isAtFlexion(typed.page, sentence);
  // Five hundredths of a degree are at the limit; more are not.
  await turnTo(typed.page, { flexion: motionOf("sample", "flexion").limit_deg - 0.06 });
  await saidOf(typed.page, "free");
  await typed.page.context().close();
  await page.context().close();
});

const depthOf = (joint, pose, ...how) => JSON.parse(execFileSync(join(root, "build/release/condyle"), ["depth", join(reports, joint), "--pose", pose, "--json", ...how],
  { stdio: ["ignore", "pipe", "ignore"] }));

test("a limit that is none of the report's has its motion and bodies named", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#adduction=10&flexion=100", reducedMotion: "reduce" });
  await settled(page);
  const end = (await page.evaluate(() => condyle.query({ of: "limit", limit: { start: [100, 10, 0], vary: 2, positive: true, range_deg: 90 } }))).turned_deg;
  await turnTo(page, { internal_rotation: end });
  // Bone meets bone there, so that other rotations end too: the one that the command finds nearest is named.
  const { state, nearest_limit } = depthOf("sample/hip.toml", `flexion=100 adduction=10 internal_rotation=${end}`);
  assert.equal(state, "at_limit");
  assert.equal(await saidOf(page, "limit"), `At the limit of ${nearest_limit.movement.replaceAll("_", " ")}, first contact: femur on hip bone`);
  await page.context().close();
});

test("turned by a slider into contact, the joint turns back about that movement as far as the command says", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#flexion=138&adduction=5" });
  const said = page.locator("#last-movement");
  await saidOf(page, "contact");
  await page.waitForTimeout(600);
  assert.equal(await said.textContent(), "", "nothing has moved yet");
  await page.locator("#angle-flexion").focus();
  for (let i = 0; i < 12; ++i) await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.getElementById("last-movement").textContent !== "");
  const flexion = await angleOf(page, "flexion"), depth = (about) =>
    depthOf("sample/hip.toml", `flexion=${flexion} adduction=5`, "--method", "tangential", `--about=${about}`);
  const { max_tangential_depth_deg: deg, max_tangential_depth_mm: mm } = depth("flexion");
  assert.ok(flexion > 139 && deg > 1, `${deg} at ${flexion}`);
  assert.equal(await said.textContent(), `${deg.toFixed(1)}° (${mm.toFixed(1)} mm) about the last movement`);
  await keep(page, "last_movement");
  // About the very line of a movement, the very bits.
  const screw = await page.evaluate((at) => condyle.query({ of: "screw", at, before: { angles: [90, -10, 20], translation: [0, 0, 0] } }),
    { angles: [flexion, 5, 0], translation: [0, 0, 0] });
  const commands = depth([...screw.axis.direction, ...screw.axis.point].join(" "));
  assert.deepEqual([screw.depth_deg, screw.depth_mm], [commands.max_tangential_depth_deg, commands.max_tangential_depth_mm]);
  await turnTo(page, { flexion: 90 });
  assert.equal(await said.textContent(), "");
  await page.context().close();
});

/// What the page says of a free pose, once it has measured it.
async function nearestSaid(page) {
  await page.waitForFunction(() => document.getElementById("status-text").textContent.startsWith("Free · "));
  return page.locator("#status-text").textContent();
}

const nearestOf = (joint, pose) => depthOf(joint, pose).nearest_distance_mm;

test("chip, condyle depth and the curve of a motion give one nearest distance, and the chip says between what", async () => {
  const { text, array } = readReport(pathOf("moves"));
  const gaps = array(text.recorded.curves.find(({ name }) => name === "smallest_gap_mm").values), angles = array(text.recorded.coordinates_deg);
  const { page } = await openPage(browser, pathOf("moves"));
  for (const i of [1, 2]) {
    const [flexion, adduction, internal_rotation] = angles.slice(3 * i, 3 * i + 3);
    await turnTo(page, { flexion, adduction, internal_rotation });
    const said = await nearestSaid(page), mm = nearestOf("sample/moves.toml", `flexion=${flexion} adduction=${adduction} internal_rotation=${internal_rotation}`);
    assert.equal(gaps[i].toFixed(9), mm.toFixed(9));
    assert.match(said, new RegExp(`^Free · ${mm.toFixed(1)} mm, head to socket · [\\d.]+ mm, \\w+`));
  }
  await page.context().close();
});

test("near the end of a motion the neck is nearest to the rim, a little before it touches", async () => {
  const { limit_deg } = motionOf("sample", "internal_rotation_at_90_flexion");
  const { page } = await openPage(browser, pathOf("sample"), { fragment: `#flexion=90&internal_rotation=${limit_deg - 0.2}` });
  const mm = nearestOf("sample/hip.toml", `flexion=90 internal_rotation=${limit_deg - 0.2}`);
  assert.equal(await nearestSaid(page), `Free · ${mm.toFixed(1)} mm, neck to rim`);
  await page.context().close();
});

test("on a real hip the chip's distance is the command's", { skip: !has("vhf_right") && "not made" }, async () => {
  const { page } = await openPage(browser, pathOf("vhf_right"), { fragment: "#flexion=40" });
  assert.ok((await nearestSaid(page)).startsWith(`Free · ${nearestOf("vhf_right.toml", "flexion=40").toFixed(1)} mm, head to socket · `));
  await page.context().close();
});

test("the clearance of an implant is that of its neck from the liner, not of the head in it", async () => {
  const { limit_deg } = motionOf("placed", "flexion"), mms = [];
  for (const flexion of [40, limit_deg - 5, limit_deg - 0.5]) {
    const { page } = await openPage(browser, pathOf("placed"), { fragment: `#flexion=${flexion}` });
    const [, mm, between] = /^Free · ([\d.]+) mm, (.*)$/.exec(await nearestSaid(page));
    if (flexion !== 40) assert.equal(between, "neck to liner");
    mms.push(Number(mm));
    await page.context().close();
  }
  assert.ok(mms[0] > mms[1] && mms[1] > mms[2] && mms[2] < 0.3, String(mms));
});

test("Back takes gestures back one by one as Undo does, Forward brings them again, and a link is one entry", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#flexion=20", reducedMotion: "reduce" });
  await settled(page);
  const entries = () => page.evaluate(() => history.length), first = await entries(), undo = page.getByRole("button", { name: "Undo", exact: true });
  await page.waitForFunction(() => location.hash.includes("camera"));
  assert.equal(await entries(), first);
  assert.equal(await undo.isDisabled(), true);
  // Many events of a slider are one gesture: sent at once, since events that a busy machine has further apart are more.
  await page.locator("#angle-flexion").focus();
  await Promise.all(Array.from({ length: 6 }, () => page.keyboard.press("ArrowRight")));
  await isAngle(page, "flexion", 20.6);
  assert.equal(await entries(), first + 1);
  await turnTo(page, { adduction: 10.123456789 });
  await tile(page, "FADIR").click();
  assert.equal(await entries(), first + 3);
  await page.goBack();
  await isAngle(page, "adduction", 10.123456789);
  await undo.click();
  await isAngle(page, "adduction", 0);
  await isAngle(page, "flexion", 20.6);
  await page.goForward();
  await isAngle(page, "adduction", 10.123456789);
  await page.goBack();
  await page.keyboard.press("u");
  await isAngle(page, "flexion", 20);
  await page.waitForFunction(() => [...document.querySelectorAll("button")].find(({ textContent }) => textContent === "Undo").disabled);
  // And an address that is typed is a step.
  await page.evaluate(() => (location.hash = "#flexion=50"));
  await isAngle(page, "flexion", 50);
  await undo.click();
  await isAngle(page, "flexion", 20);
  // Before the first step the page is left.
  await page.goBack();
  await page.waitForURL("about:blank");
  await page.context().close();
});
