// What can be read on the pages of real scenes, in a real browser: node reading.mjs PROGRAM CHROMIUM EXAMPLES FOLDER

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { drawn, folder, open, view, viewText } from "./pages.mjs";

const openFile = ({ file }, options) => open(pathToFileURL(file).href, options);

/** Balls that bounce on a floor, one beside the other, each a little later than the one before. */
const bouncing = (count, end) =>
  `[time]\nend = ${end}\nsample = "0.1 s"\n` +
  Array.from(
    { length: count },
    (_, i) =>
      `[[body]]\nname = "b${i}"\nshape = "sphere"\nradius = 0.1\nposition = [${i % 10}, ${Math.floor(i / 10)}, ${1 + 0.003 * i}]\n` +
      `velocity = [0.2, 0, 0]\nacceleration = [0, 0, -9.81]\n`,
  ).join("") +
  `[[obstacle]]\nname = "floor"\nshape = "plane"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = "bounce"\nrestitution = 0.7\n`;

test("the line at the time is where the time is, after a zoom and at the last instant", async () => {
  const { page, context, problems } = await openFile(view("free_kick"));
  const plot = page.getByRole("img", { name: "position against time" });
  const box = await plot.boundingBox();
  const lineAt = async () => {
    await drawn(page);
    return plot.evaluate((over) => {
      const line = over.querySelector(".now").getBoundingClientRect();
      const { left, width } = over.getBoundingClientRect();
      return ((line.left + line.right) / 2 - left) / width;
    });
  };
  const end = await page.evaluate(() => window.trajet.clock.end);
  await page.evaluate((t) => window.trajet.seek(t), 0.3 * end);
  assert.ok(Math.abs((await lineAt()) - 0.3) < 0.01);
  // with nothing else to draw
  await page.evaluate((t) => window.trajet.plots.zoom(0, 0.6 * t), end);
  assert.ok(Math.abs((await lineAt()) - 0.5) < 0.01, `${await lineAt()}`);
  await page.evaluate((t) => window.trajet.plots.zoom(0, t), end);
  await page.mouse.move(box.x + 0.2 * box.width, box.y + 20);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 20, { steps: 5 });
  await page.mouse.up();
  await page.mouse.move(10, 10);
  // 0.3 is a quarter of the way from 0.2 to 0.6
  assert.ok(Math.abs((await lineAt()) - 0.25) < 0.02, `${await lineAt()}`);
  await page.mouse.dblclick(box.x + 0.5 * box.width, box.y + 20);
  await page.mouse.move(10, 10);
  await page.keyboard.press("End");
  assert.ok(Math.abs((await lineAt()) - 1) < 0.01);
  const isSeen = await plot.evaluate((over) => {
    const line = over.querySelector(".now");
    line.style.pointerEvents = "auto";
    const { left, right, top } = line.getBoundingClientRect();
    // clipped parts are not found; the plot itself ends at the middle of the line
    return document.elementFromPoint(right - 0.2, top + 10) === line && left < over.getBoundingClientRect().right;
  });
  assert.ok(isSeen);
  assert.deepEqual(problems, []);
  await context.close();
});

test("events are marked, listed and stepped to as impacts are", async () => {
  const scene = view("t_handle");
  const { events } = scene.report;
  assert.equal(events.length, 13);
  const { page, context, problems } = await openFile(scene);
  await page.keyboard.press("n");
  assert.equal(await page.evaluate(() => window.trajet.time), events[0].time);
  await page.keyboard.press("n");
  await page.keyboard.press("n");
  await page.keyboard.press("p");
  assert.equal(await page.evaluate(() => window.trajet.time), events[1].time);
  await drawn(page);
  assert.equal(await page.locator(".ticks .event").count(), 13);
  assert.match(await page.locator(".moment").textContent(), /^2 of 13: flip \(rising\), 2\.22524 s$/);
  const list = page.getByRole("region", { name: "Events" });
  assert.equal(await list.locator("tbody tr").count(), 13);
  assert.equal(await list.locator("tr.current").textContent(), `${Number(events[1].time.toPrecision(10))}fliprising`);
  // a click in the list goes there
  await list.getByRole("button").nth(6).click();
  assert.equal(await page.evaluate(() => window.trajet.time), events[6].time);
  assert.deepEqual(problems, []);
  await context.close();
});

