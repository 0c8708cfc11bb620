// Which samples go through chosen ranges, and what keys make of a range.
import assert from "node:assert/strict";
import { test } from "node:test";

import { chosenOf, extentOf, movedRange, rectanglesOf, tellingPair, wrapped } from "../../../reports/page/choice.js";

test("names are wrapped between words", () => {
  assert.deepEqual(wrapped("acceleration of the body at its worst", 13), ["acceleration", "of the body", "at its worst"]);
  assert.deepEqual(wrapped("mass", 13), ["mass"]);
});

test("axes hold their values and limits, and have an extent where all are alike", () => {
  assert.deepEqual(extentOf({ values: [1, null, 3], limits: [5], ends: [] }), [1, 5]);
  assert.deepEqual(extentOf({ values: [1, null, 3], limits: [], ends: [0.5, 3.5] }), [0.5, 3.5]);
  assert.deepEqual(extentOf({ values: [2, 2], limits: [], ends: [] }), [0, 4]);
  assert.deepEqual(extentOf({ values: [0, 0], limits: [], ends: [] }), [-1, 1]);
  assert.deepEqual(extentOf({ values: [null], limits: [], ends: [] }), [0, 1]);
});

test("places of a map are exchanged where its axes are", () => {
  assert.deepEqual(rectanglesOf([1, 2, 3, 4, 5, 6, 7, 8], false), [[1, 2, 3, 4], [5, 6, 7, 8]]);
  assert.deepEqual(rectanglesOf([1, 2, 3, 4], true), [[2, 1, 4, 3]]);
  assert.deepEqual(rectanglesOf([], true), []);
});

test("the map begins with the two quantities of which it says most", () => {
  assert.deepEqual(tellingPair({}), [0, 1]);
  assert.deepEqual(tellingPair({ "0 1": [[], []], "0 2": [[], []] }), [0, 1]);
  assert.deepEqual(tellingPair({ "0 1": [[0, 0, 2, 2], []], "0 2": [[0, 0, 1, 1], [1, 1, 2, 2]], "1 2": [[0, 0, 1, 5], []] }), [0, 2]);
});

test("samples are chosen that go through all ranges; those without a value go through none", () => {
  const axes = [{ values: [1, 2, 3, null] }, { values: [9, 8, 7, 6] }];
  assert.deepEqual(chosenOf(axes, new Map(), 4), [0, 1, 2, 3]);
  assert.deepEqual(chosenOf(axes, new Map([[0, [2, 3]]]), 4), [1, 2]);
  assert.deepEqual(chosenOf(axes, new Map([[0, [2, 3]], [1, [7, 7]]]), 4), [2]);
});

test("a key begins a range, moves it within the axis, and widens it", () => {
  assert.deepEqual(movedRange("ArrowUp", false, undefined, [0, 30]), [10, 20]);
  assert.deepEqual(movedRange("ArrowUp", false, [10, 20], [0, 20]), [10, 20]);
  assert.deepEqual(movedRange("ArrowDown", false, [10, 20], [0, 20]), [9, 19]);
  assert.deepEqual(movedRange("ArrowUp", true, [5, 10], [0, 20]), [5, 11]);
  assert.deepEqual(movedRange("ArrowDown", true, [5, 5], [0, 20]), [5, 5]);
  assert.equal(movedRange("a", false, [5, 10], [0, 20]), null);
});
