// Five questions that somebody brings to a page, answered from what is seen on its first screen and after presses of what has a visible
// name, without scrolling; each answer against the command.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { asSaid, has, openPage, pathOf, reports, root, settled, sharedBrowser } from "./browser.mjs";

const browser = await sharedBrowser();
const condyle = join(root, "build/release/condyle"), data = join(root, "../shared/data");

/// Lines of text that can be read: in the window, and neither covered nor clipped. Text of one button or cell is one line.
function seenText(page) {
  return page.evaluate(() => {
    const lines = new Map(), walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const isSeen = (element, { left, top, width, height }) => {
      const at = document.elementFromPoint(left + width / 2, top + height / 2);
      return at !== null && (at === element || element.contains(at));
    };
    while (walker.nextNode()) {
      const node = walker.currentNode, element = node.parentElement;
      if (!node.data.trim() || !element.checkVisibility({ visibilityProperty: true })) continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      const rects = [...range.getClientRects()].filter(({ width, height }) => width > 0 && height > 0);
      if (rects.length === 0 || !rects.every((rect) => isSeen(element, rect))) continue;
      const line = element.closest("button, summary, p, td, th, label, h1, h2, li") ?? element;
      lines.set(line, [...(lines.get(line) ?? []), node.data.trim()]);
    }
    return [...lines.values()].map((words) => words.join(" ").replaceAll(/\s+/g, " "));
  });
}

/// Rows of a table as they are read: only rows of which every cell is seen.
async function seenRows(page) {
  const seen = new Set(await seenText(page));
  const rows = await page.locator("tr").evaluateAll((all) => all.filter((row) => row.checkVisibility()).map((row) => [...row.cells].map(({ innerText }) => innerText.trim())));
  return rows.filter((cells) => cells.every((cell) => cell === "" || seen.has(cell)));
}

/// Presses what a visible text names, where it stands in the window.
async function press(page, role, name) {
  const target = page.getByRole(role, { name, exact: true }), box = await target.boundingBox(), { width, height } = page.viewportSize();
  assert.ok((await seenText(page)).includes(name), `${name} is read`);
  assert.ok(box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height, `${name} is in the window`);
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
}

const clock = (hour) => `${Math.floor(Math.round(hour * 60) / 60) || 12}:${String(Math.round(hour * 60) % 60).padStart(2, "0")}`;

/// The motion that limits the joint, by the rule of docs/report.md: what lacks most of its clinical range, else internal rotation in flexion of a
/// hip and the first one that contact ends of a knee.
function limiting({ motions, anatomy }) {
  const lacks = ({ reason, limit_deg, normal_range_deg }) => (reason === "contact" && normal_range_deg !== null ? normal_range_deg - limit_deg : 0);
  const worst = [...motions].sort((a, b) => lacks(b) - lacks(a))[0];
  if (lacks(worst) > 0) return worst;
  return motions.find(({ name, reason }) => (anatomy === "hip" ? name === "internal_rotation_at_90_flexion" : reason === "contact"));
}

/// By their pages, what the command is asked of them.
const joints = {
  sample: ["sample/hip.toml", "--band=20"], shifted: ["sample/shifted.toml"], vhf_right: ["vhf_right.toml"], libhip_left: ["libhip_left.toml"],
  knee_bones: ["knee_bones.toml"],
};

