// Two small buttons at each figure: its numbers as CSV to the clipboard, and the figure as an SVG file that needs nothing
// beside it.
"use strict";

import { all, made, one, readDrawings } from "./dom.js";
import { csv } from "./outputs.js";

/** Names of the layers that the reader has switched off. @type {Set<string>} */
export const hidden = new Set();

/** @param {string} text */
const copied = async text => {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {  // not allowed here: by way of a selection
    const area = made("textarea", { value: text }, document.body);
    area.select();
    const isDone = document.execCommand("copy");
    area.remove();
    return isDone;
  }
};

// ---- Drawings -------------------------------------------------------------------------------------------------------

const looks = ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "stroke-linejoin",
  "stroke-linecap", "opacity", "font-size", "text-anchor", "paint-order", "visibility"];

/** @param {string} name @param {Record<string, unknown>} attributes @param {Element} parent */
const addShape = (name, attributes, parent) => {
  const element = parent.appendChild(document.createElementNS(parent.namespaceURI, name));
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
};

/**
 * Draws the key below a drawing, and tells where it ends.
 * @param {HTMLElement[]} keys @param {number} width @param {number} top @param {Element} svg
 */
const addKeys = (keys, width, top, svg) => {
  let x = 10, y = top;
  for (const key of keys) {
    const words = (key.textContent ?? "").trim(), wide = 34 + 6.3 * words.length;
    if (x > 10 && x + wide > width) {
      x = 10;
      y += 18;
    }
    const style = getComputedStyle(one(".swatch", key)), hasTop = style.borderTopWidth !== "0px";
    const dashes = style.borderTopStyle === "dashed" ? { "stroke-dasharray": "5 3" } : {};
    const edge = hasTop ? { "stroke": style.borderTopColor, "stroke-width": style.borderTopWidth, ...dashes } : {};
    const fill = getComputedStyle(document.documentElement).getPropertyValue("--" + key.dataset.layer + "-fill") || style.backgroundColor;
    if (hasTop && style.borderBottomWidth === "0px") addShape("path", { d: "M" + x + " " + (y - 4) + "h24", ...edge }, svg);
    else addShape("rect", { x, y: y - 10, width: 24, height: 11, fill, opacity: style.opacity, ...edge }, svg);
    addShape("text", { x: x + 30, y, "font-size": 11, fill: "#1d2733" }, svg).textContent = words;
    x += wide + 14;
  }
  return y + 12;
};

/**
 * As it looks on paper, on white, with its title above and its key below.
 * @param {HTMLElement} svg @param {string} title @param {HTMLElement[]} keys
 */
const drawing = (svg, title, keys) => {
  document.documentElement.dataset.paper = "";
  const copy = /** @type {HTMLElement} */ (svg.cloneNode(true)), to = all("*", copy);
  all("*", svg).forEach((element, i) => {
    const style = getComputedStyle(element);
    for (const look of looks) to[i].style.setProperty(look, style.getPropertyValue(look));
    to[i].removeAttribute("class");
    if (element.style.display === "none" || hidden.has(element.classList[0])) to[i].remove();
  });
  const [, , width, height] = (svg.getAttribute("viewBox") ?? "").split(" ").map(Number), above = 28;
  copy.removeAttribute("class");
  const body = [...copy.childNodes];
  const ground = addShape("rect", { width, fill: "#ffffff" }, copy);
  addShape("text", { x: 8, y: 19, "font-size": 14, "font-weight": 600, fill: "#1d2733" }, copy).textContent = title;
  addShape("g", { transform: "translate(0 " + above + ")" }, copy).append(...body);
  const below = addKeys(keys, width, above + height + 16, copy);
  delete document.documentElement.dataset.paper;
  const whole = keys.length > 0 ? below : above + height + 6;
  ground.setAttribute("height", String(whole));
  const attributes = { "font-family": "system-ui, sans-serif", "viewBox": "0 0 " + width + " " + whole, width, "height": whole };
  for (const [name, value] of Object.entries(attributes)) copy.setAttribute(name, String(value));
  return new XMLSerializer().serializeToString(copy);
};

/** @param {string} text @param {string} name */
const save = (text, name) => {
  const link = made("a", {
    href: URL.createObjectURL(new Blob([text], { type: "image/svg+xml" })),
    download: name.replace(/[^\p{L}\p{N}]+/gu, "_").replace(/^_|_$/g, "") + ".svg",
  }, document.body);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};

// ---- Buttons --------------------------------------------------------------------------------------------------------

/**
 * What is kept of a figure, looked at when a button is pressed.
 * @typedef {{columns?: (() => unknown[][]) | null, figure: () => HTMLElement, title: () => string, keys?: () => HTMLElement[]}} Kept
 */

/** @param {HTMLElement} element */
export const headingOf = element => one("h3, h2", /** @type {HTMLElement} */ (element.closest("section"))).textContent ?? "";

/** The entries of keys for what a drawing shows, each once. @param {HTMLElement} svg */
const keysOf = svg => {
  const names = new Set(all("path, rect", svg).map(element => element.classList[0]));
  return all(".keys li").filter(({ dataset: { layer = "" } }, i, keys) => names.has(layer) && !hidden.has(layer) &&
    keys.findIndex(other => other.dataset.layer === layer) === i);
};

/** @param {HTMLElement} place @param {Kept} kept */
export const addButtons = (place, { columns, figure, title, keys }) => {
  const bar = made("div", { className: "keep" });
  /** @param {string} words @param {() => Promise<string> | void} onPress */
  const button = (words, onPress) => {
    const added = made("button", { type: "button", textContent: words }, bar);
    added.setAttribute("aria-label", words + " of " + title());  // as it is seen, for who speaks to it
    added.addEventListener("click", async () => {
      const said = await onPress();
      if (!said) return;
      added.textContent = said;
      setTimeout(() => { added.textContent = words; }, 1500);
    });
  };
  if (columns) button("Copy CSV", async () => await copied(csv(columns())) ? "Copied" : "Not allowed");
  button("Save SVG", () => {
    const svg = one("svg", figure());
    save(drawing(svg, title(), keys ? keys() : keysOf(svg)), title());
  });
  place.prepend(bar);
};

for (const kept of all("figure.kept")) {
  const [numbers] = all("script.numbers", kept), [caption] = all("figcaption", kept);
  const words = caption ? ", " + caption.textContent : "";  // before there are buttons in it
  addButtons(caption ?? kept, {
    columns: numbers && (() => JSON.parse(numbers.textContent ?? "")), figure: () => kept, title: () => headingOf(kept) + words,
  });
}
for (const picture of all(".picture")) {
  addButtons(picture, { figure: () => one("figure", picture), title: () => headingOf(picture), keys: () => all(".keys li", picture) });
}

window.addEventListener("beforeprint", () => {
  readDrawings();
  for (const part of /** @type {HTMLDetailsElement[]} */ (all("section > details:not(.more), .requirements details"))) part.open = true;
});
