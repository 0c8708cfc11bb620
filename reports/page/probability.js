// One slider for the distribution functions of all outputs: which of the times is shown.
"use strict";

(() => {
  const place = document.querySelector(".controls.moments");
  if (!place) return;
  const times = JSON.parse(place.dataset.times);
  const slider = document.createElement("input");
  const said = document.createElement("output");
  Object.assign(slider, { type: "range", min: 0, max: times.length - 1, value: times.length - 1 });
  slider.setAttribute("aria-label", "Time of the distribution functions");
  const show = () => {
    said.textContent = times[slider.value];
    slider.setAttribute("aria-valuetext", times[slider.value]);
    for (const figure of document.querySelectorAll("figure.distribution")) figure.hidden = figure.dataset.at !== slider.value;
  };
  slider.addEventListener("input", show);
  place.append(slider, said);
  show();
})();
