// Thousands of steps of a slider: nothing grows. CONDYLE_LONG_TESTS=1 makes ten thousand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { openPage, pathOf, settled, sharedBrowser } from "./browser.mjs";

const browser = await sharedBrowser();

/// A step's colours are five bytes for each of some 32,000 vertices: 60 steps that kept theirs would be seen.
const slack_bytes = 10e6;
const counted = process.env.CONDYLE_LONG_TESTS ? 10000 : 2000;

test("thousands of steps with colours and limits leave memory as it was", async (t) => {
  const { page } = await openPage(browser, pathOf("scenario_3"));
  await settled(page);
  const client = await page.context().newCDPSession(page);
  const heap = async () => {
    await client.send("HeapProfiler.collectGarbage");
    const { usedSize, backingStorageSize } = await client.send("Runtime.getHeapUsage");
    return usedSize + backingStorageSize;
  };
  const steps = (first, count) => page.evaluate(async ([from, many]) => {
    for (let i = from; i < from + many; ++i) {
      const angles = [i % 120, (i % 40) - 20, (i % 60) - 30], at = { angles, translation: [0, 0, 0] };
      await condyle.query({ of: "pose", at });
      await condyle.query({ of: "values", at, quantity: i % 20 ? "depth" : "gap" });
      await condyle.query({ of: "limit", limit: { start: angles, vary: i % 3, positive: i % 2 === 0, range_deg: 120 } });
    }
    return condyle.query({ of: "memory" });
  }, [first, count]);
  /// As by hand, with everything that is drawn, reported and stored.
  const drags = (count) => page.evaluate(async (many) => {
    const slider = document.getElementById("angle-flexion");
    for (let i = 0; i < many; ++i) {
      slider.value = String(i % 100);
      slider.dispatchEvent(new Event("input"));
      await condyle.query({ of: "memory" });
    }
  }, count);
  await drags(100);
  const module = await steps(0, 500), heapBefore = await heap();
  const after = await steps(500, counted);
  await drags(200);
  const heapAfter = await heap();
  t.diagnostic(`module memory ${(module / 1e6).toFixed(1)} MB, after ${counted} more steps ${(after / 1e6).toFixed(1)} MB`);
  t.diagnostic(`heap of the page ${(heapBefore / 1e6).toFixed(1)} MB, after them ${(heapAfter / 1e6).toFixed(1)} MB`);
  assert.equal(after, module);
  assert.ok(heapAfter < heapBefore + slack_bytes, `${heapBefore} bytes became ${heapAfter}`);
  await page.context().close();
});
