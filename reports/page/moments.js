// A slider for all figures of a section that are there at some times: which of the times is shown.
"use strict";

import { all, chooseTime, followTime, made, nearestTo } from "./dom.js";

for (const place of all(".controls.moments")) {
  /** @type {string[]} */
  const moments = JSON.parse(place.dataset.times ?? "");
  /** @type {number[]} */
  const seconds = JSON.parse(place.dataset.seconds ?? "");
  const figures = all("figure." + place.dataset.of), last = String(moments.length - 1);
  const slider = made("input", { type: "range", min: "0", max: last, value: last }, place), said = made("output", {}, place);
  slider.setAttribute("aria-label", place.dataset.label ?? "");
  let shown = "";
  const show = () => {
    if (slider.value === shown) return;
    shown = slider.value;
    said.textContent = moments[Number(slider.value)];
    slider.setAttribute("aria-valuetext", said.textContent);
    for (const figure of figures) figure.hidden = figure.dataset.at !== slider.value;
  };
  /** @param {number} time */
  const follow = time => {
    slider.value = String(nearestTo(seconds, time));
    show();
  };
  slider.addEventListener("input", () => {
    show();
    chooseTime(seconds[Number(slider.value)], follow);
  });
  followTime(follow);
  show();
}
