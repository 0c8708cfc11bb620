// Pictures of pages: PNG files as browsers write them read, kept with a palette, and compared block by block.
import { deflateSync, inflateSync } from "node:zlib";

/** @typedef {{ width: number, height: number, pixels: Uint8Array }} Picture red, green, blue of each pixel, from the top left */

const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);

/** @returns {number} the predictor of PNG's fourth filter */
function paeth(left, up, corner) {
  const along = Math.abs(up - corner), down = Math.abs(left - corner), both = Math.abs(left + up - 2 * corner);
  if (along <= down && along <= both) return left;
  return down <= both ? up : corner;
}

/** Takes the filters of the rows back: bytes of `step` a pixel. */
function unfiltered(raw, rowBytes, height, step) {
  const bytes = new Uint8Array(rowBytes * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (rowBytes + 1)], row = y * rowBytes;
    for (let i = 0; i < rowBytes; ++i) {
      const left = i < step ? 0 : bytes[row + i - step], up = y === 0 ? 0 : bytes[row - rowBytes + i];
      const corner = i < step || y === 0 ? 0 : bytes[row - rowBytes + i - step];
      const predicted = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
      bytes[row + i] = raw[y * (rowBytes + 1) + 1 + i] + predicted;
    }
  }
  return bytes;
}

/** @param {Buffer} file PNG of 8 bits a channel, or with a palette of 8 bits; not interlaced @returns {Picture} */
export function decoded(file) {
  const data = [];
  let width = 0, height = 0, step = 0, palette = Buffer.alloc(0);
  for (let at = signature.length; at < file.length;) {
    const size = file.readUInt32BE(at), type = file.toString("latin1", at + 4, at + 8), content = file.subarray(at + 8, at + 8 + size);
    if (type === "IHDR") {
      [width, height] = [content.readUInt32BE(0), content.readUInt32BE(4)];
      step = { 2: 3, 3: 1, 6: 4 }[content[9]] ?? 0;
      if (content[8] !== 8 || step === 0 || content[12] !== 0) throw new Error("a PNG of another kind");
    } else if (type === "PLTE") palette = content;
    else if (type === "IDAT") data.push(content);
    at += size + 12;
  }
  const bytes = unfiltered(inflateSync(Buffer.concat(data)), width * step, height, step);
  const pixels = new Uint8Array(3 * width * height);
  for (let i = 0; i < width * height; ++i)
    for (let c = 0; c < 3; ++c) pixels[3 * i + c] = step === 1 ? palette[3 * bytes[i] + c] : bytes[step * i + c];
  return { width, height, pixels };
}

function checksum(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return (sum ^ 0xffffffff) >>> 0;
}

function chunk(type, content) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), content]), frame = Buffer.alloc(8);
  frame.writeUInt32BE(content.length, 0);
  frame.writeUInt32BE(checksum(body), 4);
  return Buffer.concat([frame.subarray(0, 4), body, frame.subarray(4)]);
}

/** The colours that most pixels have, a third of them as they are, of others alike ones taken together; thin lines have few pixels,
 * and their colours tell. */
function paletteOf({ pixels }, colours) {
  const bins = new Map(), exact = new Map();
  for (let i = 0; i < pixels.length; i += 3) {
    const key = (pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2];
    exact.set(key, (exact.get(key) ?? 0) + 1);
  }
  const first = [...exact].sort((one, other) => other[1] - one[1]).slice(0, Math.ceil(colours / 3)).map(([key]) => key);
  for (let i = 0; i < pixels.length; i += 3) {
    const key = ((pixels[i] >> 4) << 8) | ((pixels[i + 1] >> 4) << 4) | (pixels[i + 2] >> 4);
    if (first.includes((pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2])) continue;
    const bin = bins.get(key) ?? [0, 0, 0, 0];
    bins.set(key, [bin[0] + 1, bin[1] + pixels[i], bin[2] + pixels[i + 1], bin[3] + pixels[i + 2]]);
  }
  /** @param {number[]} bin */
  const weight = ([count, ...sums]) => count + (Math.max(...sums) - Math.min(...sums)) / 16;
  const most = [...bins.values()].sort((one, other) => weight(other) - weight(one)).slice(0, colours - first.length);
  return [...first.map(key => [key >> 16, (key >> 8) & 255, key & 255]),
    ...most.map(([count, ...sums]) => sums.map(sum => Math.round(sum / count)))];
}

/** @param {Picture} picture @returns {Buffer} a PNG with a palette of so many colours */
export function encoded(picture, colours = 160) {
  const { width, height, pixels } = picture, palette = paletteOf(picture, colours), nearest = new Map();
  const indexOf = (red, green, blue) => {
    const key = (red << 16) | (green << 8) | blue;
    if (!nearest.has(key)) {
      const far = palette.map(([r, g, b]) => (r - red) ** 2 + (g - green) ** 2 + (b - blue) ** 2);
      nearest.set(key, far.indexOf(Math.min(...far)));
    }
    return nearest.get(key);
  };
  const raw = Buffer.alloc((width + 1) * height), head = Buffer.alloc(13);
  for (let i = 0; i < width * height; ++i)
    raw[Math.floor(i / width) * (width + 1) + 1 + (i % width)] = indexOf(pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  return Buffer.concat([signature, chunk("IHDR", head), chunk("PLTE", Buffer.from(palette.flat())),
    chunk("IDAT", deflateSync(raw, { level: 9, memLevel: 9 })), chunk("IEND", Buffer.alloc(0))]);
}

/** So many times as narrow and low: each pixel is the mean of a square; what is left over at the ends is cut off.
 * @param {Picture} picture @param {number} times @returns {Picture} */
export function reduced(picture, times) {
  if (times === 1) return picture;
  const width = Math.floor(picture.width / times), height = Math.floor(picture.height / times), pixels = new Uint8Array(3 * width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x)
      pixels.set(meanOf(picture, times * x, times * y, times).map(Math.round), 3 * (y * width + x));
  return { width, height, pixels };
}

/** Of a square of so many pixels the mean colour. */
function meanOf({ width, height, pixels }, left, top, size) {
  const sums = [0, 0, 0], right = Math.min(left + size, width), bottom = Math.min(top + size, height);
  for (let y = top; y < bottom; ++y)
    for (let x = left; x < right; ++x)
      for (let c = 0; c < 3; ++c) sums[c] += pixels[3 * (y * width + x) + c];
  return sums.map(sum => sum / ((right - left) * (bottom - top)));
}

/**
 * Where two pictures differ: in which blocks of `size` pixels the mean of a channel does by more than `tolerance` of 255, which
 * roundings of colours and smoothed edges do not.
 * @param {Picture} one @param {Picture} other @returns {string} a line; empty where they do not
 */
export function difference(one, other, size = 8, tolerance = 16) {
  if (one.width !== other.width || one.height !== other.height)
    return `it has ${one.width} × ${one.height} pixels instead of ${other.width} × ${other.height}`;
  let count = 0, left = Infinity, top = Infinity, right = 0, bottom = 0;
  for (let y = 0; y < one.height; y += size)
    for (let x = 0; x < one.width; x += size) {
      const expected = meanOf(other, x, y, size);
      if (meanOf(one, x, y, size).every((mean, c) => Math.abs(mean - expected[c]) <= tolerance)) continue;
      ++count;
      [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, x + size), Math.max(bottom, y + size)];
    }
  return count === 0 ? "" : `${count} blocks of ${size} × ${size} pixels differ, from ${left}, ${top} to ${right}, ${bottom}`;
}
