// The machine is seen on the screen as on paper: vectors.json, which tests/reports/vectors_test.cpp reads too.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { dragged, Picture } from "../../../reports/page/scene.js";

const { scene, stances } = JSON.parse(readFileSync(new URL("vectors.json", import.meta.url), "utf8")).picture;

test("shapes are those of paper, at every time and from every side", () => {
  for (const { shapes, ...stance } of stances) {
    const picture = new Picture(scene, stance);
    assert.deepEqual(scene.shapes.map(shape => picture.attributesOf(shape)), shapes, `row ${stance.row}`);
  }
});

test("dragging turns about the vertical, and never upside down", () => {
  const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0), near = (x, y) => assert.ok(Math.abs(x - y) < 1e-8, `${x}, not ${y}`);
  const start = { row: 1, right: scene.right, up: scene.up };
  for (const [across, down] of [[0, 0], [0.7, 0.4], [-2, 0], [0, -9], [0.1, 3], [3, 1.5]]) {
    const { row, right, up } = dragged(start, scene.vertical, across, down);
    assert.equal(row, 1);
    near(dot(right, right), 1);
    near(dot(up, up), 1);
    near(dot(right, up), 0);
    near(dot(right, scene.vertical), dot(start.right, scene.vertical));
    assert.ok(dot(up, scene.vertical) > -1e-9);
  }
  const side = { right: [1, 0, 0], up: [0, 0, 1] }, quarter = dragged(side, [0, 0, 1], Math.PI / 2, 0);
  near(quarter.right[1], -1);
  near(dragged(side, [0, 0, 1], 0, 0.3).up[2], Math.cos(0.3));
});
