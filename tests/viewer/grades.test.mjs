// Notes of the checks in three grades, and joints that are planned.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { axeSource, has, openPage, openTab, panelsPlaced, pathOf, sharedBrowser, settled, tile, turnTo, type } from "./browser.mjs";
import { readReport, withText } from "./report_block.mjs";

const browser = await sharedBrowser();

const asSaid = (name) => name.replace(/^(fadir|faber)$/, (short) => short.toUpperCase()).replaceAll("_", " ").replace(/ at (\d+) /, " at $1° ");

async function opened(name, change, from) {
  const { page } = await openPage(browser, withText(name, change, from), { answers: false });
  await panelsPlaced(page);
  return page;
}

const wrong = { code: "wrong_side", text: "the side is left, but hip bone lies lateral of its socket" };
const finding = { code: "open_mesh", text: "femur has a boundary" };
const remark = { code: "coarse_mesh", text: "limits may be off by 2.4 degrees" };
const colourOf = (page, selector) => page.locator(selector).first().evaluate((element) => getComputedStyle(element).color);

test("a joint that is set up wrongly says so in place of the sentence, and its numbers are grey, whatever is pressed", async () => {
  const page = await opened("wrong_side", ({ rom }) => {
    rom.notes.push(wrong, finding, remark);
    rom.motions[0].limit_deg = rom.motions[0].normal_range_deg / 2;
  });
  const sentence = `Set up wrongly, no number holds: ${wrong.text}.`;
  assert.equal(await page.locator("#sentence").textContent(), sentence);
  const quiet = await colourOf(page, ".result:not(.short) > .result-normal");
  // How much a motion lacks is no finding then.
  assert.equal(await colourOf(page, ".result.short > .result-normal"), quiet);
  assert.equal(await colourOf(page, ".result-value b"), quiet);
  assert.equal(await colourOf(page, ".tile-value b"), quiet);
  await page.locator(".result").first().click();
  await page.locator(".result[aria-current]").waitFor();
  assert.equal(await page.locator("#sentence").textContent(), sentence);
  assert.ok((await page.locator("#paper").textContent()).includes(sentence));
  // The box below says the other notes only.
  assert.match(await page.locator("#noted").textContent(), /^1 note from the checks: femur has a boundary · 1 remark/);
  await page.evaluate(axeSource);
  const { violations } = await page.evaluate(() => axe.run("#strip"));
  assert.deepEqual(violations.map(({ id }) => id), []);
  await page.context().close();
});

test("a finding is amber with its text, and a remark on how exact limits are is a grey word", async () => {
  const both = await opened("finding", ({ rom }) => rom.notes.push(finding, remark));
  assert.match(await both.locator("#noted").textContent(), /^1 note from the checks: femur has a boundary · 1 remark on how exact the limits are/);
  assert.equal(await both.locator("#noted.warning").count(), 1);
  assert.match(await both.locator("#sentence").textContent(), / ends at /);
  await both.context().close();
  const page = await opened("remark", ({ rom }) => rom.notes.push(remark, { code: "translation_ends", text: "the record ends before the range" }));
  assert.match(await page.locator("#noted").textContent(), /^2 remarks on how exact the limits are/);
  assert.equal(await page.locator("#noted.warning").count(), 0);
  await page.context().close();
});

test("a comparison says with what, tells files of one name apart, and says planned if the joint after is", async () => {
  const { rom, before } = readReport(pathOf("compared")).text;
  // Both joint files have the same bytes, and both fixed meshes; the femurs differ.
  const of = ({ provenance }) => `hip.toml (femur.ply: SHA-256 ${provenance.mobile_mesh.sha256.slice(0, 8)}…)`;
  assert.notEqual(of(before.rom), of(rom));
  const page = await opened("compared_planned", ({ joint }) => (joint.planned = "without 164.1 mm3 of femur"), "compared");
  assert.equal(await page.locator("#ribbon").textContent(), `After a planned cut of 164.1 mm³ of femur · Compared with ${of(before.rom)}`);
  const plan = await page.locator("#plan-panels").textContent();
  assert.ok(plan.includes(`Before: ${of(before.rom)}. After: ${of(rom)}.`), plan);
  assert.match(await page.locator("#sentence").textContent(), /^Planned: /);
  assert.match(await page.locator(".result").first().textContent(), /[\d.]+ → >?[\d.]+°/);
  await page.context().close();
});

