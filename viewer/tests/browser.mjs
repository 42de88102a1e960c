// The pages of real scenes in a real browser, without network: node browser.mjs PROGRAM CHROMIUM EXAMPLES FOLDER
// Writes pages and screenshots into FOLDER.

import assert from "node:assert/strict";
import { execFile, execFileSync, spawn, spawnSync } from "node:child_process";
import { readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { browser, examples, folder, open, program, view } from "./pages.mjs";

test("a page plays a run from the file system, without network", async () => {
  const { file, report } = view("free_kick");
  assert.ok(statSync(file).size < 3e6);
  const { page, context, problems } = await open(pathToFileURL(file).href);

  assert.equal(await page.title(), report.title);
  const next = page.getByRole("button", { name: "Next impact or event" });
  for (let i = 0; i < report.events.length + 1; ++i) await next.click();
  const [impact] = report.impacts;
  const shownTime = `${Number(impact.time.toPrecision(10))} s`;
  await page.waitForFunction((text) => document.querySelector("output.time").textContent === text, shownTime);
  assert.equal(await page.evaluate(() => window.trajet.time), impact.time);

  const last = report.final[0];
  const position = await page.evaluate(({ body, t }) => window.trajet.position(body, t), {
    body: last.body,
    t: report.end_time,
  });
  last.position.forEach((each, i) => assert.ok(Math.abs(each - position[i]) <= 1e-9, `${each} ${position[i]}`));
  const atImpact = await page.evaluate(({ body, t }) => window.trajet.position(body, t), {
    body: impact.body,
    t: impact.time,
  });
  impact.position.forEach((each, i) => assert.ok(Math.abs(each - atImpact[i]) <= 1e-9, `${each} ${atImpact[i]}`));

  await page.keyboard.press("Home");
  await page.keyboard.press("Space");
  await page.waitForFunction(() => window.trajet.time > 0.05);
  await page.keyboard.press("Space");
  assert.deepEqual(problems, []);
  await context.close();
});

test("a zoomed plot shows the curve itself; a click sets the time", async () => {
  const { file } = view("free_kick");
  const { page, context, problems } = await open(pathToFileURL(file).href);
  const plot = page.getByRole("img", { name: "position against time" });
  const box = await plot.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const { time, end } = await page.evaluate(() => ({ time: window.trajet.time, end: window.trajet.clock.end }));
  assert.ok(Math.abs(time / end - 0.5) < 0.01, `${time}`);
  await page.mouse.move(box.x + 0.2 * box.width, box.y + 20);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 20, { steps: 5 });
  await page.mouse.up();
  // the middle of the zoomed range is at 0.3 of the run
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const zoomed = await page.evaluate(() => window.trajet.time);
  assert.ok(Math.abs(zoomed / end - 0.3) < 0.01, `${zoomed}`);
  assert.deepEqual(problems, []);
  await context.close();
});

test("methods stand beside each other, in both colour schemes and on a phone", async () => {
  const { file } = view("notes/drag_3d", "--step", "1", "--methods", "euler,rk4");
  for (const [name, options] of Object.entries({
    light: { colorScheme: "light" },
    dark: { colorScheme: "dark" },
    phone: { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 },
  })) {
    const { page, context, problems } = await open(pathToFileURL(file).href, options);
    assert.deepEqual(await page.evaluate(() => window.trajet.runs.map((run) => run.name)), ["taylor", "euler", "rk4"]);
    await page.evaluate(() => window.trajet.seek(4));
    await page.waitForTimeout(100);
    await page.screenshot({ path: join(folder, `methods_${name}.png`) });
    // nothing is wider than the screen
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    assert.deepEqual(problems, []);
    await context.close();
  }
});

