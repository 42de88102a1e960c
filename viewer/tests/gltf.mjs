// Every example as glTF passes the validator of Khronos without error or warning, and its keys are the poses of the
// report: node gltf.mjs PROGRAM EXAMPLES FOLDER

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

/** Of single precision against the coordinates, of at least 1 m. */
const kTolerance = 1e-6;

/** A glb file by its specification: a header of 12 bytes, then chunks of length, type, content. */
function read(file) {
  const bytes = readFileSync(file);
  const jsonSize = bytes.readUInt32LE(12);
  const { nodes, animations = [], accessors, bufferViews } = JSON.parse(bytes.toString("utf8", 20, 20 + jsonSize));
  const buffer = bytes.subarray(20 + jsonSize + 8);
  const floats = (index) => {
    const { bufferView, count, type } = accessors[index];
    const size = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type];
    const at = (row, i) => buffer.readFloatLE((bufferViews[bufferView].byteOffset ?? 0) + 4 * (row * size + i));
    return Array.from({ length: count }, (_, row) => Array.from({ length: size }, (_, i) => at(row, i)));
  };
  /** Times and values of a body's keys; null where it has none. */
  const keys = (body, path) => {
    const channel = animations[0]?.channels.find(
      ({ target }) => nodes[target.node].name === body && target.path === path,
    );
    if (!channel) return null;
    const { input, output } = animations[0].samplers[channel.sampler];
    return { times: floats(input).flat(), values: floats(output) };
  };
  return { nodes, keys };
}

const near = (found, expected) => {
  const size = Math.max(1, ...expected.map(Math.abs));
  expected.forEach((each, i) => assert.ok(Math.abs(found[i] - each) <= kTolerance * size, `${found} ${expected}`));
};

for (const scene of scenes)
  test(basename(scene), async () => {
    const file = join(folder, `${basename(scene, ".toml")}.glb`);
    const report = JSON.parse(execFileSync(program, ["run", scene, "--json", "-", "--glb", file]));
    const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)));
    assert.deepEqual(issues.messages, []);

    const { nodes, keys } = read(file);
    for (const { body, position, orientation, points } of report.final) {
      near(keys(body, "translation").values.at(-1), position);
      const rotation = keys(body, "rotation");
      if (rotation) {
        const norm = Math.hypot(...orientation);
        const [x, y, z, w] = rotation.values.at(-1);
        const sign = Math.sign(w * orientation[0] + x * orientation[1] + y * orientation[2] + z * orientation[3]);
        near([w, x, y, z], orientation.map((each) => (sign * each) / norm)); // prettier-ignore
      }
      const node = nodes.find(({ name }) => name === body);
      const children = (node.children ?? []).map((child) => nodes[child].name);
      assert.deepEqual(children, Object.keys(points).map((point) => `${body}.${point}`)); // prettier-ignore
    }
    // the time of a rest is behind its position, which is that of the last bounce
    for (const { time, body, position, kind } of report.impacts.filter(({ kind }) => kind === "hit" || kind === "graze")) {
      const { times, values } = keys(body, "translation");
      const index = times.indexOf(Math.fround(time - report.start_time));
      assert.ok(index >= 0, `no key at the ${kind} at ${time} s`);
      near(values[index], position);
    }
  });
