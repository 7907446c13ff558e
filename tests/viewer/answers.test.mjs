// Answers of the page in a browser, against the same functions compiled natively on the very joint of the report.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { bits, fromBits, readAnswers, writeScene } from "./answers.mjs";
import { openPage, pathOf, reports, root, sharedBrowser } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const poses = 1000;

/// Angles all over the range, and every other time a slip of a millimetre.
function questions() {
  const all = new Float64Array(6 * poses);
  for (let i = 0; i < poses; ++i) {
    const slip = i % 2;
    all.set([((37 * i) % 1800) / 10 - 30, ((53 * i) % 1200) / 10 - 60, ((71 * i) % 1200) / 10 - 60,
      slip * Math.sin(i), slip * Math.sin(2 * i), slip * Math.sin(3 * i)], 6 * i);
  }
  return all;
}

/// The native answers to the report's joint.
function nativeAnswers(name) {
  const { array } = readReport(pathOf(name));
  const folder = join(reports, "answers");
  mkdirSync(folder, { recursive: true });
  writeScene(join(folder, "scene.bin"), {
    fixed: array("fixed_vertices"), mobile: array("mobile_vertices"), questions: questions(), fixedTriangles: array("fixed_triangles"),
    mobileTriangles: array("mobile_triangles"),
  });
  execFileSync(join(root, "build/release/page_core_answers"), [folder]);
  return readAnswers(join(folder, "answers.txt"));
}

const answers = nativeAnswers("sample");
const of = (kind) => answers.filter(([word]) => word === kind).map(([, ...fields]) => fields);

test("a thousand poses: the very bits of depths, the same vertices and pairs", async (t) => {
  const { page } = await openPage(browser, pathOf("sample"));
  const inPage = await page.evaluate(async ([matrices, bitsSource]) => {
    const bits = new Function(`return ${bitsSource}`)();
    const penetrations = ({ vertices, depths_mm }) =>
      [vertices.length, ...Array.from(vertices, (v, i) => `${v}:${bits(depths_mm[i])}`)].join(" ");
    const found = [];
    for (const X_FM of matrices) {
      const { mobileInFixed, fixedInMobile, inContact, pairs } = await condyle.query({ of: "poseMatrix", X_FM });
      found.push([penetrations(mobileInFixed), penetrations(fixedInMobile), inContact ? "1" : "0", Array.from(pairs).join(" ")]);
    }
    return found;
  }, [of("pose").map((fields) => fields.map(fromBits)), bits.toString()]);
  const native = ["mobile", "fixed", "contact", "pairs"].map((kind) => of(kind).map((fields) => fields.join(" ")));
  assert.equal(inPage.length, poses);
  inPage.forEach((found, i) => assert.deepEqual(found, native.map((lines) => lines[i]), `pose ${i}`));
  const inside = of("mobile").reduce((sum, [count]) => sum + Number(count), 0);
  t.diagnostic(`${inside} vertices inside`);
  assert.ok(inside > 1000);
  await page.context().close();
});

test("a map of ten degrees: the very bits of all free intervals", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const points = of("free");
  const inPage = await page.evaluate((places) => Promise.all(places.map(([flexion, adduction]) => condyle.query({
    of: "mapPoint", point: 0, question: { columnAngle: 0, rowAngle: 1, vary: 2, columns: [flexion], rows: [adduction] },
  }))), points.map(([flexion, adduction]) => [Number(flexion), Number(adduction)]));
  points.forEach(([flexion, adduction, ...native], i) => {
    assert.deepEqual(inPage[i].flat(), native.map(fromBits), `${flexion} ${adduction}`);
  });
  assert.equal(points.length, 120);
  await page.context().close();
});
