// Work by hand in the scene: turn, move and zoom by mouse and fingers, point and measure, see through, mark, colour.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { isFemur, isHipBone, keep, openPage, pathOf, pixels, plain, region, settled, sharedBrowser, turnTo, viewOptions } from "./browser.mjs";
import { readReport } from "./report_block.mjs";

const browser = await sharedBrowser();

/// Position of the camera and what it looks at, once the address has changed from `before`.
async function camera(page, before = "") {
  await page.waitForFunction((was) => location.hash.includes("camera=") && location.hash !== was, before);
  const numbers = new URLSearchParams(new URL(page.url()).hash.slice(1)).get("camera").split(",").map(Number);
  return { hash: new URL(page.url()).hash, position: numbers.slice(0, 3), target: numbers.slice(3) };
}
const minus = (a, b) => a.map((value, k) => value - b[k]);
const length = (a) => Math.hypot(...a);

test("a mouse turns, moves and zooms", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  const box = await page.locator("#scene > canvas").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const drag = async (button, dx, dy) => {
    await page.mouse.move(x, y);
    await page.mouse.down({ button });
    for (let i = 1; i <= 5; ++i) await page.mouse.move(x + (i * dx) / 5, y + (i * dy) / 5);
    await page.mouse.up({ button });
  };
  const first = await camera(page);
  await drag("left", 120, 0);
  const turned = await camera(page, first.hash);
  assert.ok(length(minus(turned.target, first.target)) < 0.2, "looks at the same point");
  const [from, to] = [first, turned].map(({ position, target }) => minus(position, target));
  assert.ok(Math.abs(length(to) - length(from)) < 0.5, "from as far");
  const angle = Math.acos(from.reduce((sum, value, k) => sum + value * to[k], 0) / length(from) / length(to));
  assert.ok(angle > 0.3 && angle < 2.5, `${angle} radians`);
  await drag("right", 0, 80);
  const moved = await camera(page, turned.hash);
  assert.ok(moved.target[1] - turned.target[1] > 5, "what is dragged down comes from above");
  assert.ok(length(minus(minus(moved.position, moved.target), to)) < 0.5, "in the same direction");
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, -400);
  const near = await camera(page, moved.hash);
  assert.ok(length(minus(near.position, near.target)) < 0.95 * length(to), "nearer");
  await page.context().close();
});

test("two fingers zoom", async () => {
  const { page } = await openPage(browser, pathOf("sample"), { width: 390, height: 844, isMobile: true, hasTouch: true });
  await settled(page);
  await page.locator("#scene").scrollIntoViewIfNeeded();
  const before = await camera(page);
  const box = await page.locator("#scene > canvas").boundingBox();
  const client = await page.context().newCDPSession(page);
  const touch = (type, apart) => client.send("Input.dispatchTouchEvent", {
    type, touchPoints: type === "touchEnd" ? []
      : [-1, 1].map((side, id) => ({ x: box.x + box.width / 2 + side * apart, y: box.y + box.height / 2, id })),
  });
  await touch("touchStart", 30);
  for (let apart = 40; apart <= 120; apart += 10) await touch("touchMove", apart);
  await touch("touchEnd");
  const after = await camera(page, before.hash);
  const distance = ({ position, target }) => length(minus(position, target));
  assert.ok(distance(after) < 0.5 * distance(before), `${distance(before)} became ${distance(after)}`);
  await page.context().close();
});

