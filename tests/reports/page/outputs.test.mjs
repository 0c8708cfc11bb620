// What the page reads of outputs, and the words and columns that it makes of them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { columnsOf, csv, decimal, numberText, readOutput, readoutOf, shownOf, wholes } from "../../../reports/page/outputs.js";

const vectors = JSON.parse(readFileSync(new URL("vectors.json", import.meta.url), "utf8"));

test("whole numbers come back from the differences that were written", () => {
  for (const { numbers, differences } of vectors.differences) assert.deepEqual(wholes(differences), numbers);
});

test("decimals are rounded once", () => {
  for (const { scale, whole, value } of vectors.decimals) assert.equal(decimal(scale)(whole), value);
  assert.equal(decimal(3)(null), null);
});

test("numbers are rounded outward, to as many digits as tell them from each other", () => {
  assert.equal(numberText(null), "none");
  assert.equal(numberText(1 / 3), "0.33333");
  assert.equal(numberText(1 / 3, 1e-6), "0.3333333333");
  assert.equal(numberText(2 / 3, 0, -1), "0.66666");
  assert.equal(numberText(2 / 3, 0, 1), "0.66667");
  assert.equal(numberText(-2 / 3, 0, -1), "-0.66667");
  assert.equal(numberText(0, 1, 1), "0");
});

/** Two times of an output in tenths: a band, the middle, and limits of two requirements. */
const output = () => readOutput(JSON.stringify({
  name: "angle", unit: "rad", middleName: "median", thin: false, scale: -1, middle: [10, 0],
  layers: [
    { name: "sampled", words: "samples", kind: "band", readout: "sampled", spread: true, labels: [], bands: [[[-1, 0], [2, 0]]] },
    { name: "median", words: "median", kind: "line", readout: "", spread: true, labels: [], bands: [[[0, 0]]] },
    { name: "limit", words: "limits", kind: "line", readout: "", spread: false, labels: ["a", "b"], bands: [[[5, null]], [[6, 0]]] },
  ],
  around: null, ratios: [{ words: "overestimation", readout: "ratio", bands: [[[1.5, null]]] }],
}));

test("lines are counted from the middle, which is the motion", () => {
  const [sampled, median, limit] = output().layers;
  assert.deepEqual(sampled.bands, [[[0.9, 0.9], [1.2, 1.2]]]);
  assert.deepEqual(sampled.around, [[[-0.1, -0.1], [0.2, 0.2]]]);
  assert.deepEqual(median.bands, [[[1, 1]]]);
  assert.deepEqual(limit.bands, [[[1.5, null]], [[1.6, 1.6]]]);
});

test("the spread of what was thinned is read for itself", () => {
  const thinned = readOutput(JSON.stringify({
    scale: 0, middle: [1], layers: [{ name: "a", bands: [[[1]]] }], around: [{ name: "a", bands: [[[7]]] }],
  }));
  assert.deepEqual(thinned.layers[0].around, [[[7]]]);
});

test("the first plot shows its layers, and the limits of its requirement", () => {
  assert.equal(shownOf(output(), {}).length, 3);
  const [sampled, limit] = shownOf(output(), { layers: "sampled limit", limits: "1" });
  assert.equal(sampled.name, "sampled");
  assert.deepEqual([limit.labels, limit.bands], [["b"], [[[1.6, 1.6]]]]);
});

test("a readout says what stands at a time", () => {
  assert.equal(readoutOf(output(), [0, 2], 0), "t = 0 s · sampled [0.9, 1.2] · ratio 1.5 (rad)");
  assert.equal(readoutOf(output(), [0, 2], 1), "t = 2 s · sampled [0.9, 1.2] (rad)");
});

test("columns hold every layer, and CSV quotes what it has to", () => {
  const whole = output();
  const text = csv(columnsOf(whole, [0, 2], whole.layers, whole.ratios));
  assert.equal(text, "time (s),\"angle, samples, from (rad)\",\"angle, samples, to (rad)\",\"angle, median (rad)\",\"angle, a (rad)\"," +
    "\"angle, b (rad)\",\"angle, overestimation\"\n0,0.9,1.2,1,1.5,1.6,1.5\n2,0.9,1.2,1,,1.6,\n");
  assert.equal(csv([["a\"b", 1]]), "\"a\"\"b\"\n1\n");
});
