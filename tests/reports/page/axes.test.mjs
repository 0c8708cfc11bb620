// Ticks and ranges of the screen are those of paper: vectors.json, which tests/reports/vectors_test.cpp reads too.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { axisName, padded, ticks } from "../../../reports/page/axes.js";

const vectors = JSON.parse(readFileSync(new URL("vectors.json", import.meta.url), "utf8"));

test("ticks are those of paper", () => {
  for (const { low, high, wanted, at, text, aside } of vectors.ticks) {
    assert.deepEqual(ticks(low, high, wanted), { at, text, aside }, `${low} to ${high}`);
  }
});

test("ranges have the room that they have on paper", () => {
  for (const { low, high, share, room } of vectors.padded) assert.deepEqual(padded(low, high, share), room);
  assert.deepEqual(padded(null, null, 0.04), [0, 1]);
});

test("axes are named with what their ticks are counted in", () => {
  for (const { name, aside, whole } of vectors.axisNames) assert.equal(axisName(name, aside), whole);
});
