// The samples that were kept, to be chosen among: an axis each quantity and output, a line each sample across them. What is
// dragged along an axis, or moved by keys, chooses the samples that go through it; the curves of these are seen in the
// outputs' plots. Below, two quantities as a map. Samples that violate the requirement are dashed and red, and crosses.
"use strict";

import { chosenOf, extentOf, movedRange, rectanglesOf, tellingPair, wrapped } from "./choice.js";
import { all, chooseCurves, made, one } from "./dom.js";

/** @typedef {import("./choice.js").Axis} Axis */
/** @typedef {import("./choice.js").Range} Range */
/** A state each sample: "+" met, "-" violated, "?" it did not arrive.
 * @typedef {{name: string, states: string, met: Range[] | null, violated: (number | null)[], cells: Cells | null}} Requirement */
/** Of each pair of quantities, "0 1", places of a square that are met, and that are violated, whatever the others are: each four
 * numbers, left, bottom, width, height.
 * @typedef {{size: number, count: number, open: number, maps: Record<string, [number[], number[]]>}} Cells */
/** @typedef {{low: number | null, step: number, lines: (number | null)[][]}} Curves */
/** @typedef {{samples: string[], axes: Axis[], requirements: Requirement[], curves: {time: number[]} & Record<string, Curves>}} Explored */

/** @param {number} x */
const shortNumber = x => Number(x.toPrecision(4)).toString();

/** @param {string} name @param {Record<string, string | number>} attributes @param {Element} parent */
const svgShape = (name, attributes, parent) => {
  const element = parent.appendChild(document.createElementNS("http://www.w3.org/2000/svg", name));
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
};

const aboveAxes = 22, axesHigh = 260, wordsHigh = 80;

class Explorer {
  /** @param {HTMLElement} place @param {Explored} explored */
  constructor(place, explored) {
    this.explored = explored;
    this.place = place;
    /** @type {Map<number, Range>} */
    this.ranges = new Map();
    this.extents = explored.axes.map(extentOf);
    this.requirement = explored.requirements.at(0);
    const bar = made("div", { className: "controls" }, place);
    this.addChoices(bar);
    this.said = made("output", {}, bar);
    const clear = made("button", { type: "button", textContent: "All samples" }, bar);
    clear.addEventListener("click", () => {
      this.ranges.clear();
      this.show();
    });
    made("p", { className: "hint", textContent: "Drag along an axis to choose samples, or use the arrow keys on it (with Shift: " +
      "the upper end; Escape: all). Their curves are seen in the plots of outputs that are unfolded." }, place);
    this.key = made("ul", { className: "keys" }, place);
    this.wide = made("div", { className: "parallel" }, place);
    this.map = explored.axes.filter(({ isQuantity }) => isQuantity).length > 1 ? made("div", { className: "map" }, place) : null;
    const [across, upward] = tellingPair(this.requirement?.cells?.maps ?? {});
    this.across = across;
    this.upward = upward;
    this.drawAll();
    new ResizeObserver(() => {
      if (this.wide.clientWidth > 0 && this.wide.clientWidth !== this.width) this.drawAll();
    }).observe(place);
  }

  /** @param {HTMLElement} bar */
  addChoices(bar) {
    const { requirements } = this.explored;
    if (requirements.length < 2) return;
    const label = made("label", { className: "choose", textContent: "Coloured by " }, bar), choice = made("select", {}, label);
    requirements.forEach(({ name }, i) => made("option", { value: String(i), textContent: name }, choice));
    choice.addEventListener("change", () => {
      this.requirement = requirements[Number(choice.value)];
      this.drawAll();
    });
  }

  /** @param {number} i */
  kindOf(i) {
    const state = this.requirement?.states[i];
    return state === "-" ? "missed" : state === "?" ? "open" : "met";
  }

  drawAll() {
    this.drawKey();
    this.drawParallel();
    this.drawMap();
    this.show();
  }

  drawKey() {
    this.key.replaceChildren();
    if (!this.requirement) return;
    const { name, states } = this.requirement;
    for (const [kind, sign, words] of [["missed", "-", "violate"], ["met", "+", "meet"], ["open", "?", "do not arrive for"]]) {
      const count = [...states].filter(state => state === sign).length;
      if (count === 0) continue;
      const item = made("li", {}, this.key);
      made("span", { className: "swatch explored-" + kind }, item);
      item.append(count + " " + words + " “" + name + "”");
    }
  }

  // ---- Parallel axes --------------------------------------------------------------------------------------------------

