import { crc32 } from "./crc32.mjs";

/** The chunks of a PNG file: [name, content]. */
function* chunksOf(png) {
  for (let at = 8; at < png.length; ) {
    const size = png.readUInt32BE(at);
    yield [png.toString("latin1", at + 4, at + 8), png.subarray(at + 8, at + 8 + size)];
    at += 12 + size;
  }
}

function chunk(name, content) {
  const body = Buffer.concat([Buffer.from(name, "latin1"), content]);
  const ends = Buffer.alloc(8);
  ends.writeUInt32BE(content.length, 0);
  ends.writeUInt32BE(crc32(body), 4);
  return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
}

const numbers = (...values) => {
  const buffer = Buffer.alloc(4 * values.length);
  values.forEach((value, i) => buffer.writeUInt32BE(value, 4 * i));
  return buffer;
};

/** PNG pictures of one size as an animated PNG that repeats for ever; each is shown for `milliseconds`, the last for `pause`. */
export function animatedPng(pictures, milliseconds, pause) {
  const header = [...chunksOf(pictures[0])].find(([name]) => name === "IHDR")[1];
  const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
  const parts = [pictures[0].subarray(0, 8), chunk("IHDR", header), chunk("acTL", numbers(pictures.length, 0))];
  let sequence = 0;
  pictures.forEach((picture, i) => {
    const delay = Buffer.alloc(6);
    delay.writeUInt16BE(i + 1 === pictures.length ? pause : milliseconds, 0);
    delay.writeUInt16BE(1000, 2);
    parts.push(chunk("fcTL", Buffer.concat([numbers(sequence++, width, height, 0, 0), delay])));
    for (const [name, content] of chunksOf(picture))
      if (name === "IDAT")
        parts.push(i === 0 ? chunk("IDAT", content) : chunk("fdAT", Buffer.concat([numbers(sequence++), content])));
  });
  return Buffer.concat([...parts, chunk("IEND", Buffer.alloc(0))]);
}
