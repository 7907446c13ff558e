// Motion files dropped on a report's page: the frames of condyle report --motion, to the bit, and its lines for bad files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import { angleOf, drop, has, keep, openPage, openTab, pathOf, reports, root, settled, sharedBrowser } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();
const condyle = join(root, "build/release/condyle");
const folder = join(reports, "motions");
mkdirSync(folder, { recursive: true });
const run = (...words) => execFileSync(condyle, words, { stdio: ["ignore", "ignore", "pipe"] });

function written(name, text) {
  writeFileSync(join(folder, name), text);
  return join(folder, name);
}

async function opened(path) {
  const page = await openPage(browser, path, { width: 1440, height: 900, reducedMotion: "reduce" });
  await settled(page.page);
  return page;
}

const plays = (page, path) => page.getByRole("status").filter({ hasText: `The dropped file ${basename(path)} plays on this joint` }).waitFor();

/// The page's frames of a file, as the core reads it.
function framesOf(page, path, text) {
  return page.evaluate(({ name, base64, columns }) => condyle.query({ of: "motion", file: { name, bytes: Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)).buffer }, columns }),
    { name: basename(path), base64: readFileSync(path).toString("base64"), columns: text.recorded_motion ? JSON.stringify(text.recorded_motion) : "" });
}

/// Every number of the frames is that of a report which was made with the motion.
async function assertFrames(page, path, joint, text) {
  const made = join(folder, "made.html");
  run("report", joint, "--motion", path, "--out", made);
  const { text: with_motion, array } = readReport(made), { recorded } = with_motion, frames = await framesOf(page, path, text);
  const same = (numbers, name) => {
    const wanted = array(recorded[name]);
    assert.equal(numbers.length, wanted.length, name);
    numbers.forEach((number, i) => assert.ok(Object.is(number ?? NaN, wanted[i]), `${name}[${i}]: ${number} and ${wanted[i]}`));
  };
  assert.equal(frames.axis, recorded.axis);
  same(frames.times, "times_s");
  for (const name of ["coordinates_deg", "coordinates_mm", "poses"]) same(frames[name], name);
  return { recorded, array };
}

/// What the page shows in a frame.
async function assertShown(page, frame, { recorded, array }, coordinates) {
  await openTab(page, "Figures");
  await page.getByRole("slider", { name: "Frame", exact: true }).fill(String(frame));
  await settled(page);
  const degrees = array(recorded.coordinates_deg).slice(3 * frame, 3 * frame + 3);
  await openTab(page, "Motion");
  for (const [i, { name }] of coordinates.entries()) assert.equal(await angleOf(page, name), degrees[i]);
  const shown = await page.evaluate(() => condyle.scene.bodies.mobile.mesh.matrix.clone().transpose().toArray());
  const wanted = array(recorded.poses).slice(16 * frame, 16 * frame + 16);
  // The scene shows what the core makes of the angles, whose rounding is below what is seen.
  shown.forEach((number, i) => assert.ok(Math.abs(number - wanted[i]) < 1e-9));
}

test("a file whose columns the joint file maps plays with the numbers of condyle report --motion", async () => {
  const path = join(folder, "mapped.html"), motion = join(reports, "sample/moves.csv"), joint = join(reports, "sample/moves.toml");
  run("report", joint, "--out", path);
  const { page, complaints, requests } = await opened(path), { text } = readReport(path);
  assert.equal(await page.getByRole("tab", { name: "Figures" }).count(), 1);
  await openTab(page, "Details");
  await page.locator("#notes-of-user > summary").click();
  await page.getByLabel("Notes", { exact: true }).fill("kept");
  await drop(page, [motion]);
  await plays(page, motion);
  await settled(page);
  await keep(page, "motion_dropped");
  const made = await assertFrames(page, motion, joint, text);
  for (const frame of [0, 2, 1]) await assertShown(page, frame, made, text.coordinates);
  assert.equal(await page.locator("#user-notes").inputValue(), "kept");
  assert.deepEqual(await page.locator("#scene .scene-overlay").count(), 1);
  // Limits stay those of the report, and a second file takes the place of the first.
  assert.equal(await page.locator(".result").count(), 4);
  const gap = written("with_gap.csv", "time,flexion,adduction,rotation\n0,1,2,3\n0.5,,2,3\n1,30,-4,0.1\n");
  await drop(page, [gap]);
  await plays(page, gap);
  await assertFrames(page, gap, joint, text);
  assert.equal(await page.getByRole("slider", { name: "Frame", exact: true, includeHidden: true }).count(), 1);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, []);
  await page.context().close();
});

