// What is known of an output at the time of the page, on the axis of its plot: to the right how probable it is that it is not
// above a value, to the left how possible the value is. The shapes are those of paper (reports/drawing/beside.hpp).
"use strict";

import { ticks } from "./axes.js";
import { all, nearestTo } from "./dom.js";

const wide = 1000, high = 10000, label = 18;

/** @param {string} name @param {Record<string, string | number>} attributes @param {Element} parent */
const shape = (name, attributes, parent) => {
  const element = parent.appendChild(document.createElementNS(parent.namespaceURI, name));
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
};

export class Beside {
  /** @param {string} drawing @param {HTMLElement} place */
  constructor(drawing, place) {
    place.insertAdjacentHTML("beforeend", drawing);
    this.svg = /** @type {Element} */ (place.lastElementChild);
    this.moments = all("g.moment", this.svg);
    this.times = this.moments.map(({ dataset }) => Number(dataset.at));
    this.frame = shape("g", {}, this.svg);
    this.window = shape("svg", { class: "window" }, this.svg);
    this.window.append(...this.moments);
    this.width = 200;
  }

  /** How much room it has: to ask the page for it at every time would take longer than all else. */
  measure() {
    this.width = this.svg.clientWidth || this.width;
  }

  /**
   * @param {uPlot} plot @param {number | null} time none: nothing is shown @param {boolean} isSpread
   * @param {(number | null)[][]} limits
   */
  draw(plot, time, isSpread, limits) {
    const { min = 0, max = 0 } = plot.scales.y, px = devicePixelRatio;
    const top = plot.bbox.top / px, height = plot.bbox.height / px, { width } = this;
    this.svg.setAttribute("viewBox", [0, 0, width, plot.height].join(" "));
    this.svg.setAttribute("height", String(plot.height));
    this.svg.classList.toggle("narrow", width < 180);
    this.svg.toggleAttribute("hidden", time == null);
    if (time == null || !(max > min)) return;
    const at = nearestTo(this.times, time), { low, high: up, middle = "0", when } = this.moments[at].dataset;
    const around = isSpread ? Number(middle) : 0;
    /** @param {number} value */
    const down = value => height * (max - value) / (max - min);
    const bottom = down(Number(low) - around), side = (width - 16) / 2;
    const across = side / wide, upwards = (bottom - down(Number(up) - around)) / high;
    this.moments.forEach((moment, i) => moment.toggleAttribute("hidden", i !== at));
    this.moments[at].setAttribute("transform", "matrix(" + [across, 0, 0, upwards, width / 2, bottom].join(" ") + ")");
    for (const [name, value] of Object.entries({ y: top, width, height })) this.window.setAttribute(name, String(value));
    const isElsewhere = Math.abs(this.times[at] - time) > 1e-3 * Math.abs(time);
    this.drawFrame({ top, height, width, side, down, min, max }, "at " + when + (isElsewhere ? " (nearest known)" : ""), limits);
  }

  /**
   * @param {{top: number, height: number, width: number, side: number, down: (value: number) => number, min: number, max: number}} on
   * @param {string} words @param {(number | null)[][]} limits
   */
  drawFrame({ top, height, width, side, down, min, max }, words, limits) {
    const middle = width / 2, end = top + height, wanted = Math.max(2, Math.floor(height / 45));
    this.frame.replaceChildren();
    /** @param {string} kind @param {number} y */
    const level = (kind, y) => {
      if (y >= 0 && y <= height) shape("path", { class: kind, d: "M" + (middle - side) + " " + (top + y) + "h" + 2 * side }, this.frame);
    };
    for (const value of ticks(min, max, wanted).at) level("grid", down(value));
    for (const x of [-side, 0, side]) shape("path", { class: "grid", d: "M" + (middle + x) + " " + top + "v" + height }, this.frame);
    for (const line of limits) {
      const value = line.find(x => x != null);
      if (value != null) level("limit", down(value));
    }
    /** @param {number} x @param {number} y @param {string} text */
    const write = (x, y, text) => { shape("text", { class: "middle", x, y }, this.frame).textContent = text; };
    write(middle - side + 4, end + 14, "1");
    write(middle, end + 14, "0");
    write(middle + side - 4, end + 14, "1");
    write(middle - side / 2, end + 14 + label, "membership");
    write(middle + side / 2, end + 14 + label, "probability");
    write(middle, Math.max(10, top - 4), words);
  }
}