test("the list tells who hits what, how fast and at which angle", async () => {
  const scene = view("free_kick");
  const { page, context } = await openFile(scene);
  const rows = page.getByRole("region", { name: "Impacts and events" }).locator("tbody tr");
  const cells = (row) => rows.nth(row).locator("td").allTextContents();
  assert.deepEqual((await cells(0)).slice(1), ["", "falling", "apex", "", ""]);
  const [impact] = scene.report.impacts;
  const v = impact.velocity_before;
  const angle = (Math.asin(Math.abs(v[0]) / Math.hypot(...v)) * 180) / Math.PI;
  assert.deepEqual((await cells(1)).slice(1), ["ball", "hit", "goal", "18.93", String(Number(angle.toPrecision(3)))]);
  await drawn(page);
  assert.deepEqual(await page.locator(".label-impact").allTextContents(), ["ball hits goal, 1.06678 s, 18.93 m/s"]);
  assert.equal(await page.locator(".status").textContent(), "stopped: ball hits goal");
  await context.close();
  const frisbee = await openFile(view("frisbee"));
  assert.equal(await frisbee.page.locator(".status").textContent(), "stopped: event landing");
  await frisbee.context.close();
});

test("the values at the time are shown, and those where the pointer rests on a plot", async () => {
  const { page, context, problems } = await openFile(view("free_kick"));
  const values = async (row) => (await page.locator(".readout tbody tr").nth(row).locator("td").allTextContents()).slice(0, 4);
  const text = (value) => String(Number(value.toPrecision(4))).replace("-", "−");
  const positionAt = (t) => page.evaluate((time) => window.trajet.position("ball", time), t);
  await page.evaluate(() => window.trajet.seek(0.6));
  await drawn(page);
  const position = await positionAt(0.6);
  assert.deepEqual(await values(0), [...position, Math.hypot(...position)].map(text));
  const before = await page.locator(".stage").screenshot();

  const plot = page.getByRole("img", { name: "speed against time" });
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  await page.mouse.move(box.x + 0.25 * box.width, box.y + 40);
  await drawn(page);
  const end = await page.evaluate(() => window.trajet.clock.end);
  const [x] = await values(0);
  const hovered = (await positionAt(0.25 * end))[0];
  assert.ok(Math.abs(Number(x) - hovered) < 0.2, `${x} ${hovered}`);
  const caption = page.locator("figcaption", { hasText: "speed" }).locator(".value");
  const speed = Number((await values(1))[3]);
  assert.equal(Number(await caption.textContent()), speed);
  // the picture goes along, the clock does not, and all is as before when the pointer leaves
  assert.ok(!before.equals(await page.locator(".stage").screenshot()));
  assert.equal(await page.evaluate(() => window.trajet.time), 0.6);
  await page.mouse.move(10, 10);
  await drawn(page);
  assert.deepEqual(await values(0), [...position, Math.hypot(...position)].map(text));
  assert.ok(before.equals(await page.locator(".stage").screenshot()));
  assert.deepEqual(problems, []);
  await context.close();
});

test("the axes have names, in the plane and in height", async () => {
  const { page, context } = await openFile(view("frisbee"));
  await drawn(page);
  const shown = await page.evaluate(() =>
    [...document.querySelectorAll(".label-scale")]
      .filter((each) => each.style.visibility === "visible")
      .map((each) => each.textContent),
  );
  for (const name of ["x = ", "y = ", "z [m]"]) assert.ok(shown.some((text) => text.startsWith(name)), `${name}: ${shown}`);
  assert.deepEqual(await page.locator(".triad text").allTextContents(), ["x", "y", "z"]);
  await context.close();
});

