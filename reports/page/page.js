// Puts an interactive plot in the place of each drawing, first where the reader is, then one by one: layers that switch on and
// off, the motion or the spread around its middle, one zoom and one cursor for all outputs. Without this script the
// drawings stay.
"use strict";

gamut.plots = (() => {
  const root = document.documentElement;
  const time = JSON.parse(document.getElementById("times").textContent).time;
  const color = name => getComputedStyle(root).getPropertyValue("--" + name).trim();
  const drawn = new Set(), hidden = new Set();
  let shown = null;  // the times that all plots show, where somebody chose them

  // ---- Numbers ------------------------------------------------------------------------------------------------------

  // As many digits as show a difference of the given width; rounded down (side -1), up (side 1) or to nearest (side 0).
  const text = (x, width = 0, side = 0) => {
    if (x == null) return "none";
    const wanted = width > 0 && x !== 0 ? Math.ceil(Math.log10(Math.abs(x) / width)) + 4 : 5;
    const digits = Math.min(15, Math.max(4, wanted));
    const nearest = Number(x.toPrecision(digits));
    if (x === 0 || side * (nearest - x) >= 0) return nearest.toString();
    const unit = Math.pow(10, Math.floor(Math.log10(Math.abs(x))) - digits + 1);
    return Number((nearest + side * unit).toPrecision(digits)).toString();
  };

  // An output of the page with its lines as numbers: of each layer the motion, and the spread around the middle.
  const known = new Map();
  const outputOf = number => {
    if (known.has(number)) return known.get(number);
    const output = JSON.parse(document.querySelector("section.output[data-output='" + number + "'] > script").textContent);
    const value = gamut.decimal(output.scale), middle = gamut.wholes(output.middle);
    const lineOf = list => {
      const around = gamut.wholes(list);
      return { around: around.map(value), motion: around.map((whole, i) => whole == null ? null : value(whole + (middle[i] ?? 0))) };
    };
    for (const layer of output.layers) {
      const bands = layer.bands.map(band => band.map(lineOf));
      layer.bands = bands.map(band => band.map(line => line.motion));
      layer.around = bands.map(band => band.map(line => line.around.map((x, i) => middle[i] == null ? null : x)));
    }
    for (const layer of output.around ?? []) {
      output.layers.find(other => other.name === layer.name).around = layer.bands.map(band => band.map(list => gamut.wholes(list).map(value)));
    }
    known.set(number, output);
    return output;
  };

  // ---- Layers -------------------------------------------------------------------------------------------------------

  // Of the first plot of the page only some layers, and of the limits those of one requirement.
  const shownOf = (output, { dataset: { layers: only, limits } }) => {
    if (only == null) return output.layers;
    const isShown = i => limits.split(" ").includes(String(i)), some = list => list.filter((_, i) => isShown(i));
    return output.layers.filter(layer => only.split(" ").includes(layer.name)).map(layer => layer.name !== "limit" ? layer :
      { ...layer, bands: some(layer.bands), around: some(layer.around), labels: some(layer.labels) });
  };

  // What is drawn, from back to front: {layer, line, label, stroke, dash, width}, and bands that fill between two of them.
  const linesOf = (layers, isSpread) => {
    const lines = [], bands = [];
    for (const layer of layers) {
      if (isSpread && !layer.spread) continue;
      const style = layer.width > 0 ? { stroke: color(layer.name), width: layer.width, dash: layer.dashed ? [6, 4] : undefined } : { width: 0 };
      (isSpread ? layer.around : layer.bands).forEach((band, i) => {
        if (layer.filled) bands.push({ series: [lines.length + 2, lines.length + 1], fill: color(layer.name + "-fill") });
        for (const line of band) lines.push({ layer: layer.name, label: layer.labels[i], isBelow: i % 2 === 1, line, ...style });
      });
    }
    return { lines, bands };
  };

  // ---- Plots --------------------------------------------------------------------------------------------------------

  const axis = (name, size, room) => {
    let found = { text: [], aside: "" };
    return {
      label: () => gamut.axisName(name, found.aside), size, stroke: color("soft"), font: "11px system-ui, sans-serif",
      labelFont: "11px system-ui, sans-serif", labelSize: 18,
      splits: (plot, axisNumber, low, high) => {
        const length = (axisNumber === 0 ? plot.bbox.width : plot.bbox.height) / devicePixelRatio;
        found = gamut.ticks(low, high, Math.max(2, Math.floor(length / room)));
        return found.at;
      },
      values: () => found.text,
      grid: { stroke: color("grid"), width: 1 }, ticks: { stroke: color("grid"), width: 1, size: 4 },
    };
  };

  // One zoom for all: a plot whose times change hands them on to those that show others.
  const shareTimes = (plot, key) => {
    if (key !== "x" || !plot.isReady) return;
    const { min, max } = plot.scales.x;
    shown = { min, max };
    for (const other of drawn) {
      const its = other.plot.scales.x;
      if (other.plot !== plot && (its.min !== min || its.max !== max)) other.plot.setScale("x", { min, max });
    }
  };

  // How many pieces of lines go through a rectangle of the canvas; those of the layer itself do not count.
  const crossings = (plot, lines, own, left, right, top, bottom) => {
    const from = Math.max(0, time.findIndex(t => plot.valToPos(t, "x", true) >= left) - 1);
    let found = 0;
    lines.forEach((other, k) => {
      if (other.layer === own || !plot.series[k + 1].show) return;
      for (let t = from + 1; t < time.length && plot.valToPos(time[t - 1], "x", true) <= right; ++t) {
        if (other.line[t - 1] == null || other.line[t] == null) continue;
        const a = plot.valToPos(other.line[t - 1], "y", true), b = plot.valToPos(other.line[t], "y", true);
        if (Math.max(a, b) >= top && Math.min(a, b) <= bottom) ++found;
      }
    });
    return found;
  };

  // At the end or the beginning of what is seen, above or below the line, where the fewest lines are: as on paper.
  const drawLabels = (plot, lines) => {
    const { ctx, bbox } = plot, px = devicePixelRatio;
    ctx.save();
    ctx.font = 11 * px + "px system-ui, sans-serif";
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";  // axes leave another behind
    ctx.lineWidth = 3 * px;
    ctx.lineJoin = "round";
    ctx.strokeStyle = color("paper");
    lines.forEach((line, i) => {
      const last = line.label && plot.series[i + 1].show ? line.line.findLastIndex(x => x != null) : -1;
      if (last < 0) return;
      const end = Math.min(plot.valToPos(time[last], "x", true), bbox.left + bbox.width) - 4 * px;
      const begin = Math.max(plot.valToPos(time[line.line.findIndex(x => x != null)], "x", true), bbox.left) + 4 * px;
      const y = plot.valToPos(line.line[last], "y", true), wide = ctx.measureText(line.label).width;
      if (end < bbox.left || y < bbox.top || y > bbox.top + bbox.height) return;
      const isBelowFirst = line.isBelow || y < bbox.top + 16 * px;
      let best = null;
      for (const left of [end - wide, begin]) {
        for (const isBelow of [isBelowFirst, !isBelowFirst]) {
          const base = y + (isBelow ? 13 : -4) * px;
          if (base - 11 * px < bbox.top || base > bbox.top + bbox.height) continue;
          const found = crossings(plot, lines, line.layer, left, left + wide, base - 11 * px, base + 2 * px);
          if (best == null || found < best.found) best = { found, left, base };
        }
      }
      if (best == null) return;
      ctx.strokeText(line.label, best.left, best.base);
      ctx.fillStyle = line.stroke;
      ctx.fillText(line.label, best.left, best.base);
    });
    ctx.restore();
  };

  const makePlot = (place, name, lines, bands, onCursor) => {
    const plot = new uPlot({
      width: Math.max(place.clientWidth, 200), height: place.clientWidth < 480 ? 240 : 300, bands,
      scales: { x: { time: false }, y: { range: (_, low, high) => gamut.padded(low, high) } },
      legend: { show: false },
      cursor: { y: false, sync: { key: "gamut", scales: ["x", null] }, points: { show: false }, drag: { x: true, y: false } },
      axes: [axis("time (s)", 32, 80), axis(name, 58, 45)],
      series: [{}, ...lines.map(line => ({
        stroke: line.stroke || "transparent", width: line.width, dash: line.dash, show: !hidden.has(line.layer),
        points: { show: false }, spanGaps: false,
      }))],
      hooks: { setScale: [shareTimes], setCursor: [plot => onCursor(plot.cursor.idx)], draw: [plot => drawLabels(plot, lines)] },
    }, [time, ...lines.map(line => line.line)], place);
    if (shown) plot.setScale("x", shown);
    plot.isReady = true;
    return plot;
  };

  const readoutOf = (output, i) => {
    if (i == null) return "Point at the plot to read it; drag to zoom, double-click to see all.";
    const said = output.layers.filter(layer => layer.readout);
    const widths = said.map(layer => layer.kind === "band" && layer.bands[0][1][i] != null ? layer.bands[0][1][i] - layer.bands[0][0][i] : 0);
    const width = Math.max(0, ...widths);
    const numbers = layer => {
      const [lower, upper] = layer.bands[0];
      return layer.kind === "line" ? text(lower[i], width) : "[" + text(lower[i], width, -1) + ", " + text(upper[i], width, 1) + "]";
    };
    const parts = ["t = " + text(time[i]) + " s", ...said.map(layer => layer.readout + " " + numbers(layer))];
    for (const ratio of output.ratios) {
      if (ratio.bands[0][0][i] != null) parts.push(ratio.readout + " " + text(ratio.bands[0][0][i]));
    }
    return parts.join(" \u00b7 ") + (output.unit ? " (" + output.unit + ")" : "");
  };

  const button = (words, pressed, onPress) => {
    const made = document.createElement("button");
    made.type = "button";
    made.setAttribute("aria-pressed", pressed);
    made.append(...words);
    made.addEventListener("click", onPress);
    return made;
  };

  // One output: its views and its plot. The first of the page shows some layers in one view.
  class OutputPlot {
    constructor(section) {
      this.section = section;
      this.place = section.querySelector(".live");
      section.querySelectorAll(".static details").forEach(details => details.replaceWith(details.querySelector("figure")));
      if (section.dataset.layers == null) this.addViews();
      this.main = this.place.appendChild(document.createElement("div"));
      this.main.className = "canvas";
      const about = this.place.appendChild(document.createElement("div"));
      about.className = "about";
      this.readout = about.appendChild(document.createElement("p"));
      this.readout.className = "readout";
      section.classList.add("plotted");
    }

    addViews() {
      const views = this.place.appendChild(document.createElement("div"));
      views.className = "views";
      for (const figure of this.section.querySelectorAll(".static figure")) {
        const view = figure.dataset.view;
        views.append(button([figure.querySelector("figcaption").textContent], view === this.section.dataset.view, event => {
          this.section.dataset.view = view;
          for (const other of views.children) other.setAttribute("aria-pressed", other === event.currentTarget);
          this.draw();
        }));
      }
    }

    draw() {
      this.plot?.destroy();
      this.output = outputOf(this.section.dataset.output);
      const view = this.section.dataset.view, unit = this.output.unit;
      const layers = view === "ratio" ? this.output.ratios : shownOf(this.output, this.section);
      const { lines, bands } = linesOf(layers, view === "spread");
      const name = view === "ratio" ? this.output.ratios[0].words : view === "spread" ? "deviation" + (unit ? " (" + unit + ")" : "") : unit;
      this.lines = lines;
      this.plot = makePlot(this.main, name, lines, bands, i => { this.readout.textContent = readoutOf(this.output, i); });
      this.readout.textContent = readoutOf(this.output, null);
      drawn.add(this);
    }

    show(layer, isShown) {
      this.plot.batch(() => this.lines.forEach((line, i) => {
        if (line.layer === layer) this.plot.setSeries(i + 1, { show: isShown });
      }));
    }

    resize() {
      const width = this.main.clientWidth;
      if (width > 0 && this.plot.width !== width) this.plot.setSize({ width, height: width < 480 ? 240 : 300 });  // 0: printed
    }
  }

  // The one key of the page: each entry a switch of its layer in all plots.
  for (const item of document.querySelectorAll(".outputs > .keys li")) {
    const layer = item.dataset.layer;
    item.append(button([...item.childNodes], true, event => {
      const isShown = hidden.delete(layer);
      if (!isShown) hidden.add(layer);
      event.currentTarget.setAttribute("aria-pressed", isShown);
      drawn.forEach(plot => plot.show(layer, isShown));
    }));
  }

  const plots = new Map([...document.querySelectorAll("section.output[data-output]")].map(section => [section, new OutputPlot(section)]));
  const drawOnce = section => {
    near.unobserve(section);
    if (!plots.get(section).plot) plots.get(section).draw();
  };
  const near = new IntersectionObserver(entries => entries.forEach(({ target, isIntersecting }) => isIntersecting && drawOnce(target)), { rootMargin: "600px" });
  plots.forEach((_, section) => near.observe(section));
  // The others one by one, whenever there is nothing else to do. <html data-plots> says whether some are waiting.
  const later = then => window.requestIdleCallback ? requestIdleCallback(then, { timeout: 300 }) : setTimeout(then, 50);
  const rest = [...plots.keys()];
  const drawNext = () => {
    root.dataset.plots = rest.length === 0 ? "drawn" : "waiting";
    if (rest.length === 0) return;
    drawOnce(rest.shift());
    later(drawNext);
  };
  root.dataset.plots = "waiting";
  later(drawNext);
  new ResizeObserver(() => drawn.forEach(plot => plot.resize())).observe(document.body);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawn.forEach(plot => plot.draw()));
  return { time, outputOf, shownOf, hidden };
})();
