// What the page says of random poses: chip, sliders, tiles and sentence by one rule, that of the limits.
import assert from "node:assert/strict";
import { test } from "node:test";
import { has, openPage, openTab, pathOf, sharedBrowser, settled, type } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const isLong = process.env.CONDYLE_LONG_TESTS === "1", states = isLong ? 1000 : 60, near_deg = 0.05;
const joints = ["sample", "shifted", "vhf_right", "placed", "parts", "plan"].filter(has);

/// Numbers in [0, 1), the same in every run.
function randomFrom(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  };
}

/// What the core says of the pose at hand, and what is read of it.
function stateOf(page) {
  return page.evaluate(async () => {
    const wait = () => new Promise((drawn) => requestAnimationFrame(drawn));
    await wait();
    const angles = [...document.querySelectorAll("#panel-motion .slider input[role=spinbutton]")].map((field) => Number(field.getAttribute("aria-valuenow")));
    const at = { angles, translation: [0, 0, 0] }, { inContact } = await condyle.query({ of: "pose", at }), free = [];
    for (const vary of [0, 1, 2]) {
      const [columnAngle, rowAngle] = [0, 1, 2].filter((angle) => angle !== vary);
      free.push(await condyle.query({ of: "mapPoint", point: 0, question: { columnAngle, rowAngle, vary, columns: [angles[columnAngle]], rows: [angles[rowAngle]], held: [0, 0, 0] } }));
    }
    // The page asks one after the other as well.
    await condyle.query({ of: "memory" });
    await wait();
    const text = (selector) => [...document.querySelectorAll(selector)].map(({ textContent }) => textContent);
    return {
      angles, inContact, free, chip: document.getElementById("status").dataset.state, chipText: text("#status-text")[0], answer: text("#answer")[0], readouts: text(".slider-readout"),
      exit: getComputedStyle(document.getElementById("exit")).visibility === "visible", sentence: text("#sentence")[0], current: text(".tile[aria-current] .tile-name"),
      currentResults: text(".result[aria-current] .result-name"), results: text(".result-name"), hash: location.hash,
    };
  });
}

/// The rule of the limits, as docs/report.md has it.
function ruleOf({ angles, inContact, free }) {
  const isAt = (deg, end) => Math.abs(deg - end) <= near_deg;
  if (free.some((intervals, i) => intervals.some(([low, high, atLow, atHigh]) => (atLow && isAt(angles[i], low)) || (atHigh && isAt(angles[i], high))))) return "limit";
  if (free.some((intervals, i) => !intervals.some(([low, high]) => low - near_deg <= angles[i] && angles[i] <= high + near_deg))) return "contact";
  return inContact ? "bearing" : "free";
}

const asSaid = (name) => name.replace(/^(fadir|faber)$/, (short) => short.toUpperCase()).replaceAll("_", " ").replace(/ at (\d+) /, " at $1° ");

/// Every way in which what is read of a pose contradicts the rule; `motions` are the joint's limits as it is.
function contradictions(said, motions, names) {
  const { angles, free, chip, chipText, answer, readouts, exit, sentence, current, currentResults, results } = said, rule = ruleOf(said), wrong = [];
  if (chip !== rule) wrong.push(`chip ${chip} (${chipText}), rule ${rule}`);
  if (answer.startsWith("In contact") !== said.inContact) wrong.push(`answer ${answer}`);
  readouts.forEach((readout, i) => {
    const isFree = free[i].some(([low, high]) => low - near_deg <= angles[i] && angles[i] <= high + near_deg);
    if (readout.startsWith("free ") !== isFree) wrong.push(`${names[i]}: ${readout}, intervals ${JSON.stringify(free[i])}`);
  });
  if (exit !== (rule === "contact" && free.some((intervals) => intervals.length > 0))) wrong.push(`way out ${exit} in state ${rule}`);
  const here = motions.filter(({ reason, vary, start_deg, end_deg }) => reason === "contact" && rule === "limit" &&
    names.every((name, i) => Math.abs(angles[i] - (name === vary ? end_deg : start_deg[name])) <= (name === vary ? near_deg : 1e-9)));
  const ending = motions.filter(({ reason, vary, start_deg, end_deg }) => reason === "end_of_range" && names.every((name, i) =>
    Math.abs(angles[i] - (name === vary ? end_deg : start_deg[name])) <= (name === vary ? near_deg : 1e-9)));
  if (current.length > 1) wrong.push(`tiles ${current.join(" and ")} are marked`);
  if (here.length && !here.some(({ name }) => asSaid(name) === current[0])) wrong.push(`tile ${current[0]} at the end of ${here[0].name}`);
  if (current.length && ![...here, ...ending].some(({ name }) => asSaid(name) === current[0])) wrong.push(`tile ${current[0]} at no end`);
  if (current.length && !sentence.replace("Planned: ", "").toLowerCase().startsWith(current[0].toLowerCase())) wrong.push(`tile ${current[0]}, sentence ${sentence}`);
  if (current.length && results.includes(current[0]) && currentResults[0] !== current[0]) wrong.push(`tile ${current[0]}, figure ${currentResults[0]}`);
  if (!current.length && currentResults.length) wrong.push(`figure ${currentResults[0]} is marked, no tile is`);
  return wrong.map((each) => `${angles.join(" ")}: ${each}`);
}

