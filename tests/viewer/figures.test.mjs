// The figures of the page: what they draw and say, against the numbers of the report.
import assert from "node:assert/strict";
import { test } from "node:test";
import { has, keep, openPage, pathOf, settled, sharedBrowser } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const textOf = (name) => readReport(pathOf(name)).text;

test("strips mark contacts and bands, and nothing where only the range ends", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  await page.waitForFunction(() => [...document.querySelectorAll(".told")].every(({ textContent }) => textContent !== ""));
  const { coordinates, rom } = textOf("sample");
  const strips = await page.evaluate(() => [...document.querySelectorAll(".strip")].map((strip) => {
    const marks = (kind) => [...strip.querySelectorAll(`.${kind}`)].map((rect) => {
      const x = Number(rect.getAttribute("x"));
      return [x, x + Number(rect.getAttribute("width"))];
    });
    const input = strip.previousElementSibling;
    return { low: Number(input.min), high: Number(input.max), limits: marks("limit"), bands: marks("band"), free: marks("free") };
  }));
  let ended = 0;
  coordinates.forEach(({ name }, i) => {
    const { low, high, limits, bands, free } = strips[i];
    const x = (deg) => (400 * (Math.min(high, Math.max(low, deg)) - low)) / (high - low);
    const motions = rom.motions.filter(({ vary, start_deg }) => vary === name && Object.values(start_deg).every((start) => start === 0));
    const sign = ({ sense }) => (sense === "positive" ? 1 : -1);
    const near = (found, wanted) => {
      assert.equal(found.length, wanted.length, name);
      found.forEach((ends, k) => ends.forEach((end, m) => assert.ok(Math.abs(end - wanted[k][m]) < 1e-6, `${name}: ${end} and not ${wanted[k][m]}`)));
    };
    const met = motions.filter(({ reason }) => reason === "contact");
    near(limits, met.map((motion) => [x(sign(motion) * motion.limit_deg) - 1, x(sign(motion) * motion.limit_deg) + 1]));
    near(bands, met.map((motion) => {
      const ends = [motion.band.p5_deg, motion.band.p95_deg].map((end) => x(sign(motion) * end)).sort((a, b) => a - b);
      return [ends[0], Math.max(ends[1], ends[0] + 1)];
    }));
    ended += motions.length - met.length;
    assert.equal(free.length, 1);
  });
  assert.equal(ended, 1, "internal rotation goes on to the end of its range");
  await page.context().close();
});

test("how far an angle is free from here is what the core says of this pose", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#flexion=40&adduction=10" });
  await settled(page);
  await page.waitForFunction(() => [...document.querySelectorAll(".told")].every(({ textContent }) => textContent !== ""));
  const told = await page.locator(".told").allTextContents();
  const start = [40, 10, 0];
  for (const [vary, name] of ["flexion", "adduction", "internal rotation"].entries()) {
    const ends = [];
    for (const positive of [false, true]) {
      const limit = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), { start, vary, positive, range_deg: 180 });
      ends.push(`${(start[vary] + (positive ? 1 : -1) * limit.turned_deg).toFixed(1)}° (${limit.reason.replaceAll("_", " ")})`);
    }
    assert.equal(told[vary], `${name} is free from ${ends[0]} to ${ends[1]} from here`);
  }
  await page.context().close();
});
