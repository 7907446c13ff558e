// Times what the page of a report asks of its worker, in a real browser: node bench/page_speed.mjs REPORT.html
// Told are the median and the 99th percentile of milliseconds from question to answer, worker round trip included.
import { resolve } from "node:path";
import { launchedBrowser, openPage, settled } from "../tests/viewer/browser.mjs";

const browser = await launchedBrowser();
try {
  const { page, firstAnswer_ms } = await openPage(browser, resolve(process.argv[2]));
  await settled(page);
  // The bearing surface is looked for after the first answer.
  await page.evaluate(() => condyle.query({ of: "limit", limit: { start: [0, 0, 0], vary: 0, positive: true, range_deg: 120 } }));
  const times = await page.evaluate(async () => {
    const timed = async (count, question) => {
      const taken = [];
      for (let i = 0; i < count; ++i) {
        const query = question(i), begun = performance.now();
        await condyle.query(query);
        taken.push(performance.now() - begun);
      }
      taken.sort((a, b) => a - b);
      return [taken[count >> 1], taken[Math.floor(0.99 * count)]];
    };
    const held = [0, 20, 40, 60, 80, 100];
    return {
      "a pose: both bodies' vertices inside, contact, pairs": await timed(1000, (i) =>
        ({ of: "pose", at: { angles: [i % 120, (i % 40) - 20, (i % 60) - 30], translation: [0, 0, 0] } })),
      "gap of every vertex of both bodies": await timed(200, (i) =>
        ({ of: "values", at: { angles: [i % 120, (i % 40) - 20, (i % 60) - 30], translation: [0, 0, 0] }, quantity: "gap" })),
      "depth of every vertex of both bodies": await timed(200, (i) =>
        ({ of: "values", at: { angles: [i % 120, (i % 40) - 20, (i % 60) - 30], translation: [0, 0, 0] }, quantity: "depth" })),
      "a limit": await timed(300, (i) =>
        ({ of: "limit", limit: { start: [i % 90, 0, 0], vary: i % 3, positive: i % 2 === 0, range_deg: 120 } })),
      "all free angles at a point of a map": await timed(60, (i) => ({
        of: "mapPoint", point: i % held.length, question: { columnAngle: 0, rowAngle: 1, vary: 2, columns: held, rows: [0] },
      })),
    };
  });
  console.log(`first answer after ${firstAnswer_ms.toFixed(0)} ms`);
  for (const [what, [median, most]] of Object.entries(times)) console.log(`${what}: ${median.toFixed(2)} ms, ${most.toFixed(2)} ms`);
} finally {
  await browser.close();
}
