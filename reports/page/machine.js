// Moves the picture of the machine: through time by a slider or by itself, and, for all that is not seen from the side,
// around as it is dragged. The drawing has an element for each part already; paths are computed as in
// reports/drawing/machine.cpp. Without this script the machine stands at its start.
"use strict";

(() => {
  const place = document.querySelector(".picture"), numbers = document.getElementById("machine");
  if (!place || !numbers) return;
  const m = JSON.parse(numbers.textContent), svg = place.querySelector("svg"), start = { right: m.right, up: m.up }, vertical = m.vertical;
  const points = m.fixed.length, times = m.time.length, factor = m.scale * m.unit;
  let view = start, row = 0;

  // ---- Geometry -----------------------------------------------------------------------------------------------------

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = a => a.map(x => x / Math.hypot(...a));
  const text = x => x.toFixed(1);
  const at = (list, i, k, count = points) => {
    const from = 3 * (i * count + k), found = list.slice(from, from + 3);
    return found.length < 3 || found.includes(null) ? null : found;
  };
  const seen = p => [m.width / 2 + factor * dot(p, view.right), m.height / 2 - factor * dot(p, view.up)];
  const line = (a, b) => "M" + text(a[0]) + " " + text(a[1]) + "L" + text(b[0]) + " " + text(b[1]);

  const zigzag = (a, b) => {
    const dx = b[0] - a[0], dy = b[1] - a[1], length = Math.hypot(dx, dy), end = 0.14;
    let path = "M" + text(a[0]) + " " + text(a[1]);
    for (let i = 0; length > 1 && i <= 18; ++i) {
      const along = end + (1 - 2 * end) * i / 18, aside = (i % 2 === 0 ? 0 : i % 4 === 1 ? 6 : -6) / length;
      path += "L" + text(a[0] + along * dx - aside * dy) + " " + text(a[1] + along * dy + aside * dx);
    }
    return path + "L" + text(b[0]) + " " + text(b[1]);
  };

  const hull = sights => {
    sights.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const chain = list => {
      const found = [];
      for (const p of list) {
        for (let n = found.length; n >= 2; --n) {
          const a = found[n - 2], b = found[n - 1];
          if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
          found.pop();
        }
        found.push(p);
      }
      found.pop();
      return found;
    };
    return [...chain(sights), ...chain(sights.reverse())];
  };
  const polygon = corners => corners.length === 0 ? "" : "M" + corners.map(p => text(p[0]) + " " + text(p[1])).join("L") + "Z";

  // Corners of the box of point k at time i, wider by what the point may sag until time `sag`; none if not known.
  const box = (i, k, sag) => {
    const lower = at(m.lower, i, k), upper = at(m.upper, i, k), room = sag == null ? [0, 0, 0] : at(m.sag, sag, k);
    if (!lower || !upper || !room) return [];
    const corners = [];
    for (let corner = 0; corner < 8; ++corner)
      corners.push(seen([0, 1, 2].map(d => corner >> d & 1 ? upper[d] + room[d] : lower[d] - room[d])));
    return corners;
  };

  // ---- Drawing ------------------------------------------------------------------------------------------------------

  const each = (selector, draw) => svg.querySelectorAll(selector).forEach(draw);
  const staysPut = k => {
    const lower = at(m.lower, 0, k), upper = at(m.upper, 0, k);
    return m.fixed[k] && !(lower && upper && upper.some((x, i) => x - lower[i] > 3));
  };
  const moving = [...m.fixed.keys()].filter(k => !staysPut(k));

  const drawSwept = () => each(".swept", path => {
    let all = "";
    for (const k of moving)
      for (let i = 1; i < times; ++i) {
        const before = box(i - 1, k, i), now = box(i, k, i);
        if (before.length > 0 && now.length > 0) all += polygon(hull([...before, ...now]));
      }
    path.setAttribute("d", all);
  });

  const drawMotion = () => {
    const nominal = m.fixed.map((_, k) => at(m.nominal, row, k)), sights = nominal.map(p => p && seen(p));
    const show = (element, isThere) => element.setAttribute("visibility", isThere ? "visible" : "hidden");
    const names = [];  // where those are that are seen: others would lie over them
    each("[data-part]", element => {
      const [, from, to] = m.parts[Number(element.dataset.part)], a = sights[from], b = sights[to];
      show(element, a && b);
      if (!a || !b) return;
      if (element.tagName === "circle") {
        element.setAttribute("cx", text(b[0]));
        element.setAttribute("cy", text(b[1]));
      } else if (element.tagName === "text") {
        const isTight = b[0] + 15 + element.getComputedTextLength() > m.width;
        element.style.textAnchor = isTight ? "end" : "start";
        element.setAttribute("x", text(b[0] + (isTight ? -15 : 15)));
        element.setAttribute("y", text(b[1] - 9));
        const its = element.getBBox(), isApart = other => its.x + its.width <= other.x || other.x + other.width <= its.x ||
          Math.abs(its.y - other.y) >= 0.8 * its.height;  // of lines of text: those of one place stand above each other
        if (names.every(isApart)) names.push(its);
        else show(element, false);
      } else {
        element.setAttribute("d", element.classList.contains("spring") ? zigzag(a, b) : line(a, b));
      }
    });
    each("[data-axis]", element => {
      const j = Number(element.dataset.axis), p = sights[m.parts[m.axisOf[j]][2]], axis = at(m.axes, row, j, m.axisOf.length);
      show(element, p);
      if (!p) return;
      const along = axis ? [m.pin * dot(axis, view.right), -m.pin * dot(axis, view.up)] : [0, 0];
      element.setAttribute("d", line([p[0] - along[0], p[1] - along[1]], [p[0] + along[0], p[1] + along[1]]));
    });
    each("[data-point]", element => {
      const p = sights[Number(element.dataset.point)];
      if (p) element.setAttribute("transform", "translate(" + text(p[0]) + " " + text(p[1]) + ")");
    });
    each("[data-sample]", element => {
      const first = Number(element.dataset.sample) * times + row;
      let path = "";
      for (const [kind, from, to] of m.parts) {
        const a = at(m.samples, first, from), b = at(m.samples, first, to);
        if ((kind === "rigid" || kind === "mass") && from !== to && a && b) path += line(seen(a), seen(b));
      }
      element.setAttribute("d", path);
    });
    each(".now", path => path.setAttribute("d", moving.map(k => polygon(hull(box(row, k)))).join("")));
    each("[data-direction]", element => {
      const e = [0, 0, 0];
      e[Number(element.dataset.direction)] = 1;
      const to = [dot(e, view.right), -dot(e, view.up)], x = 30, y = m.height - 30;
      show(element, Math.hypot(...to) > 0.2);
      element.querySelector("path").setAttribute("d", line([x, y], [x + 20 * to[0], y + 20 * to[1]]));
      element.querySelector("text").setAttribute("x", text(x + 28 * to[0]));
      element.querySelector("text").setAttribute("y", text(y + 28 * to[1] + 4));
    });
  };

  // ---- Time ---------------------------------------------------------------------------------------------------------

  const made = (tag, properties, parent) => parent.appendChild(Object.assign(document.createElement(tag), properties));
  const caption = place.querySelector("figcaption"), captionAtStart = caption.textContent;
  const controls = document.createElement("div");
  controls.className = "controls";
  svg.after(controls);
  let slider = null, shown = null, playing = null;
  const horizon = m.time[times - 1];

  const go = to => {
    row = to;
    drawMotion();
    if (slider) {
      slider.value = String(row);
      shown.textContent = "t = " + Number(m.time[row].toPrecision(5)) + " s";
    }
  };

  if (times > 1) {
    const play = made("button", { type: "button", textContent: "Play" }, controls);
    slider = made("input", { type: "range", min: 0, max: times - 1, step: 1, value: 0 }, controls);
    slider.setAttribute("aria-label", "Time");
    shown = made("output", {}, controls);
    const stop = () => {
      cancelAnimationFrame(playing);
      playing = null;
      play.textContent = "Play";
    };
    slider.addEventListener("input", () => {
      if (playing) stop();
      go(Number(slider.value));
    });
    const seconds = Math.min(Math.max(horizon, 3), 12);  // that playing takes
    play.addEventListener("click", () => {
      if (playing) return stop();
      if (row === times - 1) go(0);
      const from = m.time[row], began = performance.now();
      const step = now => {
        const t = from + (now - began) / 1000 * horizon / seconds;
        let next = row;
        while (next + 1 < times && m.time[next + 1] <= t) ++next;
        go(next);
        if (next === times - 1) return stop();
        playing = requestAnimationFrame(step);
      };
      play.textContent = "Pause";
      playing = requestAnimationFrame(step);
    });
  }

  // ---- Views --------------------------------------------------------------------------------------------------------

  const look = to => {
    view = to;
    drawMotion();
    drawSwept();
  };
  const axis = (right, up) => ({ right, up });
  const views = made("span", { className: "views" }, controls);
  const names = m.isSide ? { "Side view": start } : {
    "Space": start, "x\u2013z": axis([1, 0, 0], [0, 0, 1]), "y\u2013z": axis([0, 1, 0], [0, 0, 1]), "x\u2013y": axis([1, 0, 0], [0, 1, 0]),
  };
  const press = chosen => { for (const other of views.children) other.setAttribute("aria-pressed", String(other === chosen)); };
  for (const [name, to] of Object.entries(names)) {
    const button = made("button", { type: "button", textContent: name }, views);
    button.addEventListener("click", () => {
      press(button);
      look(to);
    });
  }
  press(views.firstElementChild);

  place.classList.add("turns");
  let grip = null, pending = false;
  svg.addEventListener("pointerdown", event => {
    grip = [event.clientX, event.clientY];
    svg.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  svg.addEventListener("pointermove", event => {
    if (!grip) return;
    const [dx, dy] = [(event.clientX - grip[0]) / 150, (event.clientY - grip[1]) / 150];
    grip = [event.clientX, event.clientY];
    // About the upward direction of the start, then about the paper's horizontal, no further than straight down.
    const turn = (v, about, angle) => {
      const c = Math.cos(angle), s = Math.sin(angle), w = cross(about, v), d = dot(about, v) * (1 - c);
      return v.map((x, i) => x * c + w[i] * s + about[i] * d);
    };
    const right = unit(turn(view.right, vertical, -dx)), level = unit(turn(view.up, vertical, -dx));
    const up = unit(turn(level, right, dy));
    view = { right, up: dot(up, vertical) > -1e-9 ? up : level };
    press(null);
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      drawMotion();
      if (times * moving.length <= 1500) drawSwept();
    });
  });
  const release = () => {
    if (grip) drawSwept();
    grip = null;
  };
  svg.addEventListener("pointerup", release);
  svg.addEventListener("pointercancel", release);

  // ---- Key ----------------------------------------------------------------------------------------------------------

  const classes = { nominal: "[data-part], [data-axis]", sample: ".sample", now: ".now", swept: ".swept" };
  for (const item of place.querySelectorAll(".keys li")) {
    const button = document.createElement("button");
    button.type = "button";
    button.setAttribute("aria-pressed", "true");
    button.append(...item.childNodes);
    item.append(button);
    button.addEventListener("click", () => {
      const isShown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(isShown));
      each(classes[item.dataset.layer], element => { element.style.display = isShown ? "" : "none"; });
    });
  }

  caption.textContent = captionAtStart.replace(", at the start", "") + " Drag to turn it.";
  let before = null;
  window.addEventListener("beforeprint", () => {
    before = { row, view };
    caption.dataset.screen = caption.textContent;
    caption.textContent = captionAtStart;
    row = 0;
    look(start);
  });
  window.addEventListener("afterprint", () => {
    if (!before) return;
    caption.textContent = caption.dataset.screen;
    row = before.row;
    look(before.view);
  });
  go(0);
})();