test("a cut leaves nothing beyond its plane", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  await page.getByLabel("Without perspective").check();
  await settled(page);
  const whole = await pixels(page);
  await page.getByLabel("Cut away").selectOption("y");
  await page.getByRole("slider", { name: "Cut at" }).fill("-40");
  await settled(page);
  const cut = await pixels(page);
  await keep(page, "clipped");
  // From the front, heights are rows: that of the plane follows from the camera, which looks at the middle of the picture.
  const { position, target } = await camera(page);
  const perPixel = (2 * length(minus(position, target)) * Math.tan((15 * Math.PI) / 180)) / whole.height;
  const row = whole.height / 2 - (-40 - target[1]) / perPixel;
  const margin = 3;
  const rows = ({ width, height, at }, is) => Array.from({ length: height }, (_, y) => {
    let count = 0;
    for (let x = 0; x < width - 150; ++x) count += at(x, y)[3] === 255 && is(...at(x, y));
    return count;
  });
  const isBone = (...colour) => isHipBone(...colour) || isFemur(...colour);
  const above = (picture) => rows(picture, isBone).slice(0, Math.floor(row - margin)).reduce((sum, count) => sum + count, 0);
  const below = (picture) => rows(picture, isFemur).slice(Math.ceil(row + margin)).reduce((sum, count) => sum + count, 0);
  assert.ok(above(whole) > 5000);
  assert.equal(above(cut), 0);
  assert.ok(below(cut) > 0.99 * below(whole) && below(whole) > 1000, `${below(cut)} of ${below(whole)}`);
  await page.context().close();
});

test("what is before is seen through", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  await page.getByRole("button", { name: "left", exact: true }).click();
  await settled(page);
  // From the medial side the socket hides the head.
  const opaque = region(await pixels(page), isFemur).count;
  await page.getByRole("slider", { name: "Opacity of hip bone" }).fill("0.2");
  await settled(page);
  await keep(page, "transparent");
  const through = region(await pixels(page), (r, g, b) => b > r).count;
  assert.ok(through > 1.1 * opaque, `${opaque} became ${through}`);
  await page.context().close();
});

test("triangles in contact are violet, the bearing surface green, and neither where it is not asked for", async () => {
  const { page } = await openPage(browser, pathOf("scenario_3"));
  await viewOptions(page);
  await page.getByLabel("Colour", { exact: true }).selectOption("none");
  await page.getByLabel("Show hip bone").uncheck();
  await page.getByLabel("Shading").uncheck();
  const isMarked = (r, g, b) => r > g + 40 && b > r + 40, isGreen = (r, g, b) => g > r + 15 && g > b;
  const count = async (is) => region(await pixels(page), is).count;
  await settled(page);
  assert.equal(await count(isMarked), 0);
  assert.equal(await count(isGreen), 0);
  await turnTo(page, { flexion: 110, adduction: 20, internal_rotation: 40 });
  await page.getByRole("button", { name: "front", exact: true }).click();
  await settled(page);
  await keep(page, "contact");
  assert.ok((await count(isMarked)) > 50, `${await count(isMarked)} pixels in contact`);
  await page.getByLabel("Mark triangles in contact").uncheck();
  await settled(page);
  assert.equal(await count(isMarked), 0);
  await page.getByLabel("Mark the bearing surface").check();
  await settled(page);
  await keep(page, "bearing");
  assert.ok((await count(isGreen)) > 200, `${await count(isGreen)} pixels of the bearing surface`);
  await page.context().close();
});

test("meshes of a body are distinguished by their colour", async () => {
  const { page } = await openPage(browser, pathOf("parts"));
  await plain(page);
  await page.getByLabel("Show hip bone").uncheck();
  await page.getByLabel("Shading").uncheck();
  await settled(page);
  const seen = await pixels(page);
  await keep(page, "parts");
  const [bone, cartilage] = [[192, 205, 219], [143, 169, 198]].map((wanted) =>
    region(seen, (...colour) => colour.every((value, k) => Math.abs(value - wanted[k]) <= 2)));
  assert.ok(bone.count > 1000 && cartilage.count > 200, `${bone.count} and ${cartilage.count}`);
  assert.ok(cartilage.y < bone.y, "the cartilage is on the head, above");
  await page.context().close();
});

/// Value of a vertex with the joint at zero, from the report's own arrays.
function vertexOf(name, body, vertex) {
  const coordinates = readReport(pathOf(name)).array(`${body}_vertices`);
  return [0, 1, 2].map((k) => coordinates[3 * vertex + k]);
}

