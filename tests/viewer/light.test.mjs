// Light, colours and the camera of the scene: what makes bones readable, and a camera that does not lose the joint.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { isFemur, keep, openPage, pathOf, pixels, plain, region, settled, sharedBrowser, turnTo, viewOptions } from "./browser.mjs";

const browser = await sharedBrowser();

const openness = (page) => page.waitForFunction(() =>
  ["fixed", "mobile"].every((body) => condyle.scene.bodies[body].mesh.geometry.getAttribute("openness").array.some((open) => open < 255)));
const towards = (page) => page.evaluate(() => condyle.scene.camera.towards.toArray());
const angle_deg = (a, b) => (Math.acos(Math.min(1, a.reduce((sum, x, k) => sum + x * b[k], 0))) * 180) / Math.PI;
/// Longer than the rest after which the camera turns, and the turn.
const turned_ms = 1500;

test("less light falls into the socket than onto the outside of the hip bone, once the page has answered", async (t) => {
  const { page } = await openPage(browser, pathOf("sample"));
  await openness(page);
  const [socket, rest] = await page.evaluate(() => {
    const { mesh, surface } = condyle.scene.bodies.fixed, { array } = mesh.geometry.getAttribute("openness"), r = condyle.scene.jointRadius_mm;
    const near = [0, 0], far = [0, 0];
    for (let v = 0; v < array.length; ++v) {
      const sum = Math.hypot(...surface.vertices.subarray(3 * v, 3 * v + 3)) < 1.15 * r ? near : far;
      sum[0] += array[v] / 255;
      ++sum[1];
    }
    return [near, far].map(([sum, count]) => sum / count);
  });
  t.diagnostic(`socket ${socket.toFixed(2)}, elsewhere ${rest.toFixed(2)}`);
  // At the bottom of a hemisphere of radius r = 24 mm half of the light comes through its opening, and chords of 2 r cos(a) take the rest but for the
  // square of their share of 50 mm: 0.62. At its rim half of the sky is free: less is taken there.
  assert.ok(socket > 0.62 && socket < 0.9, `${socket}`);
  assert.ok(rest > socket + 0.1, `${rest}`);
  await keep(page, "light");
  await page.context().close();
});

test("the key light throws a shadow onto the joint, which only darkens", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  const drawn = async (castsShadow) => {
    await page.evaluate((on) => condyle.scene.drawNow(on), castsShadow);
    return pixels(page);
  };
  const [without, shaded] = [await drawn(false), await drawn(true)];
  let darker = 0, brighter = 0;
  for (let y = 0; y < shaded.height; ++y)
    for (let x = 0; x < shaded.width; ++x) {
      const by = without.at(x, y)[0] - shaded.at(x, y)[0];
      darker += by > 12;
      brighter += by < -2;
    }
  assert.ok(darker > 500, `${darker} pixels in the shadow`);
  assert.equal(brighter, 0);
  await page.context().close();
});

test("a cut shows the inside of a bone as one colour", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  await page.getByLabel("Show hip bone").uncheck();
  await page.getByLabel("Cut away").selectOption("y");
  await page.getByRole("slider", { name: "Cut at" }).fill("-40");
  await page.getByRole("button", { name: "above", exact: true }).click();
  await settled(page);
  await keep(page, "cut_from_above");
  const seen = await pixels(page), counts = new Map();
  for (let y = 0; y < seen.height; ++y)
    for (let x = 0; x < seen.width; ++x) {
      const [r, g, b, a] = seen.at(x, y), colour = (r << 16) | (g << 8) | b;
      if (a === 255) counts.set(colour, (counts.get(colour) ?? 0) + 1);
    }
  const all = [...counts.values()].reduce((sum, count) => sum + count, 0);
  // From above the cut covers the rest of the shaft, but for what is wider below.
  assert.ok(Math.max(...counts.values()) > 0.5 * all, `${Math.max(...counts.values())} of ${all}`);
  await page.context().close();
});

// -- colours ------------------------------------------------------------------------------------------------------------------------