test("the camera stays over the ground", async () => {
  const { page, context } = await openFile(view("free_kick"));
  const box = await page.locator(".stage canvas").boundingBox();
  await page.mouse.move(box.x + 300, box.y + 550);
  await page.mouse.down();
  await page.mouse.move(box.x + 300, box.y + 20, { steps: 20 });
  await page.mouse.up();
  await drawn(page);
  const height = await page.evaluate(() => {
    const { rig, frame } = window.trajet.stage;
    return rig.camera.position.z - frame.toView([0, 0, 0]).z;
  });
  assert.ok(height > 0, `${height}`);
  await page.screenshot({ path: join(folder, "from_the_ground.png") });
  await context.close();
});

/** How large a body of the first run looks, and where its arrows end, as parts of the picture from -1 to 1. */
const looks = (page) =>
  page.evaluate(() => {
    const { rig, actors } = window.trajet.stage;
    const [actor] = actors[0];
    const { camera } = rig;
    const ends = [actor.velocity, actor.acceleration]
      .filter((each) => each.visible)
      .map((each) => {
        each.updateWorldMatrix(true, false);
        return each.position.clone().set(0, 1, 0).applyMatrix4(each.matrixWorld);
      });
    const toPicture = (point) => point.clone().project(camera);
    const size = actor.reach / (rig.pixelAt(camera.position.distanceTo(actor.place)) || 1);
    return {
      size,
      center: toPicture(actor.place).toArray(),
      ends: ends.map((end) => toPicture(end).toArray()),
      // how far a tip is from the centre, in the reach of the body
      reaches: ends.map((end) => end.distanceTo(actor.place) / actor.reach),
    };
  });

test("a body that is followed is not smaller than before, and its arrows are seen", async () => {
  for (const [scene, time] of [["t_handle", 2], ["free_kick", 0.6], ["frisbee", 1]]) {
    const { page, context } = await openFile(view(scene));
    await page.evaluate((t) => window.trajet.seek(t), time);
    await drawn(page);
    const before = await looks(page);
    await page.keyboard.press("f");
    await drawn(page);
    for (const t of [time, 0.5 * time]) {
      await page.evaluate((each) => window.trajet.seek(each), t);
      await drawn(page);
      const now = await looks(page);
      assert.ok(now.size >= 0.999 * before.size, `${scene}: ${now.size} ${before.size}`);
      for (const [x, y] of [now.center, ...now.ends]) assert.ok(Math.abs(x) < 1 && Math.abs(y) < 1, scene);
      // an arrow comes out of its body
      for (const reach of now.reaches) assert.ok(reach > 1.2, `${scene}: ${reach}`);
    }
    await page.screenshot({ path: join(folder, `follow_${scene}.png`) });
    await context.close();
  }
});

test("a flat scene fills the picture, and nothing of its grid is cut off", async () => {
  for (const scene of ["notes/rifle_shot", "free_kick", "frisbee", "notes/cube"]) {
    const { page, context } = await openFile(view(scene));
    await drawn(page);
    const places = await page.evaluate(() => {
      const { rig, scenery } = window.trajet.stage;
      return scenery.corners.map((corner) => corner.clone().project(rig.camera).toArray());
    });
    const span = (axis) => Math.max(...places.map((each) => each[axis])) - Math.min(...places.map((each) => each[axis]));
    for (const [x, y] of places) assert.ok(Math.abs(x) <= 1 && Math.abs(y) <= 1, scene);
    assert.ok(span(0) / 2 > 0.8 && span(1) / 2 > 0.5, `${scene}: ${span(0) / 2} ${span(1) / 2}`);
    await context.close();
  }
});