/// Limits of the motions as the core has them now.
async function limitsNow(page, { rom, coordinates }) {
  const names = coordinates.map(({ name }) => name);
  return Promise.all(rom.motions.filter(({ reason }) => reason !== "contact_at_start").map(async ({ name, vary, sense, start_deg, range_deg, band, limit_deg }) => {
    const question = { start: names.map((each) => start_deg[each] ?? 0), vary: names.indexOf(vary), positive: sense === "positive", range_deg };
    const { turned_deg, reason } = await page.evaluate((limit) => condyle.query({ of: "limit", limit }), question);
    return { name, vary, start_deg, reason, limit_deg: turned_deg, isAsBefore: turned_deg === limit_deg, band, end_deg: (start_deg[vary] ?? 0) + (sense === "positive" ? 1 : -1) * turned_deg };
  }));
}

/// Tiles have these limits.
async function tilesWrong(page, motions) {
  const tiles = await page.locator(".tile").evaluateAll((all) => Object.fromEntries(all.map((each) => [each.querySelector(".tile-name").textContent, each.querySelector("b").textContent])));
  return motions.flatMap(({ name, limit_deg, reason }) => {
    const said = reason === "end_of_range" ? `>${Number(limit_deg.toFixed(1))}°` : `${limit_deg.toFixed(1)}°`, tile = tiles[asSaid(name)];
    return tile.endsWith(said) ? [] : [`tile of ${name}: ${tile}, limit ${said}`];
  });
}

for (const [number, joint] of joints.entries())
  test(`chip, sliders, tiles and sentence of ${joint} contradict the limits' rule in no random state`, async (t) => {
    const { text } = readReport(pathOf(joint)), names = text.coordinates.map(({ name }) => name), random = randomFrom(60 + number);
    const count = Math.ceil(states / joints.length), between = (low, high) => low + random() * (high - low), oneOf = (list) => list[Math.floor(random() * list.length)];
    let { page } = await openPage(browser, pathOf(joint), { reducedMotion: "reduce" });
    await settled(page);
    let motions = await limitsNow(page, text);
    const wrong = await tilesWrong(page, motions);
    const poseOf = ({ vary, start_deg, end_deg }, by = 0) => Object.fromEntries(names.map((name) => [name, name === vary ? end_deg + by : (start_deg[name] ?? 0)]));
    const anywhere = () => ({ flexion: between(-40, 130), adduction: between(-50, 40), internal_rotation: between(-60, 60) });
    const goTo = (pose) => page.evaluate((hash) => (location.hash = hash), `#${new URLSearchParams(Object.entries(pose).filter(([, deg]) => deg !== 0))}`);
    const ways = {
      rest: () => page.keyboard.press("0"),
      linked: () => goTo(anywhere()),
      typed: () => type(page.locator("#panel-motion .slider input[role=spinbutton]").nth(Math.floor(random() * 3)), between(-50, 60).toFixed(1)),
      pressed: () => page.locator(".tile").nth(Math.floor(random() * motions.length)).click(),
      atEnd: () => goTo(poseOf(oneOf(motions))),
      besideEnd: () => goTo(poseOf(oneOf(motions), oneOf([-0.5, -0.06, -0.04, 0.04, 0.06, 0.5]))),
      undone: () => page.keyboard.press("u"),
    };
    const reopened = async () => {
      const fragment = await page.evaluate(() => location.hash);
      await page.context().close();
      ({ page } = await openPage(browser, pathOf(joint), { fragment, reducedMotion: "reduce" }));
    };
    // Bone that a brush may take, in the last third of the states.
    const canBrush = await page.locator("summary", { hasText: "Resect by brush" }).count() > 0;
    for (let i = 0; i < count; ++i) {
      if (canBrush && i === Math.floor((2 * count) / 3)) {
        await openTab(page, "Plan");
        const region = page.getByRole("region", { name: "Resect by brush", exact: true });
        if (!(await region.isVisible())) await page.locator("summary", { hasText: "Resect by brush" }).click();
        await page.getByRole("button", { name: "Brush where it ends" }).click();
        await page.waitForFunction((element) => element.dataset.allAfter !== undefined && !document.body.classList.contains("limits-wait"), await region.elementHandle());
        await openTab(page, "Motion");
        motions = await limitsNow(page, text);
        wrong.push(...(await tilesWrong(page, motions)));
      }
      const way = i % 29 === 13 && !(canBrush && i > (2 * count) / 3) ? "reopened" : oneOf(Object.keys(ways));
      await (way === "reopened" ? reopened() : ways[way]());
      await page.evaluate(() => document.activeElement?.blur());
      await settled(page);
      wrong.push(...contradictions(await stateOf(page), motions, names).map((each) => `${way}: ${each}`));
    }
    t.diagnostic(`${count} states, ${wrong.length} contradictions`);
    assert.deepEqual(wrong, []);
    await page.context().close();
  });