for (const [name, asked] of Object.entries(joints))
  test(`five questions are answered from what is read on the page of ${name}`, { skip: !has(name) && "not made" }, async (t) => {
    const { page, complaints } = await openPage(browser, pathOf(name), { width: 1440, height: 900, reducedMotion: "reduce" });
    await settled(page);
    const rom = JSON.parse(execFileSync(condyle, ["rom", ...asked, "--json"], { cwd: reports, env: { CONDYLE_DATA: data, ...process.env }, stdio: ["ignore", "pipe", "ignore"] }));
    const { motions, zero, anatomy, held_translation_mm: held } = rom, isHip = anatomy === "hip", first = limiting(rom), seen = await seenText(page);
    const sentence = seen.find((line) => / ends at /.test(line));
    assert.ok(sentence, seen.join("\n"));
    t.diagnostic(sentence);

    // What limits this joint: a motion, and the parts that meet.
    const [, motion, limit, rest] = /^(.+) ends at ([\d.]+)°(.*)\.$/.exec(sentence);
    assert.equal(motion.toLowerCase(), asSaid(first.name).toLowerCase());
    assert.match(rest, isHip ? /, (neck on rim|femur on hip bone)\b/ : /, tibia on femur;/);
    // By how much, against normal, or where zero is that of a scan as the arc between the ends of opposite motions.
    assert.equal(limit, first.limit_deg.toFixed(1));
    const against = !isHip ? "no clinical range known" : !zero.is_neutral ? `no clinical range, as zero is ${zero.from === "as_given" ? "the pose of the scan" : "not known to be neutral"}` : first.normal_range_deg !== null && first.limit_deg < first.normal_range_deg
      ? `${(first.normal_range_deg - first.limit_deg).toFixed(0)}° short of the clinical ${first.normal_range_deg}°`
      : "no motion ends before its clinical range or the 27.9° of simulated healthy hips";
    assert.ok(rest.endsWith(`; ${against}`), rest);
    // A motion that goes farther than the clinical range is not judged by it; its tile has living hips, in grey.
    const beyond = motions.find(({ name: each, normal_range_deg, limit_deg, reason }) => each === "flexion" && reason === "contact" && normal_range_deg !== null && limit_deg > normal_range_deg);
    // Where: the hour; and by how much a living hip stops earlier.
    const living = first.living?.expected_deg ? `, living hips some ${(first.limit_deg - first.living.expected_deg).toFixed(0)}° earlier` : "";
    if (first.clock_hour !== null) assert.ok(rest.includes(`neck on rim at ${clock(first.clock_hour)}${living};`), rest);
    else if (isHip) assert.ok(rest.includes(`away from the rim${living};`), rest);
    else assert.ok(rest.startsWith(", held in the scan's place,"), rest);
    // How sure: the band, or that there is none, and how to get one.
    if (first.band) assert.ok(rest.startsWith(` (${first.band.text})`), rest);
    else assert.ok(seen.some((line) => /No band was asked for: condyle report --band/.test(line)), seen.join("\n"));
    if (!isHip) {
      const { limit_deg: opposite_deg } = motions.find(({ name: each }) => each === "extension");
      await press(page, "button", `flexion ${limit}° arc ${(first.limit_deg + opposite_deg).toFixed(1)}° with extension`);
      await settled(page);
      // Where the surfaces meet has a pin now, which takes no pointer.
      assert.deepEqual(await page.locator(".scene-pin:visible").allTextContents(), ["tibia on femur"]);
      const [pin, point] = await page.evaluate((at) => {
        const ring = document.querySelector(".scene-pin-drawing .ring");
        return [["cx", "cy"].map((name) => Number(ring.getAttribute(name))), condyle.scene.project(at)];
      }, first.contact_point_mm);
      assert.ok(Math.hypot(pin[0] - point[0], pin[1] - point[1]) < 0.2, `${pin} for ${point}`);
    }
    if (beyond) {
      await page.locator(".result", { hasText: /^flexion / }).click();
      await settled(page);
      assert.doesNotMatch(await page.locator("#strip").textContent(), /beyond|normal/);
      assert.ok((await seenText(page)).some((line) => line.includes(beyond.living?.text ?? `clinical ${beyond.normal_range_deg}°`)));
    }

    // What changes when 2 mm of the neck go where the motion ends.
    await press(page, "tab", "Plan");
    assert.ok((await seenText(page)).some((line) => line.startsWith("Depth, mm")));
    await page.getByRole("spinbutton", { name: "Depth, mm", exact: true }).fill("2.0");
    const panel = page.getByRole("region", { name: "Resect by brush", exact: true });
    await panel.evaluate((element) => delete element.dataset.allAfter);
    await press(page, "button", "Brush where it ends");
    await page.waitForFunction((element) => element.dataset.allAfter !== undefined, await panel.elementHandle());
    const rows = await seenRows(page), head = rows.find((cells) => cells.includes("before"));
    assert.deepEqual(head.slice(1, 4), ["before", "after", "gained"]);
    const row = rows.find(([said]) => said === asSaid(first.name));
    assert.ok(row, rows.join("\n"));
    const [before, after] = row.slice(1, 3).map((said) => Number(said.replace(/[>°]/g, "")));
    const names = Object.keys(first.start_deg);
    const now = await page.evaluate((question) => condyle.query({ of: "limit", limit: question }), {
      start: Object.values(first.start_deg), ...(held ? { held } : {}), vary: names.indexOf(first.vary), positive: first.sense === "positive", range_deg: first.range_deg,
    });
    assert.equal(before, Number(first.limit_deg.toFixed(1)));
    assert.equal(after, Number(now.turned_deg.toFixed(1)));
    assert.ok(after >= before);
    assert.match(row[3], now.turned_deg - first.limit_deg >= 0.05 ? /^[>+]/ : /^0\.0°$/);
    assert.ok((await seenText(page)).some((line) => /mm³ removed, [\d.]+ mm at the deepest/.test(line)));
    assert.deepEqual(await page.evaluate(() => [scrollX, scrollY, ...[...document.querySelectorAll(".panel")].map(({ scrollTop }) => scrollTop)]), [0, 0, 0, 0, 0, 0]);
    t.diagnostic(row.join(" | "));
    assert.deepEqual(complaints, []);
    await page.context().close();
  });