test("a vertex is asked for by its number, and two of them measured", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await settled(page);
  await viewOptions(page);
  await page.evaluate(() => condyle.query({ of: "values", at: { angles: [0, 0, 0], translation: [0, 0, 0] }, quantity: "gap" }));
  const body = page.getByLabel("Vertex of"), number = page.getByRole("spinbutton", { name: "Number of a vertex" });
  const choose = page.getByRole("button", { name: "Show vertex", exact: true }), hoverText = () => page.locator("#hover").textContent();
  const { shown, marks } = await page.evaluate(async () => {
    const { mobile } = await condyle.query({ of: "values", at: { angles: [0, 0, 0], translation: [0, 0, 0] }, quantity: "gap" });
    return { shown: Array.from(mobile.shown), marks: Array.from(mobile.marks) };
  });
  const vertex = marks.indexOf(1);
  await number.fill(String(vertex));
  await choose.click();
  assert.equal((await hoverText()).replace("\u2212", "-"), `femur, vertex ${vertex}: ${shown[vertex].toFixed(2)} mm`);
  await number.fill("100000");
  await number.press("Enter");
  assert.equal(await hoverText(), `femur has vertices 0 to ${shown.length - 1}`);
  await page.getByLabel("Measure between two points").check();
  await number.fill("10");
  await number.press("Enter");
  await body.selectOption("fixed");
  await number.fill("20");
  await number.press("Enter");
  const distance = length(minus(vertexOf("sample", "mobile", 10), vertexOf("sample", "fixed", 20)));
  assert.equal(await hoverText(), `Distance ${distance.toFixed(2)} mm`);
  await page.context().close();
});

test("two picked points have the distance of their vertices", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  await viewOptions(page, false);
  await settled(page);
  const box = await page.locator("#scene > canvas").boundingBox();
  const femur = region(await pixels(page), isFemur), hip = region(await pixels(page), isHipBone);
  const places = [femur, { x: hip.x, y: hip.y - 0.1 }].map(({ x, y }) => [box.x + x * box.width, box.y + y * box.height].map(Math.round));
  const vertices = [];
  for (const [i, place] of places.entries()) {
    await page.mouse.click(...place);
    const [, name, vertex] = /^(.*), vertex (\d+):/.exec(await page.locator("#hover").textContent());
    assert.equal(name, ["femur", "hip bone"][i]);
    vertices.push(vertexOf("sample", ["mobile", "fixed"][i], Number(vertex)));
  }
  await viewOptions(page);
  await page.getByLabel("Measure between two points").check();
  await viewOptions(page, false);
  for (const place of places) await page.mouse.click(...place);
  assert.equal(await page.locator("#hover").textContent(), `Distance ${length(minus(...vertices)).toFixed(2)} mm`);
  await page.context().close();
});

test("saved surfaces are the bones where they stand, in metres", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await turnTo(page, { flexion: 30 });
  await viewOptions(page);
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save surfaces, GLB" }).click()]);
  assert.match(download.suggestedFilename(), /\.glb$/);
  const bytes = readFileSync(await download.path());
  assert.equal(bytes.toString("latin1", 0, 4), "glTF");
  const { nodes, meshes, accessors } = JSON.parse(bytes.toString("utf8", 20, 20 + bytes.readUInt32LE(12)));
  const { array } = readReport(pathOf("sample")), pose = await page.evaluate(() => condyle.scene.bodies.mobile.mesh.matrix.toArray());
  for (const body of ["fixed", "mobile"]) {
    const node = nodes.find(({ name }) => name === body), { POSITION, COLOR_0 } = meshes[node.mesh].primitives[0].attributes;
    assert.equal(accessors[POSITION].count, array(`${body}_vertices`).length / 3);
    assert.equal(accessors[COLOR_0].count, accessors[POSITION].count);
    if (body === "mobile") assert.deepEqual(node.matrix.map((x) => x.toFixed(9)), pose.map((x) => x.toFixed(9)));
  }
  assert.deepEqual(nodes.find(({ name }) => name === "joint").matrix.slice(0, 1), [0.001]);
  await page.context().close();
});