/// Colours as the colour blind see them, of linear red, green and blue: Machado, Oliveira and Fernandes 2009, severity 1.
const eyes = {
  usual: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  deuteranopia: [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.01182, 0.04294, 0.968881],
  protanopia: [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
  tritanopia: [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.3039],
};

/// CIE 1976 L*, a*, b* under D65.
function labOf(rgb, eye) {
  const linear = rgb.map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
  const [r, g, b] = [0, 1, 2].map((row) => Math.min(1, Math.max(0, linear.reduce((sum, v, k) => sum + eyes[eye][3 * row + k] * v, 0))));
  const f = (t) => (t > 216 / 24389 ? Math.cbrt(t) : ((24389 / 27) * t + 16) / 116);
  const x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047), y = f(0.2126729 * r + 0.7151522 * g + 0.072175 * b);
  const z = f((0.0193339 * r + 0.119192 * g + 0.9503041 * b) / 1.08883);
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

test("contact stays apart from bone and from the clearance scale for all eyes", async (t) => {
  const { page } = await openPage(browser, pathOf("sample"));
  const { contact, bones, scale } = await page.evaluate(() => {
    const { bodies, scale: shown } = condyle.scene;
    const rgbOf = (colour) => (colour.isColor ? [16, 8, 0].map((by) => (colour.getHex() >> by) & 255) : colour.match(/[0-9.]+/g).slice(0, 3).map(Number));
    const hex = (css) => [1, 3, 5].map((i) => Number.parseInt(css.slice(i, i + 2), 16));
    const steps = Array.from({ length: 65 }, (_, i) => shown.low + ((shown.high - shown.low) * i) / 64);
    return {
      contact: rgbOf(bodies.fixed.mesh.material.shared.contactColour.value),
      bones: ["fixed", "mobile"].map((body) => rgbOf(bodies[body].mesh.material.color)),
      scale: steps.map((mm) => { const css = shown.colour(mm); return css.startsWith("#") ? hex(css) : rgbOf(css); }),
    };
  });
  const apart = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));
  const nearest = (others, eye) => Math.min(...others.map((other) => apart(labOf(contact, eye), labOf(other, eye))));
  const figures = Object.keys(eyes).map((eye) => [eye, nearest(bones, eye), nearest(scale, eye)]);
  for (const [eye, bone, colour] of figures) t.diagnostic(`${eye}: ${bone.toFixed(0)} from bone, ${colour.toFixed(0)} from the scale`);
  // Magenta is 21 from the scale with deuteranopia; two swatches side by side are told apart from 10 on, small ones from 20 or so.
  for (const [eye, bone, colour] of figures) assert.ok(Math.min(bone, colour) > 30, `${eye}: ${bone} and ${colour}`);
  await page.context().close();
});

test("clearance fades into plain bone at the end of its scale", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await viewOptions(page);
  await page.getByLabel("Shading").uncheck();
  await page.getByLabel("Show femur").uncheck();
  await page.getByLabel("Mark triangles in contact").uncheck();
  await page.getByRole("button", { name: "right", exact: true }).click();
  await settled(page);
  const seen = await pixels(page);
  const isNear = (colour) => (r, g, b) => Math.hypot(r - colour[0], g - colour[1], b - colour[2]) < 12;
  assert.ok(region(seen, isNear([52, 167, 194])).count > 50, "the middle of the scale is there");
  // The scale's own end: a step of 42 in green beside plain bone.
  assert.equal(region(seen, isNear([239, 249, 189])).count, 0);
  await page.context().close();
});

test("with depths the outer bone is glass", async () => {
  const { page } = await openPage(browser, pathOf("scenario_3"), { fragment: "#flexion=110&adduction=20&internal_rotation=40" });
  await viewOptions(page);
  const isGlass = () => page.evaluate(() => condyle.scene.bodies.fixed.mesh.material.transparent);
  assert.equal(await isGlass(), false);
  await page.getByLabel("Colour", { exact: true }).selectOption("depth");
  assert.equal(await isGlass(), true);
  await settled(page);
  await keep(page, "depth_through_glass");
  await page.getByLabel("Colour", { exact: true }).selectOption("gap");
  assert.equal(await isGlass(), false);
  await page.context().close();
});

// -- camera -------------------------------------------------------------------------------------------------------------------------

