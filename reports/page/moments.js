// A slider for all figures of a section that are there at some times: which of the times is shown.
"use strict";

for (const place of document.querySelectorAll(".controls.moments")) {
  const times = JSON.parse(place.dataset.times), figures = document.querySelectorAll("figure." + place.dataset.of);
  const slider = document.createElement("input"), said = document.createElement("output");
  Object.assign(slider, { type: "range", min: 0, max: times.length - 1, value: times.length - 1 });
  slider.setAttribute("aria-label", place.dataset.label);
  const show = () => {
    said.textContent = times[slider.value];
    slider.setAttribute("aria-valuetext", times[slider.value]);
    for (const figure of figures) figure.hidden = figure.dataset.at !== slider.value;
  };
  slider.addEventListener("input", show);
  place.append(slider, said);
  show();
}