  drawParallel() {
    const { axes, samples } = this.explored, letters = 13;
    this.width = this.wide.clientWidth;
    const apart = Math.max(92, (this.width || 800) / axes.length), width = apart * axes.length;
    this.wide.replaceChildren();
    const svg = svgShape("svg", { class: "drawing explored", viewBox: [0, 0, width, aboveAxes + axesHigh + wordsHigh].join(" "), width,
      height: aboveAxes + axesHigh + wordsHigh, role: "group", "aria-label": "Axes of quantities and outputs, a line each sample" }, this.wide);
    this.xs = axes.map((_, k) => apart * (k + 0.5));
    const order = samples.map((_, i) => i).sort((a, b) => Number(this.kindOf(a) === "missed") - Number(this.kindOf(b) === "missed"));
    this.lines = new Map(order.map(i => [i, svgShape("path", { class: "sample " + this.kindOf(i), d: this.pathOf(i) }, svg)]));
    this.handles = axes.map((axis, k) => {
      const group = svgShape("g", { class: "axis", tabindex: 0, role: "slider", "aria-orientation": "vertical" }, svg), x = this.xs?.[k] ?? 0;
      svgShape("rect", { class: "ground", x: x - 18, y: aboveAxes, width: 36, height: axesHigh }, group);
      svgShape("path", { class: "line", d: "M" + x + " " + aboveAxes + "v" + axesHigh }, group);
      for (const limit of axis.limits) svgShape("path", { class: "limit", d: "M" + (x - 9) + " " + this.down(k, limit) + "h18" }, group);
      svgShape("text", { class: "middle", x, y: aboveAxes - 8 }, group).textContent = shortNumber(this.extents[k][1]);
      svgShape("text", { class: "middle", x, y: aboveAxes + axesHigh + 14 }, group).textContent = shortNumber(this.extents[k][0]);
      [...wrapped(axis.name, letters).slice(0, 3), axis.unit].filter(Boolean).forEach((line, i) => {
        const kind = line === axis.unit ? "middle" : "middle bar";
        svgShape("text", { class: kind, x, y: aboveAxes + axesHigh + 29 + 12 * i }, group).textContent = line;
      });
      this.followHands(group, k);
      return { group, range: svgShape("rect", { class: "range", x: x - 7, width: 14, y: 0, height: 0 }, group) };
    });
  }

  /** @param {number} axis @param {number} value */
  down(axis, value) {
    const [low, up] = this.extents[axis];
    return aboveAxes + axesHigh * (up - value) / (up - low);
  }

  /** @param {number} i */
  pathOf(i) {
    let isBegun = false;
    return this.explored.axes.map(({ values }, k) => {
      const value = values[i];
      if (value == null) {
        isBegun = false;
        return "";
      }
      const letter = isBegun ? "L" : "M";
      isBegun = true;
      return letter + (this.xs?.[k] ?? 0).toFixed(1) + " " + this.down(k, value).toFixed(1);
    }).join("");
  }

  /** @param {Element} element @param {number} axis */
  followHands(element, axis) {
    const group = /** @type {SVGGElement} */ (element), [low, up] = this.extents[axis];
    /** @param {PointerEvent} event */
    const valueAt = event => {
      const box = /** @type {SVGSVGElement} */ (group.ownerSVGElement).getBoundingClientRect();
      const share = (event.clientY - box.top - aboveAxes) / axesHigh;
      return share >= 1 ? low : up - Math.max(0, share) * (up - low);
    };
    let begun = NaN;
    group.addEventListener("pointerdown", event => {
      begun = valueAt(event);
      group.setPointerCapture(event.pointerId);
    });
    group.addEventListener("pointermove", event => {
      if (Number.isNaN(begun)) return;
      const now = valueAt(event);
      if (Math.abs(now - begun) > (up - low) / 60) this.setRange(axis, [Math.min(begun, now), Math.max(begun, now)]);
    });
    group.addEventListener("pointerup", event => {
      if (Math.abs(valueAt(event) - begun) <= (up - low) / 60) this.setRange(axis, null);
      begun = NaN;
    });
    group.addEventListener("lostpointercapture", () => {
      begun = NaN;
    });
    group.addEventListener("keydown", event => {
      const moved = movedRange(event.key, event.shiftKey, this.ranges.get(axis), this.extents[axis]);
      if (!moved && event.key !== "Escape") return;
      event.preventDefault();
      this.setRange(axis, moved);
    });
  }

  /** @param {number} axis @param {Range | null} range */
  setRange(axis, range) {
    if (range) this.ranges.set(axis, range);
    else this.ranges.delete(axis);
    this.show();
  }

  // ---- The map of two quantities --------------------------------------------------------------------------------------