/// Presses, and waits until every limit after it is shown.
async function changed(page, press) {
  const region = await page.getByRole("region", { name: "Resect by brush", exact: true }).elementHandle();
  await region.evaluate((element) => delete element.dataset.allAfter);
  await press();
  await page.waitForFunction((element) => element.dataset.allAfter !== undefined && !document.body.classList.contains("limits-wait"), region);
}

test("after strokes of the brush tiles, figures and sentence are those of the cut joint, and what is not computed anew says before", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await settled(page);
  const { text } = readReport(pathOf("sample")), seen = ["#results", ".tiles", "#sentence", "#title", "#paper .paper-results"];
  const textNow = () => Promise.all(seen.map((each) => page.locator(each).textContent())), before = await textNow();
  const boxes = () => page.locator("#strip, main, #scene").evaluateAll((all) => all.map((each) => JSON.stringify(each.getBoundingClientRect())));
  const placed = await boxes();
  assert.equal(await page.locator("#ribbon").isVisible(), false);
  await openTab(page, "Plan");
  await page.getByRole("combobox", { name: "Motion", exact: true }).selectOption({ label: "FADIR" });
  for (let i = 0; i < 2; ++i) await changed(page, () => page.getByRole("button", { name: "Brush where it ends" }).click());
  assert.match(await page.locator("#ribbon").textContent(), /^After strokes of the brush that remove [\d.]+ mm³ of femur$/);
  assert.deepEqual(await boxes(), placed, "nothing moves for the ribbon");
  const fadir = text.rom.motions.find(({ name }) => name === "fadir"), names = text.coordinates.map(({ name }) => name);
  const now = await page.evaluate((limit) => condyle.query({ of: "limit", limit }), {
    start: names.map((name) => fadir.start_deg[name]), vary: names.indexOf(fadir.vary), positive: fadir.sense === "positive", range_deg: fadir.range_deg,
  });
  assert.ok(now.turned_deg > fadir.limit_deg + 0.5);
  const arrow = `${fadir.limit_deg.toFixed(1)} → ${now.turned_deg.toFixed(1)}°`;
  assert.ok((await page.locator(".result", { hasText: "FADIR" }).textContent()).includes(arrow));
  assert.ok((await page.locator("#paper .sheet").first().textContent()).includes(arrow));
  // The limit is where the slider has it, and pressed it is the one of the cut joint.
  await openTab(page, "Motion");
  assert.ok((await tile(page, "FADIR").textContent()).includes(arrow));
  await tile(page, "FADIR").click();
  await page.waitForFunction(() => document.getElementById("status").dataset.state === "limit");
  assert.equal(await tile(page, "FADIR").getAttribute("aria-current"), "true");
  assert.ok((await page.locator("#sentence").textContent()).startsWith(`Planned: FADIR ends at ${arrow}`));
  assert.ok((await page.locator(".slider-readout").nth(2).textContent()).endsWith(`to ${now.turned_deg.toFixed(1)}°`));
  // Where the old limit was, the joint is free now.
  await turnTo(page, { internal_rotation: fadir.limit_deg });
  await page.waitForFunction(() => document.getElementById("status").dataset.state === "free");
  assert.equal(await page.locator(".tile[aria-current]").count(), 0);
  await page.getByRole("button", { name: "Back to zero" }).click();
  await openTab(page, "Figures");
  assert.deepEqual(await page.locator("#panel-figures .of-report h2").allTextContents(),
    ["Range-of-motion map before the last change by hand", "Contacts on the clock face before the last change by hand"]);
  await openTab(page, "Plan");
  for (let i = 0; i < 2; ++i) await changed(page, () => page.getByRole("button", { name: "Undo stroke" }).click());
  assert.deepEqual(await textNow(), before);
  assert.equal(await page.locator("#ribbon").isVisible(), false);
  assert.equal(await page.locator(".of-report .before").count(), 0);
  await page.context().close();
});