test("a file whose columns are named by the coordinates plays on any report", async () => {
  const joint = join(reports, "sample/hip.toml"), motion = written("named.csv", "flexion_deg,internal_rotation_rad\n0,0\n33.3,0.1\n90,-0.25\n");
  const { page, complaints } = await opened(pathOf("sample")), { text } = readReport(pathOf("sample"));
  await drop(page, [motion]);
  await plays(page, motion);
  // What was left open in the reading is said.
  assert.match(await page.getByRole("status").filter({ hasText: "named.csv" }).textContent(), /not recorded, held at 0: adduction/);
  const made = await assertFrames(page, motion, joint, text);
  await assertShown(page, 1, made, text.coordinates);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("a walk of OpenSim plays on a real hip, number by number", { skip: !has("walk") && "not made" }, async () => {
  const data = process.env.CONDYLE_DATA ?? join(root, "../shared/data"), motion = join(data, "motion_gait2354_walk/subject01_walk1_ik.mot");
  const path = join(folder, "walk.html"), joint = join(reports, "walk.toml");
  run("report", joint, "--out", path);
  const { page, complaints } = await opened(path);
  await drop(page, [motion]);
  await plays(page, motion);
  const { recorded } = await assertFrames(page, motion, joint, readReport(path).text);
  assert.equal(recorded.axis, "time_s");
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("bad motion files are refused with the command's line and the columns that there are; the report stays", async () => {
  const joint = join(reports, "sample/hip.toml"), { page, complaints } = await opened(pathOf("sample"));
  const bad = {
    "other.csv": ["time,hip_flexion_r\n0,1\n", "; its columns are time, hip_flexion_r"], "short.csv": ["time,flexion_deg\n0\n", ""], "empty.sto": ["", ""],
    "back.csv": ["time,flexion_deg\n1,1\n0,2\n", ""], "tabs.tsv": ["time\tflexion_deg\n0\t1\n", ""],
  };
  for (const [name, [content, more]] of Object.entries(bad)) {
    const path = written(name, content);
    let line = "";
    try {
      run("report", joint, "--motion", path, "--out", join(folder, "none.html"));
    } catch (error) {
      line = String(error.stderr).trim().split("\n").at(-1).replace("condyle: ", "").replaceAll(path, name);
    }
    assert.ok(line.startsWith(name), line);
    await drop(page, [path]);
    await page.waitForFunction((wanted) => [...document.querySelectorAll("[role=alert]")].some(({ textContent }) => textContent === wanted), line + more);
  }
  await drop(page, [join(reports, "sample/femur.ply"), join(reports, "sample/moves.csv")]);
  await page.getByText("This page shows a joint and reads a motion file for it").waitFor();
  assert.equal(await page.locator("#scene > canvas").count(), 1);
  assert.equal(await page.getByRole("slider", { name: "Frame", exact: true, includeHidden: true }).count(), 0);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("of a joint file with columns of poses, and where nothing can be computed, it says so", async () => {
  const motion = written("poses.csv", "time,flexion_deg\n0,1\n"), path = join(folder, "poses.html"), joint = join(reports, "sample/poses.toml");
  writeFileSync(joint, `${readFileSync(join(reports, "sample/hip.toml"), "utf8")}[recorded_motion]\nfixed_body = "a"\nmobile_body = "b"\nunits = "mm"\n`);
  run("report", joint, "--out", path);
  const { page } = await opened(path);
  await drop(page, [motion]);
  await page.getByText("poses.csv: [recorded_motion] of the joint file has columns of poses, which condyle report --motion reads and a page does not; its columns are time, flexion_deg").waitFor();
  await page.context().close();
  const still = await openPage(browser, pathOf("sample"), { script: "delete globalThis.WebAssembly", answers: false });
  await drop(still.page, [motion]);
  await still.page.getByText("poses.csv: this page cannot compute, and so reads no motion files.").waitFor();
  await still.page.context().close();
});