  drawMap() {
    if (!this.map) return;
    const { axes, samples } = this.explored, quantities = axes.map((_, k) => k).filter(k => axes[k].isQuantity);
    this.map.replaceChildren();
    const bar = made("div", { className: "controls" }, this.map);
    for (const side of /** @type {("across" | "upward")[]} */ (["across", "upward"])) {
      const label = made("label", { className: "choose", textContent: side === "across" ? "To the right " : "Upward " }, bar);
      const choice = made("select", {}, label);
      for (const k of quantities) made("option", { value: String(k), textContent: axes[k].name, selected: k === this[side] }, choice);
      choice.addEventListener("change", () => {
        this[side] = Number(choice.value);
        this.drawMap();
        this.show();
      });
    }
    const width = Math.min(480, this.width || 480), left = 60, size = width - left - 14, height = Math.round(0.7 * size);
    const svg = svgShape("svg", { class: "drawing explored", viewBox: [0, 0, width, height + 60].join(" "), width, height: height + 60,
      role: "img", "aria-label": "Samples by " + axes[this.across].name + " and " + axes[this.upward].name }, this.map);
    const [x0, x1] = this.extents[this.across], [y0, y1] = this.extents[this.upward];
    /** @param {number} x */
    const right = x => left + size * (x - x0) / (x1 - x0);
    /** @param {number} y */
    const down = y => 10 + height * (y1 - y) / (y1 - y0);
    svgShape("rect", { class: "frame", x: left, y: 10, width: size, height }, svg);
    this.drawCells(svg, right, down);
    this.drawProved(svg, right, down);
    this.points = new Map(samples.map((_, i) => {
      const x = right(axes[this.across].values[i] ?? NaN), y = down(axes[this.upward].values[i] ?? NaN), kind = this.kindOf(i);
      const cross = "M" + (x - 3.5) + " " + (y - 3.5) + "l7 7m0 -7l-7 7", ring = "M" + (x - 2.5) + " " + y + "a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0";
      return [i, svgShape("path", { class: "point " + kind, d: kind === "missed" ? cross : ring }, svg)];
    }));
    for (const [value, anchor] of /** @type {[number, string][]} */ ([[x0, ""], [x1, "end"]])) {
      svgShape("text", { class: anchor, x: right(value), y: height + 25 }, svg).textContent = shortNumber(value);
    }
    for (const value of [y0, y1]) svgShape("text", { class: "end", x: left - 6, y: down(value) + 4 }, svg).textContent = shortNumber(value);
    /** @param {Axis} axis */
    const words = ({ name, unit }) => name + (unit ? " (" + unit + ")" : "");
    svgShape("text", { class: "middle bar", x: left + size / 2, y: height + 42 }, svg).textContent = words(axes[this.across]);
    const turned = "translate(14 " + (10 + height / 2) + ") rotate(-90)";
    svgShape("text", { class: "middle bar", transform: turned }, svg).textContent = words(axes[this.upward]);
    const said = made("div", {}, this.map);
    this.drawKeyOfMap(said);
    made("p", { className: "hint", textContent: this.wordsOfMap() }, said);
  }

  /** @param {HTMLElement} place */
  drawKeyOfMap(place) {
    const { cells } = this.requirement ?? { cells: null };
    if (!cells) return;
    const keys = made("ul", { className: "keys" }, place), areas = this.places().map(places => places.reduce((sum, [, , w, h]) => sum + w * h, 0));
    const shares = [...areas, cells.size * cells.size - areas[0] - areas[1]].map(area => Math.round(100 * area / (cells.size * cells.size)));
    const others = this.explored.axes.filter(({ isQuantity }) => isQuantity).length > 2 ? ", whatever the other quantities are" : "";
    [["met", "proved to be met"], ["violated", "proved to be violated"], ["undecided", "undecided, or it depends on the other quantities"]]
      .forEach(([kind, words], k) => {
        const item = made("li", {}, keys);
        made("span", { className: "swatch hatched-" + kind }, item);
        item.append(words + (k < 2 ? others : "") + ": " + shares[k] + " % of the map");
      });
  }

  /** The places of the map that are met, and that are violated. @returns {[number, number, number, number][][]} */
  places() {
    const { cells } = this.requirement ?? { cells: null }, { across, upward } = this, isTurned = across > upward;
    if (!cells || across === upward) return [[], []];
    return cells.maps[Math.min(across, upward) + " " + Math.max(across, upward)].map(list => rectanglesOf(list, isTurned));
  }