test("parts that are turned show their limits beside those of the report, under a ribbon", async () => {
  const { page } = await openPage(browser, pathOf("tilted"), { reducedMotion: "reduce" });
  await settled(page);
  const ribbon = await page.locator("#ribbon").textContent(), results = await page.locator("#results").textContent();
  assert.match(ribbon, /^Planned: pelvis\.tilt 10/);
  await openTab(page, "Plan");
  await page.locator("summary", { hasText: "Turn the parts" }).click();
  await type(page.getByRole("spinbutton", { name: "pelvis tilt, degrees" }).first(), 12);
  await page.waitForFunction(() => document.getElementById("ribbon").textContent === "After parts were turned: pelvis.tilt=12" &&
    !document.body.classList.contains("limits-wait"));
  assert.match(await page.locator("#results").textContent(), /[\d.]+ → >?[\d.]+°/);
  await page.getByRole("button", { name: "Back to the report's" }).click();
  await page.waitForFunction((said) => document.getElementById("ribbon").textContent === said && !document.body.classList.contains("limits-wait"), ribbon);
  assert.equal(await page.locator("#results").textContent(), results);
  await page.context().close();
});

test("a link to a joint that was changed by hand says that it shows the joint before", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { reducedMotion: "reduce" });
  await settled(page);
  await openTab(page, "Plan");
  await changed(page, () => page.getByRole("button", { name: "Brush where it ends" }).click());
  await openTab(page, "Motion");
  await turnTo(page, { flexion: 30 });
  await page.waitForFunction(() => location.hash.includes("by_hand=1") && location.hash.includes("flexion=30"));
  const link = await openPage(browser, pathOf("sample"), { fragment: new URL(page.url()).hash });
  await settled(link.page);
  const said = "This link was made after a change by hand, which no link carries: the joint is as in the report";
  assert.equal(await link.page.locator("#ribbon").textContent(), said);
  // A link of the link says it too.
  await turnTo(link.page, { flexion: 40 });
  await link.page.waitForFunction(() => location.hash.includes("flexion=40") && location.hash.includes("by_hand=1"));
  await page.context().close();
  await link.page.context().close();
});

test("the ribbon of a plan is under the heading and in the picture", async () => {
  const { page } = await openPage(browser, pathOf("plan"));
  await settled(page);
  const [cut] = readReport(pathOf("plan")).text.plan.cuts, said = `After a planned cut of ${cut.volume_mm3.toFixed(1)} mm³ of femur`;
  assert.equal(await page.locator("#ribbon").textContent(), said);
  const [title, ribbon] = await Promise.all(["#title", "#ribbon"].map((each) => page.locator(each).boundingBox()));
  assert.equal(ribbon.height, 28);
  assert.ok(ribbon.y >= title.y + title.height);
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Picture" }).click()]);
  const bytes = readFileSync(await download.path()).toString("base64");
  const colour = await page.evaluate(async (png) => {
    const image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    const canvas = document.createElement("canvas"), context = canvas.getContext("2d");
    [canvas.width, canvas.height] = [image.width, image.height];
    context.drawImage(image, 0, 0);
    // Beside the end of the text, in the middle of the ribbon.
    const ratio = image.width / document.getElementById("scene").clientWidth;
    return [...context.getImageData(image.width - 3, Math.round(48 * ratio), 1, 1).data];
  }, bytes);
  assert.deepEqual(colour, [0x6a, 0x3d, 0x9a, 255]);
  await page.context().close();
});

test("where zero is the pose of the scan it is said, and opposite motions have their total arc", { skip: !has("vhf_right") && "not made" }, async () => {
  for (const name of ["vhf_right", "placed"]) {
    const { rom } = readReport(pathOf(name)).text, { page } = await openPage(browser, pathOf(name));
    assert.equal(rom.zero.from, "as_given");
    assert.match(await page.locator(".tile-key").textContent(), /Zero is the pose of the scan: in grey the total arc of two opposite motions/);
    assert.ok(rom.arcs.length >= 1);
    for (const { motions: [one, other], arc_deg } of rom.arcs) {
      const arc = `arc ${arc_deg.toFixed(1)}°`, said = `${arc} with ${asSaid(other).replace(/ at .*/, "")}`, compared = rom.motions.find((motion) => motion.name === one), hasRange = compared.normal_range_deg !== null || Boolean(compared.bone_reference);
      assert.equal((await tile(page, asSaid(one)).textContent()).endsWith(arc), !hasRange, arc);
      const inStrip = hasRange ? ` · ${arc}` : said;
      if (one === "flexion") assert.ok((await page.locator(".result", { hasText: /^flexion / }).textContent()).endsWith(inStrip));
      if (one === "flexion") assert.ok((await page.locator("#paper .paper-results").textContent()).includes(inStrip));
    }
    await page.context().close();
  }
});
