// Times what the page of a report asks of its worker, in a real browser: node bench/page_speed.mjs REPORT.html
// It reports the median and the 99th percentile of milliseconds from question to answer, worker round trip included, and first
// the time of an empty question. Browsers' clocks have a tenth of a millisecond: short questions are sent several at once.
import { resolve } from "node:path";
import { launchedBrowser, openPage, settled } from "../tests/viewer/browser.mjs";
import { readReport } from "../tests/viewer/report_block.mjs";

const path = resolve(process.argv[2]);
const { coordinates, rom } = readReport(path).text;
const names = coordinates.map(({ name }) => name);
const limits = rom.motions.map(({ start_deg, vary, sense, range_deg }) => ({
  start: names.map((name) => start_deg[name]), vary: names.indexOf(vary), positive: sense === "positive", range_deg,
}));

const browser = await launchedBrowser();
try {
  const { page, firstAnswer_ms } = await openPage(browser, path);
  await settled(page);
  // The bearing surface is looked for after the first answer.
  await page.evaluate((limit) => condyle.query({ of: "limit", limit }), limits[0]);
  const times = await page.evaluate(async (motions) => {
    const spread = (taken) => {
      taken.sort((a, b) => a - b);
      return [taken[taken.length >> 1], taken[Math.floor(0.99 * taken.length)]];
    };
    /// `together` questions at once, each time; one of them takes its share.
    const timed = async (times, together, question) => {
      const taken = [];
      for (let i = 0; i < times; ++i) {
        const queries = Array.from({ length: together }, (_, k) => question(i * together + k)), begun = performance.now();
        await Promise.all(queries.map((query) => condyle.query(query)));
        taken.push((performance.now() - begun) / together);
      }
      return spread(taken);
    };
    const mean = (i) => ({ angles: [i % 120, (i % 40) - 20, (i % 60) - 30], translation: [0, 0, 0] });
    const deep = (i) => ({ angles: [100 + (i % 11), 15, 30 + (i % 10)], translation: [0, 0, 0] });
    const slider = document.getElementById("angle-flexion");
    const steps = [];
    for (let i = 0; i < 200; ++i) {
      const begun = performance.now();
      slider.value = String(i % 100);
      slider.dispatchEvent(new Event("input"));
      // Answered after the pose, its colours and its limits.
      await condyle.query({ of: "memory" });
      steps.push(performance.now() - begun);
    }
    const held = [0, 20, 40, 60, 80, 100];
    return {
      "an empty question": await timed(200, 20, () => ({ of: "memory" })),
      "an empty question, one at a time": await timed(1000, 1, () => ({ of: "memory" })),
      "vertices inside of both bodies, mean poses": await timed(100, 20, (i) => ({ of: "penetrations", at: mean(i) })),
      "vertices inside of both bodies, deep poses": await timed(100, 20, (i) => ({ of: "penetrations", at: deep(i) })),
      "the same with contact and pairs, mean poses": await timed(100, 20, (i) => ({ of: "pose", at: mean(i) })),
      "the same with contact and pairs, deep poses": await timed(100, 20, (i) => ({ of: "pose", at: deep(i) })),
      "gap of every vertex of both bodies": await timed(200, 1, (i) => ({ of: "values", at: mean(i), quantity: "gap" })),
      "depth of every vertex of both bodies": await timed(200, 1, (i) => ({ of: "values", at: mean(i), quantity: "depth" })),
      "a limit from a pose": await timed(300, 1, (i) =>
        ({ of: "limit", limit: { start: [i % 90, 0, 0], vary: i % 3, positive: i % 2 === 0, range_deg: 120 } })),
      [`all ${motions.length} limits`]: (await timed(60, motions.length, (i) => ({ of: "limit", limit: motions[i % motions.length] })))
        .map((one) => one * motions.length),
      "all free angles at a point of a map": await timed(60, 1, (i) => ({
        of: "mapPoint", point: i % held.length, question: { columnAngle: 0, rowAngle: 1, vary: 2, columns: held, rows: [0] },
      })),
      "a step of a slider: pose, gap of every vertex, limits of the pose": spread(steps),
    };
  }, limits);
  console.log(`first answer after ${firstAnswer_ms.toFixed(0)} ms`);
  for (const [what, [median, most]] of Object.entries(times)) console.log(`${what}: ${median.toFixed(2)} ms, ${most.toFixed(2)} ms`);
} finally {
  await browser.close();
}
