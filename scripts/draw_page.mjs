// Makes docs/images/page.png and plan_page.png anew: pages of reports of sample hips, in a browser. Needs a release build and, in viewer/, npm ci.
// Usage: node scripts/draw_page.mjs
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { launchedBrowser, openPage, root, settled } from "../tests/viewer/browser.mjs";

const folder = join(root, "out/docs/page");
const condyle = (...words) => execFileSync(join(root, "build/release/condyle"), words, { stdio: "ignore" });
condyle("sample", "hip", "--scenario", "3", "--out", folder);
condyle("report", join(folder, "hip.toml"), "--band=20", "--out", join(folder, "report.html"));
const browser = await launchedBrowser();

/// By the commands of docs/planning.md.
async function drawPlan() {
  condyle("sample", "hip", "--alpha-angle", "70", "--out", folder);
  condyle("report", join(folder, "hip.toml"), "--measures", "--resect", "internal_rotation_at_90_flexion=45", "--out", join(folder, "plan.html"));
  const { page } = await openPage(browser, join(folder, "plan.html"), { width: 1440, height: 900, fragment: "#hidden=fixed" });
  await settled(page);
  await page.getByRole("tab", { name: "Plan", exact: true }).click();
  await settled(page);
  await page.screenshot({ path: join(root, "docs/images/plan_page.png") });
}
try {
  const { page } = await openPage(browser, join(folder, "report.html"), { width: 1440, height: 900, fragment: "#flexion=70&internal_rotation=20" });
  await settled(page);
  await page.waitForFunction(() => [...document.querySelectorAll(".slider-readout")].every(({ textContent }) => textContent !== ""));
  // The distance between the bones comes last.
  await page.getByText(/^Free · .* mm, /).waitFor();
  await page.screenshot({ path: join(root, "docs/images/page.png") });
  await drawPlan();
} finally {
  await browser.close();
}
