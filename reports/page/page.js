// Puts an interactive plot in the place of each drawing: layers that switch on and off, the motion or the spread around
// its middle, one zoom and one cursor for all outputs. Without this script the drawings stay.
// <html data-page="ready"> says that it is done, <html data-error="..."> what went wrong.
"use strict";

window.addEventListener("error", event => { document.documentElement.dataset.error = event.message; });

(() => {
  const root = document.documentElement;
  const numbers = document.getElementById("numbers");
  if (!numbers || typeof uPlot === "undefined") {
    root.dataset.page = "ready";
    return;
  }
  const page = JSON.parse(numbers.textContent);
  const color = name => getComputedStyle(root).getPropertyValue("--" + name).trim();
  const plots = new Set();

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

  const minus = (line, middle) => middle ? line.map((x, i) => x == null || middle[i] == null ? null : x - middle[i]) : line;

  // ---- Layers -------------------------------------------------------------------------------------------------------

  // What is drawn, from back to front: {layer, line, stroke, dash, width}, and bands that fill between two of them.
  const linesOf = (layers, middle) => {
    const lines = [], bands = [];
    for (const layer of layers) {
      if (middle && !layer.spread) continue;
      const style = layer.width > 0 ? { stroke: color(layer.name), width: layer.width, dash: layer.dashed ? [6, 4] : undefined } : { width: 0 };
      for (const band of layer.bands) {
        if (layer.filled) bands.push({ series: [lines.length + 2, lines.length + 1], fill: color(layer.name + "-fill") });
        for (const line of band) lines.push({ layer: layer.name, line: minus(line, middle), ...style });
      }
    }
    return { lines, bands };
  };

  // ---- Plots --------------------------------------------------------------------------------------------------------

  const axis = (label, size) => ({
    label, size, stroke: color("soft"), font: "11px system-ui, sans-serif", labelFont: "11px system-ui, sans-serif", labelSize: 18,
    grid: { stroke: color("grid"), width: 1 }, ticks: { stroke: color("grid"), width: 1, size: 4 },
  });

  // One zoom for all: a plot whose times change hands them on to those that show others.
  const shareTimes = (plot, key) => {
    if (key !== "x") return;
    const { min, max } = plot.scales.x;
    for (const other of plots) {
      const shown = other.scales.x;
      if (other !== plot && (shown.min !== min || shown.max !== max)) other.setScale("x", { min, max });
    }
  };

  const makePlot = (place, height, label, data, lines, bands, onCursor) => {
    const plot = new uPlot({
      width: Math.max(place.clientWidth, 200), height, bands,
      scales: { x: { time: false } },
      legend: { show: false },
      cursor: { y: false, sync: { key: "gamut", scales: ["x", null] }, points: { show: false }, drag: { x: true, y: false } },
      axes: [axis("time (s)", 32), axis(label, 62)],
      series: [{}, ...lines.map(line => ({
        stroke: line.stroke || "transparent", width: line.width, dash: line.dash, show: line.show !== false,
        points: { show: false }, spanGaps: false,
      }))],
      hooks: { setScale: [shareTimes], setCursor: onCursor ? [plot => onCursor(plot.cursor.idx)] : [] },
    }, data, place);
    plots.add(plot);
    return plot;
  };

  const readoutOf = (output, i) => {
    if (i == null) return "Drag to zoom, double-click to see all; point at the plot to read it.";
    const said = output.layers.filter(layer => layer.readout);
    const widths = said.map(layer => layer.kind === "band" && layer.bands[0][1][i] != null ? layer.bands[0][1][i] - layer.bands[0][0][i] : 0);
    const width = Math.max(0, ...widths);
    const numbers = layer => {
      const [lower, upper] = layer.bands[0];
      return layer.kind === "line" ? text(lower[i], width) : "[" + text(lower[i], width, -1) + ", " + text(upper[i], width, 1) + "]";
    };
    const parts = ["t = " + text(page.time[i]) + " s", ...said.map(layer => layer.readout + " " + numbers(layer))];
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

  // One output: its switches, its plot and its overestimation.
  class OutputPlot {
    constructor(section) {
      this.section = section;
      this.output = page.outputs[Number(section.dataset.output)];
      this.hidden = new Set();
      this.spread = false;
      this.place = section.querySelector(".live");
      this.addViews();
      this.main = this.place.appendChild(document.createElement("div"));
      this.readout = this.place.appendChild(document.createElement("p"));
      this.readout.className = "readout";
      this.ratio = this.place.appendChild(document.createElement("div"));
      this.addSwitches();
      section.classList.add("plotted");
      this.draw();
    }

    addViews() {
      const views = this.place.appendChild(document.createElement("div"));
      views.className = "views";
      const names = ["Motion", "Spread around " + this.output.middleName];
      names.forEach((name, i) => views.append(button([name], i === 0, event => {
        this.spread = i === 1;
        for (const other of views.children) other.setAttribute("aria-pressed", other === event.currentTarget);
        this.draw();
      })));
    }

    addSwitches() {
      for (const item of this.section.querySelectorAll(".keys li")) {
        const layer = item.dataset.layer;
        item.append(button([...item.childNodes], true, event => {
          const shown = this.hidden.delete(layer);
          if (!shown) this.hidden.add(layer);
          event.currentTarget.setAttribute("aria-pressed", shown);
          this.plot.batch(() => this.lines.forEach((line, i) => {
            if (line.layer === layer) this.plot.setSeries(i + 1, { show: shown });
          }));
        }));
      }
    }

    draw() {
      const shown = this.plot && { min: this.plot.scales.x.min, max: this.plot.scales.x.max };
      for (const plot of [this.plot, this.ratioPlot]) {
        if (plot) {
          plots.delete(plot);
          plot.destroy();
        }
      }
      const { lines, bands } = linesOf(this.output.layers, this.spread ? this.output.middle : null);
      for (const line of lines) line.show = !this.hidden.has(line.layer);
      this.lines = lines;
      const read = i => { this.readout.textContent = readoutOf(this.output, i); };
      this.plot = makePlot(this.main, 320, this.output.unit, [page.time, ...lines.map(line => line.line)], lines, bands, read);
      read(null);
      const ratios = linesOf(this.output.ratios, null);
      this.ratioPlot = ratios.lines.length > 0
        ? makePlot(this.ratio, 130, this.output.ratios[0].name, [page.time, ...ratios.lines.map(line => line.line)], ratios.lines, ratios.bands)
        : null;
      if (shown) this.plot.setScale("x", shown);
    }

    resize() {
      const width = this.place.clientWidth;
      if (width === 0) return;  // not shown: printed
      for (const plot of [this.plot, this.ratioPlot]) {
        if (plot && plot.width !== width) plot.setSize({ width, height: plot.height });
      }
    }
  }

  const drawn = [...document.querySelectorAll("section.output[data-output]")].map(section => new OutputPlot(section));
  new ResizeObserver(() => drawn.forEach(output => output.resize())).observe(document.body);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawn.forEach(output => output.draw()));
  window.addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(part => { part.open = true; }));
  root.dataset.page = "ready";
})();
