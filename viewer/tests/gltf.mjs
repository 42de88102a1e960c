// Every example as glTF passes the validator of Khronos without error or warning: node gltf.mjs PROGRAM EXAMPLES FOLDER

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import validator from "gltf-validator";

const [program, examples, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const scenes = [examples, join(examples, "notes")].flatMap((each) =>
  readdirSync(each)
    .filter((name) => name.endsWith(".toml"))
    .map((name) => join(each, name)),
);
assert.ok(scenes.length > 5);

for (const scene of scenes)
  test(basename(scene), async () => {
    const file = join(folder, `${basename(scene, ".toml")}.glb`);
    execFileSync(program, ["run", scene, "--quiet", "--glb", file]);
    const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)));
    assert.deepEqual(issues.messages, []);
  });
