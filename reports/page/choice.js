// Which samples go through the ranges that are chosen of axes, and what keys make of a range.
"use strict";

/** @typedef {{name: string, unit: string, isQuantity: boolean, ends: number[], limits: number[], values: (number | null)[]}} Axis */
/** @typedef {[number, number]} Range */

/** A text in lines of so many letters at most, where words let it. @param {string} text @param {number} letters */
export const wrapped = (text, letters) => {
  /** @type {string[]} */
  const lines = [];
  for (const word of text.split(" ")) {
    const last = lines.at(-1);
    if (last != null && (last + " " + word).length <= letters) lines[lines.length - 1] = last + " " + word;
    else lines.push(word);
  }
  return lines;
};

/** From the least to the greatest of an axis, its limits and the ends of its interval among them. @param {Axis} axis @returns {Range} */
export const extentOf = ({ values, limits, ends }) => {
  const known = [...values.filter(x => x != null), ...limits, ...ends];
  const low = Math.min(...known), high = Math.max(...known), room = high > low ? 0 : Math.abs(low) || 1;
  return known.length === 0 ? [0, 1] : [low - room, high + room];
};

/**
 * The numbers of the samples that go through all ranges.
 * @param {Axis[]} axes @param {Map<number, Range>} ranges @param {number} count
 */
export const chosenOf = (axes, ranges, count) => Array.from({ length: count }, (_, i) => i).filter(i =>
  [...ranges].every(([axis, [low, high]]) => {
    const value = axes[axis].values[i];
    return value != null && value >= low && value <= high;
  }));

/**
 * A range after a key: arrows move it by a twentieth of the axis, with shift its upper end; none of others.
 * @param {string} key @param {boolean} isWider @param {Range | undefined} range @param {Range} extent @returns {Range | null}
 */
export const movedRange = (key, isWider, range, [low, high]) => {
  const step = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[key];
  if (step == null) return null;
  const by = step * (high - low) / 20, [from, until] = range ?? [low + (high - low) / 3, high - (high - low) / 3];
  if (!range) return [from, until];
  if (isWider) return [from, Math.min(high, Math.max(from, until + by))];
  const span = until - from;  // to the very ends, whatever the roundings
  if (until + by >= high) return [high - span, high];
  return from + by <= low ? [low, low + span] : [from + by, until + by];
};

/**
 * Four numbers each, with both axes exchanged if the map is turned.
 * @param {number[]} list @param {boolean} isTurned @returns {[number, number, number, number][]}
 */
export const rectanglesOf = (list, isTurned) => Array.from({ length: list.length / 4 }, (_, i) => {
  const [x, y, width, height] = list.slice(4 * i, 4 * i + 4);
  return isTurned ? [y, x, height, width] : [x, y, width, height];
});

/**
 * Of which two quantities the map says most: where most of it is proved to be met or violated. The first two where nothing is.
 * @param {Record<string, [number[], number[]]>} maps @returns {[number, number]}
 */
export const tellingPair = maps => {
  /** @type {[number, number]} */
  let pair = [0, 1];
  let most = 0;
  for (const [key, lists] of Object.entries(maps)) {
    const area = rectanglesOf(lists.flat(), false).reduce((sum, [, , width, height]) => sum + width * height, 0);
    if (area <= most) continue;
    most = area;
    const [across, upward] = key.split(" ").map(Number);
    pair = [across, upward];
  }
  return pair;
};