  /** Where a proof is known: hatched, once where the requirement is met, twice where it is violated. @param {Element} svg
   * @param {(x: number) => number} right @param {(y: number) => number} down */
  drawCells(svg, right, down) {
    const { cells } = this.requirement ?? { cells: null }, { axes } = this.explored;
    if (!cells) return;
    const { size } = cells, [a, b] = axes[this.across].ends, [c, d] = axes[this.upward].ends;
    /** @param {number} place */
    const x = place => right(a + (b - a) * place / size).toFixed(1);
    /** @param {number} place */
    const y = place => down(c + (d - c) * place / size).toFixed(1);
    const defs = svgShape("defs", {}, svg);
    this.places().forEach((places, k) => {
      const kind = k === 0 ? "met" : "violated", id = "hatch-" + kind;
      const pattern = svgShape("pattern", { id, class: id, width: 7, height: 7, patternUnits: "userSpaceOnUse" }, defs);
      svgShape("rect", { width: 7, height: 7 }, pattern);
      svgShape("path", { d: k === 0 ? "M-1 8L8 -1" : "M-1 8L8 -1M-1 -1L8 8" }, pattern);
      const path = places.map(([l, t, w, h]) => "M" + x(l) + " " + y(t) + "H" + x(l + w) + "V" + y(t + h) + "H" + x(l) + "Z").join("");
      svgShape("path", { class: "cells " + kind, d: path }, svg);
    });
  }

  /** @param {Element} svg @param {(x: number) => number} right @param {(y: number) => number} down */
  drawProved(svg, right, down) {
    const { met, violated } = this.requirement ?? { met: null, violated: [] };
    if (met) {
      const [[a, b], [c, d]] = [met[this.across], met[this.upward]];
      svgShape("rect", { class: "proved", x: right(a), y: down(d), width: right(b) - right(a), height: down(c) - down(d) }, svg);
    }
    const x = violated[this.across], y = violated[this.upward];
    if (x != null && y != null) svgShape("path", { class: "refuted", d: "M" + right(x) + " " + (down(y) - 6) + "l6 6l-6 6l-6 -6z" }, svg);
  }

  wordsOfMap() {
    const { met, violated } = this.requirement ?? { met: null, violated: [] }, words = [];
    if (this.requirement) words.push("Rings: samples that meet it; crosses: samples that violate it.");
    if (met) {
      words.push("Green frame: it is proved to be met there as long as no other quantity deviates by a greater share of its " +
        "tolerance than the frame shows.");
    }
    if (violated[this.across] != null && violated[this.upward] != null) {
      words.push("Filled diamond: values for which it is proved to be violated.");
    }
    if (this.requirement?.cells) {
      const { count, open } = this.requirement.cells;
      words.push("Of " + count + (count === 1 ? " part" : " parts") + " of the box that were looked at, " + (open || "none") +
        (open === 1 ? " is" : " are") + " undecided.");
    } else if (this.requirement) {
      words.push("Elsewhere the results hold no proof for single places.");
    }
    return words.join(" ");
  }

  // ---- What is chosen -------------------------------------------------------------------------------------------------

  show() {
    const { axes, samples, curves } = this.explored, chosen = chosenOf(axes, this.ranges, samples.length), isAll = this.ranges.size === 0;
    const seen = new Set(chosen);
    for (const shapes of [this.lines, this.points]) shapes?.forEach((shape, i) => shape.classList.toggle("faded", !seen.has(i)));
    this.handles?.forEach(({ group, range }, k) => this.showRange(group, range, k));
    const missed = chosen.filter(i => this.kindOf(i) === "missed").length;
    this.said.textContent = chosen.length + " of " + samples.length + " chosen" + (this.requirement ? ", " + missed + " violate it" : "");
    chooseCurves(isAll ? null : output => {
      const known = curves[output];
      return !known || known.low == null ? [] : chosen.map(i => ({
        time: curves.time, isMissed: this.kindOf(i) === "missed",
        values: known.lines[i].map(x => x == null ? null : (known.low ?? 0) + x * known.step),
      })).sort((a, b) => Number(a.isMissed) - Number(b.isMissed));
    });
  }

  /** @param {Element} group @param {Element} shape @param {number} axis */
  showRange(group, shape, axis) {
    const range = this.ranges.get(axis), [low, up] = this.extents[axis], { name, unit } = this.explored.axes[axis];
    const [from, until] = range ?? [low, up];
    shape.setAttribute("y", String(this.down(axis, until)));
    shape.setAttribute("height", String(range ? Math.max(2, this.down(axis, from) - this.down(axis, until)) : 0));
    group.setAttribute("aria-label", "Range of " + name);
    const share = Math.round(100 * ((from + until) / 2 - low) / (up - low));  // numbers of any size are told as text
    for (const [key, value] of [["min", 0], ["max", 100], ["now", share]]) group.setAttribute("aria-value" + key, String(value));
    group.setAttribute("aria-valuetext", range ? shortNumber(from) + " to " + shortNumber(until) + " " + unit : "all");
  }
}

for (const data of all("script.explored")) {
  const section = /** @type {HTMLElement} */ (data.closest("section")), fold = /** @type {HTMLDetailsElement | null} */ (data.closest("details"));
  let isMade = false;
  const make = () => {
    if (isMade || fold && !fold.open) return;
    isMade = true;
    new Explorer(one(".explorer-live", section), JSON.parse(data.textContent ?? ""));
  };
  fold?.addEventListener("toggle", make);
  make();
}