test("the energy is the whole one where the law tells it, and what is zero takes no room", async () => {
  const energies = {
    "notes/cube": ["energy [J/kg]", ["translation", "potential", "total"], null],
    free_kick: ["kinetic energy (translation) [J/kg]", [], null],
    t_handle: ["energy (rotation) [J]", [], "Zero throughout: position, velocity, acceleration, speed."],
    heavy_top: ["kinetic energy (rotation) [J]", [], "Zero throughout: position, velocity, acceleration, speed, kinetic energy (translation)."],
  }; // prettier-ignore
  for (const [scene, [title, parts, note]] of Object.entries(energies)) {
    const { page, context, problems } = await open(pathToFileURL(view(scene).file).href);
    const caption = page.locator("figcaption", { hasText: "energy" });
    assert.equal(await caption.locator(".quantity").textContent(), title);
    assert.deepEqual(await caption.locator(".curve .name").allTextContents(), parts);
    const notes = await page.locator(".zero").allTextContents();
    assert.deepEqual(notes.filter((each) => !each.includes("rounding")), note === null ? [] : [note]);
    assert.deepEqual(problems, []);
    await context.close();
  }
});

test("ways of carrying an orientation stand side by side", async () => {
  const ways = ["exact", "quaternion", "quaternion-normalized"];
  const { file } = view("notes/soccer_ball", "--orientation", ways[0], "--orientations", ways.slice(1).join());
  for (const [name, options] of Object.entries({
    ball_light: {},
    ball_phone: { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 },
  })) {
    const { page, context, problems } = await open(pathToFileURL(file).href, options);
    assert.ok(await page.getByLabel("Side by side").evaluate((each) => each.checked));
    await page.evaluate(() => window.trajet.seek(9.5));
    await page.waitForTimeout(100);
    // each ball has its name, from left to right
    const names = await page.evaluate(() =>
      [...document.querySelectorAll(".label-run")]
        .filter((each) => each.style.visibility === "visible")
        .sort((a, b) => a.getBoundingClientRect().left - b.getBoundingClientRect().left)
        .map((each) => each.textContent),
    );
    assert.deepEqual(names, ways);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await page.screenshot({ path: join(folder, `${name}.png`) });
    assert.deepEqual(problems, []);
    await context.close();
  }
});

test("ways of carrying an orientation ask for a body that turns", () => {
  const scene = join(examples, "notes/rifle_shot.toml");
  const { status, stderr } = spawnSync(program, ["view", scene, "--no-open", "--orientations", "exact"], {
    encoding: "utf8",
  });
  assert.equal(status, 2);
  assert.match(stderr, /--orientations: error: no body of the scene turns/);
});

test("every control has a name", async () => {
  const { file } = view("free_kick");
  const { page, context } = await open(pathToFileURL(file).href);
  const unnamed = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select, [role=img]")]
      .filter((each) => !(each.getAttribute("aria-label") || each.textContent.trim() || each.labels?.[0]?.textContent))
      .map((each) => each.outerHTML),
  );
  assert.deepEqual(unnamed, []);
  await context.close();
});

test("a page holds a hundred thousand steps", async () => {
  const scene = join(folder, "long.toml");
  writeFileSync(
    scene,
    `[time]\nend = 100\nsample = 10\n[method]\nname = "euler"\nstep = "1 ms"\n` +
      `[[body]]\nname = "p"\nposition = [1, 0, 0]\nvelocity = [0, 1, 0.05]\nacceleration = "[-x, -y, 0]"\n`,
  );
  const file = join(folder, "long.html");
  await promisify(execFile)(program, ["view", scene, "--no-open", "--quiet", "--out", file]);
  const { page, context, problems } = await open(pathToFileURL(file).href);
  assert.equal(await page.evaluate(() => window.trajet.runs[0].bodies[0].track.count), 100000);
  const { position } = JSON.parse(execFileSync(program, ["run", scene, "--json", "-"])).final[0];
  const shown = await page.evaluate(() => window.trajet.position("p", 100));
  position.forEach((each, i) => assert.ok(Math.abs(each - shown[i]) <= 1e-9, `${each} ${shown[i]}`));
  assert.deepEqual(problems, []);
  await context.close();
});

test("the whole scene stays in the picture when the window gets narrower", async () => {
  const [scene, file] = [join(folder, "straight.toml"), join(folder, "straight.html")];
  writeFileSync(scene, `[time]\nend = 10\n[[body]]\nname = "p"\nvelocity = [100, 0, 0]\n`);
  execFileSync(program, ["view", scene, "--no-open", "--quiet", "--out", file]);
  const pictures = [];
  for (const width of [900, 1280]) {
    const { page, context, problems } = await open(pathToFileURL(file).href, { viewport: { width, height: 600 } });
    await page.setViewportSize({ width: 900, height: 600 });
    await page.waitForFunction(() => innerWidth === 900);
    await page.waitForTimeout(300);
    pictures.push(await page.locator(".stage").screenshot({ path: join(folder, `straight_${width}.png`) }));
    assert.deepEqual(problems, []);
    await context.close();
  }
  assert.ok(pictures[0].equals(pictures[1]));
});

