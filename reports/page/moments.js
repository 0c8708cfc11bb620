// A slider for all figures of a section that are there at some times: which of the times is shown.
"use strict";

import { all, made } from "./dom.js";

for (const place of all(".controls.moments")) {
  /** @type {string[]} */
  const moments = JSON.parse(place.dataset.times ?? ""), figures = all("figure." + place.dataset.of), last = String(moments.length - 1);
  const slider = made("input", { type: "range", min: "0", max: last, value: last }, place), said = made("output", {}, place);
  slider.setAttribute("aria-label", place.dataset.label ?? "");
  const show = () => {
    said.textContent = moments[Number(slider.value)];
    slider.setAttribute("aria-valuetext", said.textContent);
    for (const figure of figures) figure.hidden = figure.dataset.at !== slider.value;
  };
  slider.addEventListener("input", show);
  show();
}
