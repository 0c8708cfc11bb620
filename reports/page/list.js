// The list of outputs: ordered by its columns, searched by name; a link to an output unfolds it. On a phone the parts of the
// page are a list to choose from.
"use strict";

import { all, made, one } from "./dom.js";

/** @param {HTMLElement} section */
const nameOf = section => one("h3", section).textContent ?? "";

/**
 * Unknown numbers come last, whichever way the others are ordered.
 * @param {HTMLElement[]} sections @param {string} key @param {boolean} isFalling
 */
const ordered = (sections, key, isFalling) => {
  const sign = isFalling ? -1 : 1;
  return [...sections].sort((a, b) => {
    if (key === "name") return sign * nameOf(a).localeCompare(nameOf(b), undefined, { numeric: true });
    const [x, y] = [a, b].map(({ dataset }) => dataset[key] == null ? NaN : Number(dataset[key]));
    if (isNaN(x) || isNaN(y)) return Number(isNaN(x)) - Number(isNaN(y));
    return sign * (x - y);
  });
};

/** @param {HTMLElement} list */
const makeHeads = list => {
  const heads = one(".heads", list), sections = all("section.output", list);
  heads.removeAttribute("aria-hidden");
  heads.setAttribute("role", "group");
  heads.setAttribute("aria-label", "Order of the outputs");
  for (const head of all("[data-key]", heads)) {
    const words = head.textContent ?? "";
    if (!words) continue;
    const button = made("button", { type: "button", textContent: words });
    head.replaceChildren(button);
    button.addEventListener("click", () => {
      const isFalling = head.dataset.order === "rising", key = head.dataset.key ?? "";
      for (const other of all("[data-key]", heads)) delete other.dataset.order;
      head.dataset.order = isFalling ? "falling" : "rising";
      button.setAttribute("aria-label", words + ", " + head.dataset.order);
      list.append(...ordered(sections, key, isFalling));
    });
  }
};

/** @param {HTMLElement} list */
const makeSearch = list => {
  const sections = all("section.output", list), most = 6;
  if (sections.length <= most) return;
  const place = made("p", { className: "find" }), name = made("label", { textContent: "Find an output" }, place);
  const field = made("input", { type: "search" }, name), said = made("output", {}, place);
  field.addEventListener("input", () => {
    const wanted = field.value.trim().toLowerCase();
    for (const section of sections) section.hidden = !nameOf(section).toLowerCase().includes(wanted);
    said.textContent = wanted ? sections.filter(({ hidden }) => !hidden).length + " of " + sections.length : "";
  });
  list.before(place);
};

for (const list of all(".listed")) {
  makeHeads(list);
  makeSearch(list);
}

/** Which part is read: the last that begins above the middle of the window. @param {HTMLElement[]} parts */
const readPart = parts => parts.findLast(part => part.getBoundingClientRect().top < innerHeight / 2) ?? parts[0];

/** @param {HTMLElement} links */
const makeChoice = links => {
  const options = all("a", links), name = made("label", { className: "choice", textContent: "Part" });
  const choice = made("select", {}, name);
  for (const link of options) made("option", { value: link.getAttribute("href") ?? "", textContent: link.textContent }, choice);
  choice.addEventListener("change", () => { location.hash = choice.value; });
  const parts = options.map(link => document.getElementById((link.getAttribute("href") ?? "").slice(1))).filter(part => part != null);
  let isAsked = false;
  window.addEventListener("scroll", () => {
    if (isAsked || name.clientWidth === 0) return;
    isAsked = true;
    requestAnimationFrame(() => {
      isAsked = false;
      choice.value = "#" + readPart(parts).id;
    });
  }, { passive: true });
  links.after(name);
};
for (const links of all("nav.parts")) if (links.childElementCount > 0) makeChoice(links);

/** What a link leads to is seen. */
const unfold = () => {
  const target = location.hash.length > 1 ? document.getElementById(decodeURIComponent(location.hash.slice(1))) : null;
  const panel = target?.querySelector("details.panel, details.method");
  if (!(panel instanceof HTMLDetailsElement)) return;
  panel.open = true;
  target?.scrollIntoView();
};
window.addEventListener("hashchange", unfold);
unfold();
