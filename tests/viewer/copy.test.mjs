// A page saved with what its user wrote and pointed at: one file that opens as it was seen, whose report is untouched.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { axeSource, keep, openPage, openTab, pathOf, reports, settled, sharedBrowser, turnTo } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const dataOf = (html) => /<script type="application\/octet-stream" id="condyle-data">([^<]*)<\/script>/.exec(html)[1];
const notesOf = (html) => /<script type="application\/octet-stream" id="condyle-notes">([^<]*)<\/script>/.exec(html)?.[1];
const said = "Look here:\n</script><img src=x onerror=\"alert(1)\"> <!-- & \u2028 ה\u202eצוואר 頸 <b>neck</b>";

async function opened(path = pathOf("sample"), options = {}) {
  const page = await openPage(browser, path, { width: 1440, height: 900, reducedMotion: "reduce", ...options });
  if (options.answers !== false) await settled(page.page);
  return page;
}

async function openNotes(page) {
  await openTab(page, "Details");
  const summary = page.locator("#notes-of-user > summary");
  if (!(await summary.evaluate((element) => element.parentElement.open))) await summary.click();
}

async function pinAt(page, vertex, text, body = null) {
  if (body) await page.getByLabel("Pin on bone").selectOption(body);
  await page.getByLabel("Pin at vertex number").fill(String(vertex));
  await page.getByRole("button", { name: "Pin there" }).click();
  const count = await page.locator(".pins li").count();
  await page.getByRole("textbox", { name: `Text of pin ${count}`, exact: true }).fill(text);
}

/// The copy as a file, and its text.
async function saveCopy(page, name) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save copy" }).click()]);
  assert.match(download.suggestedFilename(), /_copy\.html$/);
  const path = join(reports, `${name}.html`);
  await download.saveAs(path);
  return { path, html: readFileSync(path, "utf8") };
}

const seen = (page) => page.evaluate(() => ({
  notes: document.getElementById("user-notes").value, pins: [...document.querySelectorAll(".pins li")].map((item) => [item.querySelector("input").value, item.querySelector("span").textContent]),
  angles: [...document.querySelectorAll("#panel-motion input[role=spinbutton]")].map((field) => field.getAttribute("aria-valuenow")), hash: location.hash,
}));

test("a copy opens as it was seen, with notes and pins; its report is the same bytes, and a copy of it the same file", async () => {
  const { page, complaints, requests } = await opened();
  await turnTo(page, { flexion: 47.123456789, adduction: 5 });
  await openNotes(page);
  await page.getByLabel("Notes", { exact: true }).fill(said);
  await pinAt(page, 120, `</script><script>alert("pin")</script>`);
  await pinAt(page, 7, "שפה", "fixed");
  const was = await seen(page), { path, html } = await saveCopy(page, "copied");
  assert.equal(dataOf(html), dataOf(readFileSync(pathOf("sample"), "utf8")));
  // Nothing that the user wrote stands in the file as HTML.
  assert.ok(!html.includes("onerror") && !html.includes("alert(") && !html.includes("Look here") && !html.includes("שפה"));
  assert.match(notesOf(html), /^[A-Za-z0-9+/=]+$/);
  const stored = JSON.parse(Buffer.from(notesOf(html), "base64"));
  assert.deepEqual([stored.condyle_notes, stored.text, stored.pins.map(({ body, vertex }) => [body, vertex])], [1, said, [["mobile", 120], ["fixed", 7]]]);

  const copy = await opened(path);
  assert.match(await copy.page.locator("#messages [role=status]").textContent(), /^Copy with 3 notes, by whoever saved it and not by Condyle\.$/);
  await keep(copy.page, "copy");
  const now = await seen(copy.page);
  assert.deepEqual(now, was);
  assert.equal(now.angles[0], "47.123456789");
  await copy.page.getByRole("button", { name: "Read them" }).click();
  assert.equal(await copy.page.getByLabel("Notes", { exact: true }).inputValue(), said);
  await keep(copy.page, "copy_notes");
  assert.equal(await copy.page.locator("img[src=x], #panel-details b").count(), 0);
  await settled(copy.page);
  const again = await saveCopy(copy.page, "copied_again");
  assert.equal(again.html, html);
  // And one with more in it.
  await copy.page.getByRole("button", { name: "Remove pin 1" }).click();
  await copy.page.getByLabel("Notes", { exact: true }).fill("other");
  const other = await saveCopy(copy.page, "copied_other");
  assert.equal(other.html.replace(notesOf(other.html), ""), html.replace(notesOf(html), ""));
  const last = await opened(other.path);
  assert.match(await last.page.locator("#messages [role=status]").textContent(), /^Copy with 2 notes/);
  assert.deepEqual((await seen(last.page)).pins.map(([text]) => text), ["שפה"]);
  for (const each of [complaints, requests, copy.complaints, copy.requests, last.complaints, last.requests]) assert.deepEqual(each, []);
  for (const each of [page, copy.page, last.page]) await each.context().close();
});

