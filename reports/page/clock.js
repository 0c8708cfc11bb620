// One time for the whole page: what shows a moment follows its slider, which begins at the worst instant. The card of a
// requirement chooses its own.
"use strict";

import { all, chooseTime, followTime, made, one } from "./dom.js";

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

for (const card of all(".clock").length > 0 ? all(".requirements > li[data-instant]") : []) {
  const instant = Number(card.dataset.instant);
  const words = "Go to " + Number(instant.toPrecision(4)) + " s";
  one("span", card).after(made("button", { type: "button", className: "instant", textContent: words }), " ");
  card.addEventListener("click", ({ target }) => {
    const isElsewhere = target instanceof Element && target.closest("summary, details, button:not(.instant)");
    if (!isElsewhere && getSelection()?.isCollapsed !== false) chooseTime(instant);
  });
}
