// Round ticks whose texts differ, and ranges with room around them, at whatever zoom: as reports/drawing/axes.cpp finds them for
// paper; tests/reports/page/vectors.json holds both to the same numbers.
"use strict";

/** @param {number} x */
const orderOf = x => Math.floor(Math.log10(x) + 1e-9);
/** Rounded once, which Math.pow is not everywhere. @param {number} exponent */
const powerOfTen = exponent => Number("1e" + exponent);
/** @param {number} least @param {number} n @param {number} most */
const clamped = (least, n, most) => Math.min(most, Math.max(least, n));

/** @param {number} width @param {number} wanted */
const roundStep = (width, wanted) => {
  const raw = width / wanted, power = powerOfTen(Math.floor(Math.log10(raw)));
  let fitting = power;
  for (const step of [1, 2, 5, 10]) {
    if (step > 1 && width < 2.5 * step * power) break;
    fitting = step * power;
    if (raw <= fitting) break;
  }
  return fitting;
};

/** @param {number} exponent */
const powerText = exponent => "10" + String(exponent).replace("-", "⁻").replace(/\d/g, digit => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]);

/** @param {number} from @param {number} size @param {number} power */
const offsetText = (from, size, power) => {
  const order = orderOf(size);
  if (order >= -4 && order < 7) return from.toFixed(clamped(0, -orderOf(power), 17));
  return (from / powerOfTen(order)).toFixed(clamped(0, order - orderOf(power), 17)) + " × " + powerText(order);
};

/**
 * About `wanted` of them; `aside` says what they are counted from, or in, where their texts are not the numbers.
 * @param {number} low @param {number} high @param {number} wanted
 */
export const ticks = (low, high, wanted) => {
  const step = roundStep(high - low, wanted), size = Math.max(Math.abs(low), Math.abs(high));
  /** @type {{at: number[], text: string[], aside: string}} */
  const found = { at: [], text: [], aside: "" };
  if (!(step > 0) || !isFinite(step) || !isFinite(size)) return found;
  let from = 0;
  if (orderOf(size) - orderOf(step) >= 6) {
    const power = powerOfTen(orderOf(high - low) + 1);
    from = Math.round((low + high) / 2 / power) * power;
    found.aside = offsetText(from, size, power) + " + …";
  }
  const first = Math.ceil((low - from) / step), last = Math.floor((high - from) / step);
  const greatest = step * Math.max(Math.abs(first), Math.abs(last));
  let exponent = greatest > 0 ? orderOf(greatest) : 0;
  const isLong = exponent >= 5 || exponent < -3 || exponent < 0 && orderOf(step) < -5;
  exponent = isLong ? 3 * Math.floor(exponent / 3) : 0;
  if (exponent !== 0) found.aside += (found.aside ? " × " : "× ") + powerText(exponent);
  const decimals = clamped(0, exponent - orderOf(step), 12);
  for (let k = first; k <= last && k <= first + 4 * wanted; ++k) {
    found.at.push(from + k * step);
    found.text.push(k === 0 ? "0" : (k * step / powerOfTen(exponent)).toFixed(decimals));
  }
  return found;
};

/** @param {string} name @param {string} aside */
export const axisName = (name, aside) => name && aside ? name + ", " + aside : name || aside;

/** @param {number | null} low @param {number | null} high @param {number} share @returns {[number, number]} */
export const padded = (low, high, share) => {
  if (low == null || high == null || !(low <= high)) return [0, 1];
  const width = high - low, size = Math.max(Math.abs(low), Math.abs(high));
  const room = width > Math.max(1e-12 * size, 1e-300) ? share * width : size > 1e-300 ? 0.5 * size : 1;
  return [low - room, high + room];
};
