// Pictures are what they were when they are read again, but for their palette; and what differs is found.
import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";

import { decoded, difference, encoded, reduced } from "./pictures.mjs";

/** White, with a rectangle of a colour. */
function picture(width, height, { left = 0, top = 0, right = 0, bottom = 0, colour = [0, 0, 0] } = {}) {
  const pixels = new Uint8Array(3 * width * height).fill(255);
  for (let y = top; y < bottom; ++y) for (let x = left; x < right; ++x) pixels.set(colour, 3 * (y * width + x));
  return { width, height, pixels };
}
const card = { left: 20, top: 30, right: 60, bottom: 50, colour: [179, 38, 30] };

test("pictures of few colours are kept as they are", () => {
  for (const [width, height] of [[1, 1], [7, 3], [100, 80]]) {
    const one = picture(width, height, width > 60 ? card : {});
    assert.deepEqual(decoded(encoded(one)), one);
  }
});

test("a picture that is reduced has the mean of each square, and loses what is left over", () => {
  const one = picture(5, 4, { right: 1, bottom: 2, colour: [55, 155, 255] });
  assert.equal(reduced(one, 1), one);
  const half = reduced(one, 2);
  assert.deepEqual([half.width, half.height], [2, 2]);
  assert.deepEqual([...half.pixels.slice(0, 6)], [155, 205, 255, 255, 255, 255]);
});

test("of many colours those are kept that are most like them", () => {
  const one = picture(64, 64);
  for (let i = 0; i < one.pixels.length; ++i) one.pixels[i] = (i * 7919) % 256;
  const again = decoded(encoded(one, 255));
  assert.ok(again.pixels.every((value, i) => Math.abs(value - one.pixels[i]) <= 96));
});

/** A row of grey pixels in each of the filters of PNG, by the rules as the standard words them (W3C PNG, 9.2). */
test("what browsers filter is read", () => {
  const rows = [[9, 200, 30], [4, 80, 77], [255, 0, 13], [60, 61, 62], [5, 250, 128]];
  const grey = rows.map(row => row.flatMap(value => [value, value, value]));
  const raw = grey.flatMap((row, filter) => [filter, ...row.map((value, i) => {
    const a = i < 3 ? 0 : row[i - 3], b = filter === 0 ? 0 : grey[filter - 1][i], c = i < 3 || filter === 0 ? 0 : grey[filter - 1][i - 3];
    const p = a + b - c, [pa, pb, pc] = [a, b, c].map(x => Math.abs(p - x));
    const predicted = [0, a, b, Math.floor((a + b) / 2), pa <= pb && pa <= pc ? a : pb <= pc ? b : c][filter];
    return (value - predicted) & 255;
  })]);
  const head = Buffer.from([0, 0, 0, 3, 0, 0, 0, 5, 8, 2, 0, 0, 0]), data = deflateSync(Buffer.from(raw));
  const sizeOf = content => Buffer.from([0, 0, content.length >> 8, content.length & 255]);
  const chunk = (type, content) => Buffer.concat([sizeOf(content), Buffer.from(type), content, Buffer.alloc(4)]);
  const file = Buffer.concat([Buffer.alloc(8), chunk("IHDR", head), chunk("IDAT", data), chunk("IEND", Buffer.alloc(0))]);
  assert.deepEqual(decoded(file), { width: 3, height: 5, pixels: new Uint8Array(grey.flat()) });
});

test("a colour, a moved card and another size are found", () => {
  const one = picture(100, 80, card);
  assert.equal(difference(one, picture(100, 80, card)), "");
  assert.equal(difference(one, picture(100, 80, { ...card, colour: [150, 38, 30] })), "8 blocks of 8 × 8 pixels differ, from 24, 32 to 56, 48");
  assert.match(difference(one, picture(100, 80, { ...card, left: 22, right: 62 })), /^4 blocks .* differ, from 16, 32 to 64, 48$/);
  assert.equal(difference(one, picture(100, 81, card)), "it has 100 × 80 pixels instead of 100 × 81");
});

test("smoothed edges are not", () => {
  const one = picture(100, 80, card), smoothed = picture(100, 80, card);
  for (let y = 30; y < 50; ++y) smoothed.pixels.set([200, 78, 70], 3 * (y * 100 + 59));
  assert.equal(difference(one, smoothed), "");
});