test("bone far from the joint that stands before it is a ghost, and none is without one", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { fragment: "#flexion=90&camera=215,0,64,0,0,0" });
  await plain(page);
  const ghostRadius = (mm) => page.evaluate((radius_mm) => {
    for (const { mesh } of Object.values(condyle.scene.bodies)) mesh.material.shared.ghostRadius.value = radius_mm;
    condyle.scene.renderer.render(condyle.scene.scene, condyle.scene.camera.drawing());
  }, mm);
  const seen = await pixels(page);
  await keep(page, "ghost");
  await ghostRadius(1e6);
  const solid = await pixels(page);
  const [x, y] = await page.evaluate(() => condyle.scene.project([0, 0, 0]));
  const radius_px = await page.evaluate(() => condyle.scene.project([0, condyle.scene.jointRadius_mm, 0])[1] - condyle.scene.project([0, 0, 0])[1]);
  let all = 0, open = 0;
  for (let dy = -Math.abs(radius_px); dy < Math.abs(radius_px); ++dy)
    for (let dx = -Math.abs(radius_px); dx < Math.abs(radius_px); ++dx) {
      const [column, row] = [Math.round(x + dx), Math.round(y + dy)];
      if (Math.hypot(dx, dy) > Math.abs(radius_px) || column < 0 || row < 0 || column >= seen.width || row >= seen.height) continue;
      ++all;
      open += seen.at(column, row).some((value, k) => Math.abs(value - solid.at(column, row)[k]) > 4);
    }
  assert.ok(open > 0.3 * all, `${open} of ${all} pixels of the joint are seen past the shaft`);
  await page.context().close();
});

test("at rest the camera turns along the motion to a joint that is hidden, and a camera that was placed stays", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  // Nothing turns while the head is seen.
  const first = await towards(page);
  await turnTo(page, { flexion: 10 });
  await page.waitForTimeout(turned_ms);
  assert.ok(angle_deg(await towards(page), first) < 0.1);
  await page.context().close();
  const hidden = "#flexion=120&adduction=30";
  const { page: flexed } = await openPage(browser, pathOf("sample"), { fragment: hidden });
  await settled(flexed);
  await flexed.waitForFunction((from) =>
    condyle.scene.camera.towards.toArray().some((x, k) => Math.abs(x - from[k]) > 0.05) && !condyle.scene.camera.isTurning, first);
  const turned = await towards(flexed), axis = await flexed.evaluate(() => {
    const m = condyle.scene.bodies.mobile.mesh.matrix.elements, [x, y, z] = [m[6] - m[9], m[8] - m[2], m[1] - m[4]], long = Math.hypot(x, y, z);
    return [x / long, y / long, z / long];
  });
  const along = (direction) => direction.reduce((sum, x, k) => sum + x * axis[k], 0);
  assert.ok(angle_deg(turned, first) > 5, `${angle_deg(turned, first)} degrees`);
  assert.ok(Math.abs(along(turned) - along(first)) < 0.01, "in the plane of the motion");
  await keep(flexed, "turned_to_the_joint");
  await flexed.context().close();
  for (const options of [{ fragment: `${hidden}&camera=224,0,0,0,0,0` }, { fragment: hidden, reducedMotion: "reduce" }]) {
    const { page: other } = await openPage(browser, pathOf("sample"), options);
    await settled(other);
    await other.waitForTimeout(turned_ms);
    assert.ok(angle_deg(await towards(other), first) < 0.1, JSON.stringify(options));
    await other.context().close();
  }
});

test("graphics that the browser takes away come back, with a line meanwhile", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  const before = region(await pixels(page), isFemur).count;
  await page.evaluate(() => {
    globalThis.lost = condyle.scene.canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
    globalThis.lost.loseContext();
  });
  const line = page.locator("#scene .scene-lost");
  await line.filter({ hasText: "graphics" }).waitFor();
  await page.evaluate(() => globalThis.lost.restoreContext());
  await line.filter({ hasNotText: "graphics" }).waitFor({ state: "attached" });
  await settled(page);
  const after = region(await pixels(page), isFemur).count;
  assert.ok(Math.abs(after - before) < 0.02 * before, `${before} became ${after}`);
  await page.context().close();
});

// -- pictures and first use ---------------------------------------------------------------------------------------------------------

test("a saved picture is 2400 pixels wide or more, and the scene stays as it was", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  const size = () => page.evaluate(() => [condyle.scene.canvas.width, condyle.scene.canvas.height]);
  const before = await size();
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Picture", exact: true }).click()]);
  const png = readFileSync(await download.path());
  assert.ok(png.readUInt32BE(16) >= 2400, `${png.readUInt32BE(16)} pixels`);
  assert.deepEqual(await size(), before);
  await page.context().close();
});

test("one hint says what to do first, until something is done", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  const hint = page.getByText("Drag the bones to turn them; press a figure");
  assert.equal(await hint.isVisible(), true);
  await page.locator("#scene > canvas").hover();
  assert.equal(await hint.count(), 1);
  await page.mouse.down();
  assert.equal(await hint.count(), 0);
  await page.context().close();
});