test("texts stay where they are while it plays", async () => {
  const { page, context } = await openFile(viewText("few_bounces", bouncing(3, 1.2)));
  const places = async () =>
    page.evaluate(() =>
      Object.fromEntries(
        [...document.querySelectorAll(".label-impact, .label-obstacle, .label-scale")].map((each) => [
          each.textContent,
          `${each.style.visibility} ${each.style.transform}`,
        ]),
      ),
    );
  await drawn(page);
  const before = await places();
  assert.ok(Object.keys(before).some((text) => /^b0 hits floor, 0\.\d+ s, \d.* m\/s$/.test(text)));
  for (const t of [0.1, 0.3, 0.44, 0.46, 0.8, 1.1]) {
    await page.evaluate((each) => window.trajet.seek(each), t);
    await drawn(page);
    assert.deepEqual(await places(), before);
  }
  await context.close();
});

test("hundreds of impacts of hundreds of balls are no carpet", async () => {
  const { page, context, problems } = await openFile(viewText("many_balls", bouncing(300, 1.5)));
  const time = 1.2;
  await page.evaluate((t) => window.trajet.seek(t), time);
  await drawn(page);
  const shown = await page.evaluate(() => {
    const { impacts, actors } = window.trajet.stage;
    return {
      dots: impacts[0].dots.geometry.drawRange.count,
      arrows: actors[0].filter((actor) => actor.velocity.visible || actor.acceleration.visible).map(({ motion }) => motion.name),
    };
  });
  assert.ok(shown.dots <= 30, `${shown.dots}`);
  assert.deepEqual(shown.arrows, ["b0"]);
  const texts = await page.locator(".label-impact").allTextContents();
  assert.ok(texts.length > 0 && texts.length <= 5, `${texts}`);
  // what has just happened
  for (const text of texts) assert.ok(Math.abs(Number(text.match(/, ([\d.]+) s/)[1]) - time) < 0.2, text);
  await page.screenshot({ path: join(folder, "many_balls.png") });
  // one that is pointed at tells its name, and is chosen by a click
  const [x, y] = await page.evaluate(() => {
    const { actors, rig, container } = window.trajet.stage;
    const { x, y } = actors[0][299].place.clone().project(rig.camera);
    const box = container.getBoundingClientRect();
    return [box.left + (0.5 + 0.5 * x) * box.width, box.top + (0.5 - 0.5 * y) * box.height];
  });
  await page.mouse.move(x, y);
  const name = await page.locator(".tip").textContent();
  assert.match(name, /^b\d+/);
  await page.mouse.down();
  await page.mouse.up();
  if (!name.includes("hits")) assert.equal(await page.getByLabel("Body", { exact: true }).inputValue(), name);
  assert.deepEqual(problems, []);
  await context.close();
});

test("the parameters and the text of the scene can be read", async () => {
  const scene = view("free_kick");
  const { page, context } = await openFile(scene);
  await page.keyboard.press("e");
  const dialog = page.getByRole("dialog", { name: "Scene" });
  assert.ok(await dialog.isVisible());
  const terms = await dialog.locator("dt").allTextContents();
  for (const name of Object.keys(scene.report.parameters)) assert.ok(terms.includes(name), name);
  const text = await dialog.locator("pre").textContent();
  assert.match(text, /^# A curling free kick/);
  assert.ok(text.includes('side_spin = "9 rev/s"'));
  await context.close();
});

test("bodies and obstacles have the colours that the scene gives them", async () => {
  const { file } = view("free_kick");
  const text = readFileSync(file, "utf8");
  const at = text.indexOf("id=\"trajet-data\">");
  const coloured = text
    .slice(at)
    .replace('{"name":"ball",', '{"name":"ball","color":"#ff0000",')
    .replace('{"name":"goal",', '{"name":"goal","color":"#00ff00",');
  const copy = join(folder, "coloured.html");
  writeFileSync(copy, text.slice(0, at) + coloured);
  const { page, context } = await openFile({ file: copy });
  const colors = await page.evaluate(() => {
    const { actors, scenery } = window.trajet.stage;
    const colorOf = (name) => scenery.solids.find((each) => each.name === name).material.color.getHexString();
    return [actors[0][0].look.color, colorOf("goal"), colorOf("player1")];
  });
  assert.deepEqual(colors.slice(0, 2), ["#ff0000", "00ff00"]);
  assert.notEqual(colors[2], "00ff00");
  await context.close();
});