test("the address says more than a copy, and a copy without notes says so", async () => {
  const { page } = await opened();
  await turnTo(page, { flexion: 30 });
  const { path } = await saveCopy(page, "copied_plain");
  const copy = await opened(path, { fragment: "#adduction=10" });
  assert.deepEqual((await seen(copy.page)).angles.map(Number), [0, 10, 0]);
  assert.match(await copy.page.locator("#messages [role=status]").textContent(), /^Copy with no notes/);
  await page.context().close();
  await copy.page.context().close();
});

test("a pin stands at its vertex: by number and by pointer, in its own frame and in that of the fixed body", async () => {
  const { page } = await opened();
  const { array } = readReport(pathOf("sample")), vertex = 120, own = array("mobile_vertices").slice(3 * vertex, 3 * vertex + 3);
  await turnTo(page, { flexion: 60, internal_rotation: 10 });
  await openNotes(page);
  await pinAt(page, vertex, "");
  const { pose } = await page.evaluate(() => condyle.query({ of: "pose", at: { angles: [60, 0, 10], translation: [0, 0, 0] } }));
  const rows = Object.values(pose), inF = [0, 1, 2].map((i) => [...own].reduce((sum, mm, k) => sum + rows[4 * i + k] * mm, rows[4 * i + 3]));
  const three = (point) => [...point].map((mm) => mm.toFixed(2).replace("-", "\u2212")).join(", ");
  assert.equal((await seen(page)).pins[0][1], `femur, vertex ${vertex}: ${three(own)} mm in its own frame, ${three(inF)} mm in that of hip bone as it stands`);
  const mark = await page.locator(".scene-number").boundingBox(), at = await page.evaluate((point) => {
    const box = condyle.scene.canvas.getBoundingClientRect(), [x, y] = condyle.scene.project(point);
    return [box.left + x, box.top + y];
  }, inF);
  assert.ok(Math.abs(mark.x + mark.width / 2 - at[0]) < 1 && Math.abs(mark.y + mark.height / 2 - at[1]) < 1);

  // A press on a bone sets one only while the box is ticked, and a drag none.
  const box = await page.locator("#scene > canvas").boundingBox(), middle = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.click(...middle);
  assert.equal(await page.locator(".pins li").count(), 1);
  await page.getByLabel("Pin on the bones").check();
  const picked = await page.evaluate(([clientX, clientY]) => condyle.scene.pick({ clientX, clientY }), middle);
  await page.mouse.click(...middle);
  assert.equal(await page.locator(".pins li").count(), 2);
  assert.match((await seen(page)).pins[1][1], new RegExp(`^${picked.body === "mobile" ? "femur" : "hip bone"}, vertex ${picked.vertex}: `));
  await page.mouse.move(...middle);
  await page.mouse.down();
  await page.mouse.move(middle[0] + 40, middle[1], { steps: 4 });
  await page.mouse.up();
  assert.equal(await page.locator(".pins li").count(), 2);
  assert.deepEqual(await page.locator(".scene-number").allTextContents(), ["1", "2"]);
  await keep(page, "pins");
  // By keyboard.
  await page.getByLabel("Pin at vertex number").focus();
  await page.keyboard.type("99999999");
  await page.keyboard.press("Enter");
  assert.match(await page.locator("#notes-of-user [role=status]").textContent(), /^femur has vertices 0 to \d+$/);
  await page.getByLabel("Pin at vertex number").fill("3");
  await page.keyboard.press("Enter");
  assert.equal(await page.locator(".pins li").count(), 3);
  await page.getByRole("button", { name: "Remove pin 2" }).focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelectorAll(".scene-number").length === 2);
  assert.equal(await page.locator(".pins li").count(), 2);
  assert.deepEqual(await page.locator(".scene-number").allTextContents(), ["1", "2"]);
  await page.evaluate(axeSource);
  assert.deepEqual((await page.evaluate(() => globalThis.axe.run("#panel-details"))).violations.map(({ id }) => id), []);
  await page.context().close();
});

