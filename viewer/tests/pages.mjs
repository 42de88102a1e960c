// What the tests in a browser share: the program's pages, opened without network.
// node TEST.mjs PROGRAM CHROMIUM EXAMPLES FOLDER

import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { chromium } from "playwright-core";

const [program, executablePath, examples, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
export { examples, folder, program };

/** ms; a machine that has much else to do is slow, not wrong. */
const kPatience = 150000;

let started;
before(async () => {
  started = await chromium.launch({
    executablePath,
    // software rendering: the same picture on every machine
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
});
after(() => started?.close());
export const browser = () => started;

/** Runs an example; its page, and its report. */
export function view(scene, ...options) {
  return viewFile(join(examples, `${scene}.toml`), scene.replaceAll("/", "_"), ...options);
}

/** The same of a scene that is given as text. */
export function viewText(name, text, ...options) {
  const path = join(folder, `${name}.toml`);
  writeFileSync(path, text);
  return viewFile(path, name, ...options);
}

function viewFile(path, name, ...options) {
  const file = join(folder, `${name}.html`);
  const report = join(folder, `${name}.json`);
  execFileSync(program, ["run", path, "--quiet", "--json", report]);
  execFileSync(program, ["view", path, "--no-open", "--quiet", "--out", file, ...options]);
  return { file, report: JSON.parse(readFileSync(report, "utf8")) };
}

/** Opens a page; `problems` collects what it says on the console. */
export async function open(address, options = {}) {
  const context = await started.newContext({ viewport: { width: 1280, height: 800 }, offline: true, ...options });
  context.setDefaultTimeout(kPatience);
  context.setDefaultNavigationTimeout(kPatience);
  const page = await context.newPage();
  const problems = [];
  page.on("console", (message) => problems.push(message.text()));
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("request", (request) => {
    if (!request.url().startsWith("file:") && !request.url().startsWith("data:")) problems.push(request.url());
  });
  await page.goto(address);
  return { page, context, problems };
}

/** Waits until what has changed is drawn. */
export const drawn = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
