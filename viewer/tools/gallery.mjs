// Makes docs/gallery.md with a picture of every example, and the animations of the README:
// node gallery.mjs PROGRAM CHROMIUM, from anywhere.

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { animatedPng } from "./apng.mjs";

/** The scenes whose animation the README shows: the part of the run, and how many pictures of it. */
const kAnimated = [
  { scene: "examples/free_kick.toml", from: 0, to: 1, frames: 48 },
  { scene: "examples/t_handle.toml", from: 0.074, to: 0.1485, frames: 60 }, // turns over once
];
/** Options with which a scene is shown. */
const kOptions = {
  "examples/notes/soccer_ball.toml": ["--orientation", "exact", "--orientations", "quaternion,quaternion-normalized"],
};
const kSize = { width: 720, height: 405 };
const kAnimationSize = { width: 560, height: 300 };
const kFrameMilliseconds = 60;
const kPauseMilliseconds = 1500;
/** The part of a run at which its picture is taken. */
const kMoment = 0.75;

const [program, executablePath] = process.argv.slice(2).map((each) => resolve(each));
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const pictures = join(root, "docs/gallery");
const work = mkdtempSync(join(tmpdir(), "trajet-gallery-"));
process.chdir(root);
mkdirSync(pictures, { recursive: true });

const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});

/** The page of a scene, showing nothing but the picture in space, or, where nothing moves in space, the plots. */
async function open(scene, viewport) {
  const file = join(work, `${basename(scene, ".toml")}.html`);
  execFileSync(program, ["view", scene, "--no-open", "--quiet", "--out", file, ...(kOptions[scene] ?? [])]);
  const page = await browser.newPage({ viewport, colorScheme: "light" });
  await page.goto(pathToFileURL(file).href);
  await page.addStyleTag({
    content: `header, .timeline, .panel, .moment, .body:not(.plots-only) .side { display: none !important }
              .body { display: block !important; height: 100dvh !important }
              .stage { height: 100dvh !important }
              .label-obstacle { display: none }`,
  });
  // the picture fits its new size
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.evaluate(() => window.trajet.fit());
  return page;
}

const seek = async (page, part) => {
  await page.evaluate((p) => window.trajet.seek(window.trajet.clock.begin + p * window.trajet.clock.duration), part);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
};

async function makePicture(scene) {
  const page = await open(scene, kSize);
  await seek(page, kMoment);
  const name = `${basename(scene, ".toml")}.png`;
  await page.screenshot({ path: join(pictures, name) });
  const title = await page.title();
  await page.close();
  return `## ${title}\n\n![${title}](gallery/${name})\n\n[\`${scene}\`](../${scene})\n\n` +
    `\`\`\`sh\n${["build/release/trajet view", scene, ...(kOptions[scene] ?? [])].join(" ")}\n\`\`\`\n`; // prettier-ignore
}

async function makeAnimation({ scene, from, to, frames: count }) {
  const page = await open(scene, kAnimationSize);
  const frames = [];
  for (let i = 0; i < count; ++i) {
    await seek(page, from + ((to - from) * i) / (count - 1));
    frames.push(await page.screenshot());
  }
  const name = `${basename(scene, ".toml")}_animation.png`;
  writeFileSync(join(pictures, name), animatedPng(frames, kFrameMilliseconds, kPauseMilliseconds));
  await page.close();
}

const scenesOf = (folder) =>
  readdirSync(folder)
    .filter((name) => name.endsWith(".toml"))
    .sort()
    .map((name) => `${folder}/${name}`);

const scenes = [...scenesOf("examples"), ...scenesOf("examples/notes")];
const sections = [];
for (const scene of scenes) sections.push(await makePicture(scene));
writeFileSync(
  "docs/gallery.md",
  `# Gallery\n\nEvery scene of \`examples/\`, as \`trajet view\` shows it. \`make docs\` makes this page and its pictures.\n\n${sections.join("\n")}`,
);
for (const animated of kAnimated) if (scenes.includes(animated.scene)) await makeAnimation(animated);
await browser.close();
rmSync(work, { recursive: true });
