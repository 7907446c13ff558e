// Limits of a page against those of the command.
import assert from "node:assert/strict";

/// The page of dropped files computes the limits of `condyle rom --json`.
export async function assertCommandLimits(page, motions) {
  for (const motion of motions) {
    const limit = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), {
      start: Object.values(motion.start_deg), vary: Object.keys(motion.start_deg).indexOf(motion.vary),
      positive: motion.sense === "positive", range_deg: motion.range_deg,
    });
    assert.equal(limit.turned_deg, motion.limit_deg, motion.name);
    assert.equal(limit.reason, motion.reason, motion.name);
  }
}