test("a run of no duration shows the bodies at their start, and says why there are no plots", async () => {
  const moving = `[[body]]\nname = "p"\nposition = [0, 0, 1]\nvelocity = [1, 0, 0]\n`;
  const scenes = {
    instant: `[time]\nend = 0\n${moving}`,
    failing: `[time]\nend = 1\n${moving}acceleration = "[1/(z - 1), 0, 0]"\n`,
  };
  for (const [name, text] of Object.entries(scenes)) {
    const [scene, file] = [join(folder, `${name}.toml`), join(folder, `${name}.html`)];
    writeFileSync(scene, text);
    spawnSync(program, ["view", scene, "--no-open", "--quiet", "--out", file]);
    const { page, context, problems } = await open(pathToFileURL(file).href);
    assert.deepEqual(await page.evaluate(() => window.trajet.position("p")), [0, 0, 1]);
    assert.ok(await page.locator(".stage canvas").isVisible());
    assert.match(await page.locator(".plots").textContent(), /^The run has no duration/);
    assert.deepEqual(problems, []);
    await context.close();
  }
});

test("a page so large that a browser has trouble is not made without a word", () => {
  const scene = join(folder, "large.toml");
  writeFileSync(
    scene,
    `[time]\nend = 400\nsample = 10\n[method]\nname = "euler"\nstep = "1 ms"\n` +
      `[[body]]\nname = "p"\nposition = [1, 0, 0]\nvelocity = [0, 1, 0.05]\nacceleration = "[-x, -y, 0]"\n`,
  );
  const file = join(folder, "large.html");
  for (const command of [["view", scene, "--no-open", "--out", file], ["run", scene, "--html", file]]) {
    const { status, stderr } = spawnSync(program, [...command, "--quiet"], { encoding: "utf8" });
    assert.equal(status, 0);
    const megabytes = Math.round(statSync(file).size / 1e6);
    assert.ok(megabytes > 50);
    assert.match(stderr, new RegExp(`^warning: the page has ${megabytes} MB`));
  }
});

test("--watch shows an error of the scene at its place, and the scene when it is mended", async () => {
  const scene = join(folder, "watched.toml");
  const right = readFileSync(join(examples, "free_kick.toml"), "utf8");
  writeFileSync(scene, right.replace("norm(v)", "nrm(v)"));
  const server = spawn(program, ["view", scene, "--watch", "--no-open"]);
  const ended = new Promise((resolve) => server.once("exit", (...how) => resolve(how)));
  try {
    const line = await new Promise((resolve) => server.stdout.once("data", (data) => resolve(String(data))));
    const context = await browser().newContext();
    const page = await context.newPage();
    await page.goto(line.match(/http:\S+\//)[0]);
    const alert = await page.getByRole("alert").textContent();
    assert.match(alert, /watched\.toml:\d+:\d+ there is no function 'nrm'; did you mean 'norm'/);
    const [, number] = alert.match(/:(\d+):/);
    assert.equal((await page.locator(".row.wrong .line-number").textContent()).trim(), number);
    await page.screenshot({ path: join(folder, "error.png") });
    rmSync(scene);
    await page.getByText("cannot open").waitFor();
    writeFileSync(scene, right);
    await page.waitForFunction(() => window.trajet !== undefined);
    assert.equal(await page.title(), "A free kick over the wall into the corner");
    // another title, the same time
    await page.evaluate(() => window.trajet.seek(0.5));
    writeFileSync(scene, right.replace("A free kick", "Another kick"));
    await page.waitForFunction(() => document.title.startsWith("Another kick") && window.trajet);
    assert.equal(await page.evaluate(() => window.trajet.time), 0.5);
    await context.close();
  } finally {
    server.kill("SIGINT");
  }
  assert.deepEqual(await ended, [null, "SIGINT"]);
});
