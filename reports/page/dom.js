// Elements of the page, found and made.
"use strict";

/** @param {string} selector @param {ParentNode} [within] @returns {HTMLElement} */
export const one = (selector, within = document) => /** @type {HTMLElement} */ (within.querySelector(selector));

/** @param {string} selector @param {ParentNode} [within] @returns {HTMLElement[]} */
export const all = (selector, within = document) => Array.from(within.querySelectorAll(selector));

/**
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag @param {Partial<HTMLElementTagNameMap[Tag]>} properties @param {ParentNode} [parent]
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export const made = (tag, properties, parent) => {
  const element = Object.assign(document.createElement(tag), properties);
  parent?.append(element);
  return element;
};

/** Puts what is there without scripts too, and takes long to read, in the place of its text. @param {ParentNode} [within] */
export const readDrawings = (within = document) => {
  for (const text of all(".static > noscript", within)) text.outerHTML = text.textContent ?? "";
};

/** @param {Element} element @param {unknown} isPressed */
export const press = (element, isPressed) => element.setAttribute("aria-pressed", String(Boolean(isPressed)));

/**
 * A button that shows what it is for, and whether it is pressed.
 * @param {(Node | string)[]} words @param {boolean} isPressed @param {(button: HTMLButtonElement) => void} onPress
 */
export const pressable = (words, isPressed, onPress) => {
  const button = made("button", { type: "button" });
  press(button, isPressed);
  button.append(...words);
  button.addEventListener("click", () => onPress(button));
  return button;
};

/** @typedef {(time: number) => void} Follow */

/** @type {Set<Follow>} */
const followers = new Set();

/** Calls it with every time [s] that somebody chooses anywhere on the page. @param {Follow} follow */
export const followTime = follow => {
  followers.add(follow);
};

/** All but who chose it follow. @param {number} time @param {Follow} [chooser] */
export const chooseTime = (time, chooser) => {
  for (const follow of followers) if (follow !== chooser) follow(time);
};

/** A sample's motion of an output. @typedef {{time: number[], values: (number | null)[], isMissed: boolean}} Curve */
/** The curves of the samples that are chosen, of an output by its number. @typedef {(output: string) => Curve[]} CurvesOf */

/** @type {Set<(curvesOf: CurvesOf | null) => void>} */
const curveFollowers = new Set();

/** Calls it with every choice of samples on the page; none: no sample is chosen. @param {(curvesOf: CurvesOf | null) => void} follow */
export const followCurves = follow => {
  curveFollowers.add(follow);
};

/** @param {CurvesOf | null} curvesOf */
export const chooseCurves = curvesOf => {
  for (const follow of curveFollowers) follow(curvesOf);
};

/** Of times that rise, the place of the nearest. @param {number[]} times @param {number} time */
export const nearestTo = (times, time) => {
  const behind = times.findIndex(at => at >= time);
  if (behind <= 0) return behind < 0 ? times.length - 1 : 0;
  return times[behind] - time < time - times[behind - 1] ? behind : behind - 1;
};

/**
 * Makes a switch of each entry of a key: what happens as its layer is shown or hidden.
 * @param {string} entries @param {(layer: string, isShown: boolean) => void} onSwitch
 */
export const makeSwitches = (entries, onSwitch) => {
  for (const item of all(entries)) {
    item.append(pressable([...item.childNodes], true, button => {
      const isShown = button.getAttribute("aria-pressed") !== "true";
      press(button, isShown);
      onSwitch(item.dataset.layer ?? "", isShown);
    }));
  }
};
