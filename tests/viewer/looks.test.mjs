// The scene, pixel by pixel: bones where they should be, colours as the scale says, after slider, clip and hide.
import assert from "node:assert/strict";
import { test } from "node:test";
import { isFemur, isHipBone, keep, openPage, pathOf, pixels, plain, region, settled, sharedBrowser, turnTo, viewOptions } from "./browser.mjs";

const browser = await sharedBrowser();

test("bones stand where they should, from the front and from the right", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  const front = await pixels(page);
  const [hip, femur] = [region(front, isHipBone), region(front, isFemur)];
  assert.ok(hip.count > 5000 && femur.count > 5000, `${hip.count} and ${femur.count}`);
  assert.ok(hip.y < femur.y - 0.1, "the hip bone is above");
  assert.ok(hip.x > femur.x + 0.05, "a right femur is lateral: on the left of who looks from the front");
  await keep(page, "front");
  await page.getByRole("button", { name: "back", exact: true }).click();
  await settled(page);
  const back = await pixels(page);
  assert.ok(region(back, isHipBone).x < region(back, isFemur).x - 0.05, "and on the right from the back");
  await page.context().close();
});

test("flexion brings the femur up and forwards, seen from the right", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  await page.getByRole("button", { name: "right", exact: true }).click();
  await settled(page);
  const before = region(await pixels(page), isFemur);
  await turnTo(page, { flexion: 90 });
  const after = region(await pixels(page), isFemur);
  assert.ok(after.y < before.y - 0.05, `${before.y} to ${after.y}`);
  // Anterior is to the right of who looks from the subject's right side.
  assert.ok(after.x > before.x + 0.05, `${before.x} to ${after.x}`);
  await keep(page, "flexed_from_the_right");
  await page.context().close();
});

test("a hidden bone is not there, a clipped one in part", async () => {
  const { page } = await openPage(browser, pathOf("sample"));
  await plain(page);
  const whole = region(await pixels(page), isFemur);
  await page.getByLabel("Show femur").uncheck();
  await settled(page);
  assert.equal(region(await pixels(page), isFemur).count, 0);
  await page.getByLabel("Show femur").check();
  await page.getByLabel("Cut away").selectOption("y");
  await page.getByRole("slider", { name: "Cut at" }).fill("-40");
  await settled(page);
  const cut = await pixels(page);
  // Nearly all of the hip bone is above, and a part of the femur: shares that no other cut shows.
  assert.ok(region(cut, isHipBone).count < 0.35 * whole.count, `${region(cut, isHipBone).count} of ${whole.count}`);
  const left = region(cut, isFemur);
  assert.ok(left.count > 0 && left.count < 0.9 * whole.count, `${left.count} of ${whole.count}`);
  await keep(page, "clipped");
  await page.context().close();
});

