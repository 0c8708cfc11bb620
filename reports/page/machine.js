// Moves the picture of the machine: through time by a slider or by itself, and, for all that is not seen from the side,
// around as it is dragged. The drawing has an element for each shape of the scene already. Without this script the machine
// stands at its start.
"use strict";

import { all, chooseTime, followTime, made, makeSwitches, nearestTo, one, press, pressable } from "./dom.js";
import { dragged, Picture } from "./scene.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Place} Place */

class Machine {
  /** @param {HTMLElement} place @param {Scene} scene */
  constructor(place, scene) {
    this.scene = scene;
    this.place = place;
    this.elements = /** @type {Element[]} */ (all("[data-shape]", place));
    this.start = { row: 0, right: scene.right, up: scene.up };
    this.stance = this.start;
    this.controls = made("div", { className: "controls" });
    one("svg", place).after(this.controls);
    /** @type {(row: number) => void} */
    this.onRow = () => {};
    if (scene.time.length > 1) this.addTime();
    this.views = made("span", { className: "views" }, this.controls);
    this.addViews();
    this.followPointer(one("svg", place));
    makeSwitches(".picture .keys li", (layer, isShown) => {
      for (const element of all("[data-shape='" + layer + "']", place)) element.style.display = isShown ? "" : "none";
    });
    this.followPrinter(one("figcaption", place));
    place.classList.add("turns");
    this.go(0);
  }

  /** @param {boolean} isWhole what is swept takes longer to draw */
  draw(isWhole) {
    const picture = new Picture(this.scene, this.stance);
    /** @type {DOMRect[]} */
    const names = [];
    this.elements.forEach((element, i) => {
      const shape = this.scene.shapes[i];
      if (shape[0] === "swept" && !isWhole) return;
      const attributes = picture.attributesOf(shape);
      element.setAttribute("visibility", attributes ? "visible" : "hidden");
      for (const [name, value] of Object.entries(attributes ?? {})) element.setAttribute(name, value);
      if (shape[0] === "name" && attributes) this.fit(/** @type {SVGTextElement} */ (element), Number(attributes.x), names);
    });
  }

  /** A name stays within the paper, and none lies over those before it. @param {SVGTextElement} name @param {number} x @param {DOMRect[]} before */
  fit(name, x, before) {
    const isTight = x + name.getComputedTextLength() > this.scene.width;
    name.style.textAnchor = isTight ? "end" : "start";
    if (isTight) name.setAttribute("x", String(x - 30));
    const its = name.getBBox();
    // Of lines of text: those of one place stand above each other.
    const isApart = before.every(other => its.x + its.width <= other.x || other.x + other.width <= its.x ||
      Math.abs(its.y - other.y) >= 0.8 * its.height);
    if (isApart) before.push(its);
    else name.setAttribute("visibility", "hidden");
  }

  /** @param {number} row */
  go(row) {
    this.stance = { ...this.stance, row };
    this.draw(false);
    this.onRow(row);
  }

  /** @param {{right: Place, up: Place}} side */
  look(side) {
    this.stance = { ...this.stance, ...side };
    this.draw(true);
  }

  addTime() {
    const { time } = this.scene, last = time.length - 1, seconds = Math.min(Math.max(time[last], 3), 12);  // that playing takes
    let playing = 0;
    const play = made("button", { type: "button", textContent: "Play" }, this.controls);
    const slider = made("input", { type: "range", min: "0", max: String(last), step: "1", value: "0" }, this.controls);
    slider.setAttribute("aria-label", "Time");
    const shown = made("output", {}, this.controls);
    this.onRow = row => {
      slider.value = String(row);
      shown.textContent = "t = " + Number(time[row].toPrecision(5)) + " s";
    };
    const stop = () => {
      cancelAnimationFrame(playing);
      playing = 0;
      play.textContent = "Play";
    };
    /** @param {number} at */
    const follow = at => {
      stop();
      this.go(nearestTo(time, at));
    };
    followTime(follow);
    slider.addEventListener("input", () => {
      stop();
      this.go(Number(slider.value));
      chooseTime(time[this.stance.row], follow);
    });
    play.addEventListener("click", () => {
      if (playing) {
        stop();
        return;
      }
      if (this.stance.row === last) this.go(0);
      const from = time[this.stance.row], began = performance.now();
      /** @param {number} now */
      const step = now => {
        const t = from + (now - began) / 1000 * time[last] / seconds, next = time.findLastIndex(at => at <= t);
        this.go(Math.max(next, this.stance.row));
        chooseTime(time[this.stance.row], follow);
        if (this.stance.row === last) stop();
        else playing = requestAnimationFrame(step);
      };
      play.textContent = "Pause";
      playing = requestAnimationFrame(step);
    });
  }

  addViews() {
    const { right, up } = this.start, [x, y, z] = /** @type {Place[]} */ ([[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    /** @param {string} name @param {Place} across @param {Place} upwards */
    const add = (name, across, upwards) => {
      this.views.append(pressable([name], this.views.childElementCount === 0, button => {
        for (const other of this.views.children) press(other, other === button);
        this.look({ right: across, up: upwards });
      }));
    };
    add(this.scene.isSide ? "Side view" : "Space", right, up);
    if (this.scene.isSide) return;
    add("x–z", x, z);
    add("y–z", y, z);
    add("x–y", x, y);
  }

  /** @param {HTMLElement} svg */
  followPointer(svg) {
    const { moving, time, vertical } = this.scene, isQuick = time.length * moving.length <= 1500;
    /** @type {[number, number] | null} */
    let grip = null;
    let pending = false;
    svg.addEventListener("pointerdown", event => {
      grip = [event.clientX, event.clientY];
      svg.setPointerCapture(event.pointerId);
      event.preventDefault();
    });
    svg.addEventListener("pointermove", ({ clientX, clientY }) => {
      if (!grip) return;
      this.stance = dragged(this.stance, vertical, (clientX - grip[0]) / 150, (clientY - grip[1]) / 150);
      grip = [clientX, clientY];
      for (const other of this.views.children) press(other, false);
      if (pending) return;
      pending = true;
      requestAnimationFrame(() => {
        pending = false;
        this.draw(isQuick);
      });
    });
    const release = () => {
      if (grip) this.draw(true);
      grip = null;
    };
    svg.addEventListener("pointerup", release);
    svg.addEventListener("pointercancel", release);
  }

  /** Paper shows the machine at its start. @param {HTMLElement} caption */
  followPrinter(caption) {
    const printed = caption.textContent ?? "", { start } = this;
    caption.textContent = printed.replace(", at the start", "") + " Drag to turn it.";
    /** @type {[typeof start, string | null] | null} */
    let before = null;
    window.addEventListener("beforeprint", () => {
      before = [this.stance, caption.textContent];
      caption.textContent = printed;
      this.look(start);
    });
    window.addEventListener("afterprint", () => {
      if (!before) return;
      [, caption.textContent] = before;
      this.look(before[0]);
    });
  }
}

const numbers = document.getElementById("machine");
if (numbers) new Machine(one(".picture"), JSON.parse(numbers.textContent ?? ""));