test("notes are on paper under a title that says whose they are, on two sheets", async () => {
  const { page } = await opened();
  await openNotes(page);
  await page.getByLabel("Notes", { exact: true }).fill(said);
  await pinAt(page, 5, "the neck");
  const path = join(reports, "seen", "copy.pdf");
  await page.pdf({ path, format: "A4" });
  assert.equal((readFileSync(path, "latin1").match(/\/Type\s*\/Page\b/g) ?? []).length, 2);
  const sheet = await page.locator("#paper .sheet").last().textContent();
  assert.ok(sheet.includes("Notes of the user") && sheet.includes(said) && sheet.includes("the neck") && sheet.includes("femur, vertex 5:"));
  await page.context().close();
});

test("a block of notes that is none is said in one line, and the report is shown", async () => {
  const { page } = await opened();
  await openNotes(page);
  await pinAt(page, 5, "");
  const { html } = await saveCopy(page, "copied_whole"), block = JSON.parse(Buffer.from(notesOf(html), "base64"));
  await page.context().close();
  const wrong = {
    "condyle-notes": "bm9uZQ==", condyle_notes: { ...block, condyle_notes: 2 }, text: { ...block, text: 3 }, "pins[0].vertex": { ...block, pins: [{ body: "mobile", vertex: 1e9, text: "" }] },
    "pins[0].body": { ...block, pins: [null] }, view: { ...block, view: "javascript:alert(1)" },
  };
  for (const [key, change] of Object.entries(wrong)) {
    const path = join(reports, "copied_wrong.html"), changed = typeof change === "string" ? change : Buffer.from(JSON.stringify(change)).toString("base64");
    writeFileSync(path, html.replace(notesOf(html), changed));
    const { page: shown, complaints } = await opened(path);
    assert.equal(await shown.getByRole("alert").textContent(), `The notes of this copy cannot be read: ${key} is missing or is not what a copy has there. The report is shown without them.`);
    assert.equal(await shown.locator(".result").count(), 4);
    assert.deepEqual(complaints, []);
    await shown.context().close();
  }
});

test("without WebAssembly there is a copy too, and on a phone its button fits beside the others", async () => {
  const { page } = await opened(pathOf("sample"), { width: 390, height: 844, isMobile: true, hasTouch: true, script: "delete globalThis.WebAssembly", answers: false });
  await page.getByRole("button", { name: "Save copy" }).waitFor();
  const tops = await page.locator("#actions button").evaluateAll((buttons) => buttons.map((button) => Math.round(button.getBoundingClientRect().top)));
  assert.equal(new Set(tops).size, 1);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await saveCopy(page, "copied_phone");
  await page.context().close();
});