for (const [what, angles] of [["at zero", {}], ["on a tilted pose", { flexion: 40, adduction: 15, internal_rotation: 20 }]])
  test(`colours are those of the scale ${what}`, async (t) => {
    const { page } = await openPage(browser, pathOf("scenario_3"));
    await turnTo(page, angles);
    await viewOptions(page);
    await page.getByLabel("Shading").uncheck();
    await page.getByLabel("Mark triangles in contact").uncheck();
    await page.getByLabel("Show femur").uncheck();
    await page.getByRole("button", { name: "right", exact: true }).click();
    const end = Number(await page.getByLabel("Scale to").inputValue());
    await viewOptions(page, false);
    await settled(page);
    await keep(page, "socket");
    const scale = await page.evaluate(() => {
      const canvas = document.querySelector(".scene-legend canvas.bar");
      const data = Array.from(canvas.getContext("2d").getImageData(0, 0, canvas.width, 1).data);
      return Array.from({ length: canvas.width }, (_, i) => data.slice(4 * i, 4 * i + 3));
    });
    const nearest = (colour) => {
      const distance = (other) => Math.hypot(...other.map((value, k) => value - colour[k]));
      const best = scale.reduce((found, other, i) => (distance(other) < distance(scale[found]) ? i : found), 0);
      return { mm: -end + (2 * end * best) / (scale.length - 1), off: distance(scale[best]) };
    };
    // At its end the scale fades into plain bone.
    const isOnScale = ({ mm, off }) => off < 3 && mm < 0.7 * end;
    const seen = await pixels(page);
    const box = await page.locator("#scene > canvas").boundingBox();
    const coloured = [];
    for (let row = 0; row < seen.height - 150; row += 3)
      for (let column = 0; column < seen.width; column += 3)
        if (seen.at(column, row)[3] === 255 && isOnScale(nearest(seen.at(column, row).slice(0, 3)))) coloured.push([column, row]);
    let compared = 0;
    for (let i = 0; i < 60; ++i) {
      const [column, row] = coloured[Math.floor(coloured.length * ((i * 0.618) % 1))];
      await page.mouse.move(box.x + ((column + 0.5) / seen.width) * box.width, box.y + ((row + 0.5) / seen.height) * box.height);
      await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
      const value = / (-?[\d.]+) mm$/.exec((await page.locator("#hover").textContent()).replace("\u2212", "-"));
      if (!value || Math.abs(Number(value[1])) > 0.8 * end) continue;
      const { mm } = nearest(seen.at(column, row).slice(0, 3));
      // The nearest corner of a triangle whose edges are a millimetre or two long, on a socket that opens by as much.
      assert.ok(Math.abs(mm - Number(value[1])) < 1.5, `${value[1]} mm is shown as ${mm} mm`);
      ++compared;
    }
    t.diagnostic(`${compared} pixels`);
    assert.ok(compared > 20, `${compared} pixels`);
    await page.context().close();
  });

test("depths that are only bounds are hatched grey, and never a colour of the scale", async (t) => {
  const { page } = await openPage(browser, pathOf("scenario_3"));
  await viewOptions(page);
  await page.getByLabel("Colour", { exact: true }).selectOption("depth");
  await turnTo(page, { flexion: 130, adduction: 40, internal_rotation: 90 });
  await page.getByLabel("Shading").uncheck();
  await page.getByLabel("Mark triangles in contact").uncheck();
  await page.getByLabel("Show hip bone").uncheck();
  await page.getByRole("button", { name: "left", exact: true }).click();
  await viewOptions(page, false);
  const box = await page.locator("#scene > canvas").boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await settled(page);
  await keep(page, "depths");
  const seen = await pixels(page);
  const isGrey = (r, g, b) => Math.abs(r - g) < 6 && Math.abs(g - b) < 6 && r < 200;
  const grey = region(seen, isGrey);
  t.diagnostic(`${grey.count} hatched pixels`);
  assert.ok(grey.count > 500, `${grey.count} hatched pixels`);
  const coloured = [];
  for (let row = 0; row < seen.height - 150; ++row)
    for (let column = 0; column < seen.width; ++column) {
      const [r, g, b, a] = seen.at(column, row);
      // The bone is bluish and never that deep a colour.
      if (a === 255 && (r > b + 20 || Math.max(r, g, b) < 110) && !isGrey(r, g, b)) coloured.push([column, row]);
    }
  t.diagnostic(`${coloured.length} coloured pixels`);
  assert.ok(coloured.length > 200, `${coloured.length} coloured pixels`);
  let values = 0;
  for (let i = 0; i < 150; ++i) {
    const [column, row] = coloured[Math.floor(coloured.length * ((i * 0.618) % 1))];
    await page.mouse.move(box.x + ((column + 0.5) / seen.width) * box.width, box.y + ((row + 0.5) / seen.height) * box.height);
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    const hover = await page.locator("#hover").textContent();
    assert.ok(!hover.includes("at least"), `${hover} is shown as a colour`);
    values += / mm$/.test(hover);
  }
  assert.ok(values > 100, `${values} values`);
  await page.context().close();
});
