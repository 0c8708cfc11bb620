// One time for the whole page: what shows a moment follows its slider, which begins at the worst instant.
"use strict";

import { all, chooseTime, followTime, made } from "./dom.js";

for (const place of all(".clock")) {
  const until = Number(place.dataset.until), steps = 1000;
  const slider = made("input", { type: "range", min: "0", max: String(steps), step: "1" }, place), said = made("output", {}, place);
  slider.setAttribute("aria-label", "Time of the page");
  /** @param {number} time */
  const show = time => {
    slider.value = String(Math.round(time / until * steps));
    said.textContent = "t = " + Number(time.toPrecision(4)) + " s";
    slider.setAttribute("aria-valuetext", said.textContent);
  };
  slider.addEventListener("input", () => {
    const time = Number(slider.value) / steps * until;
    show(time);
    chooseTime(time, show);
  });
  followTime(show);
  chooseTime(Number(place.dataset.instant));
}
