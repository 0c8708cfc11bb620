// Puts an interactive plot in the place of each drawing that is unfolded: layers that switch on and off, the motion or the
// spread around its middle, beside it on the same axis what is known at the time of the page, one zoom and one cursor for
// all outputs. Without this script the drawings stay.
"use strict";

import { axisName, padded, ticks } from "./axes.js";
import { Beside } from "./beside.js";
import { all, chooseTime, followCurves, followTime, made, makeSwitches, nearestTo, one, press, pressable, readDrawings } from "./dom.js";
import { addButtons, headingOf, hidden } from "./keep.js";
import { columnsOf, readOutput, readoutOf, shownOf } from "./outputs.js";

/**
 * @typedef {{layer: string, label: string, isBelow: boolean, isLimit: boolean, isAround: boolean, line: (number | null)[],
 *   stroke?: string, dash?: number[], width: number}} Drawn
 */

/** @type {number[]} */
const time = JSON.parse(one("#times").textContent ?? "").time;
/** @type {Set<OutputPlot>} */
const drawn = new Set();
/** The times that all plots show, where somebody chose them. @type {{min: number, max: number} | null} */
let shown = null;
/** The samples that somebody has chosen. @type {import("./dom.js").CurvesOf | null} */
let curvesOf = null;
/** The time of the page, s. */
let pageTime = Number(all(".clock")[0]?.dataset.instant ?? 0);

/** @param {string} name */
const color = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

/** The outputs that were read, by their numbers. @type {Map<string | undefined, import("./outputs.js").Output>} */
const known = new Map();
/** @param {string} [number] */
const outputOf = number => {
  const output = known.get(number) ?? readOutput(one("section.output[data-output='" + number + "'] > details > script").textContent ?? "");
  known.set(number, output);
  return output;
};

// ---- Drawing --------------------------------------------------------------------------------------------------------

/**
 * What is drawn, from back to front, and bands that fill between two of them.
 * @param {import("./outputs.js").Layer[]} layers @param {boolean} isSpread
 */
const linesOf = (layers, isSpread) => {
  /** @type {Drawn[]} */
  const lines = [];
  /** @type {uPlot.Band[]} */
  const bands = [];
  for (const layer of [...layers].sort((a, b) => Number(b.filled) - Number(a.filled))) {  // lines are seen on fills
    const isLimit = layer.name === "limit";
    if (isSpread && !layer.spread && !isLimit) continue;
    const dash = layer.dashed ? [6, 4] : undefined;
    const style = layer.width > 0 ? { stroke: color(layer.name), width: layer.width, dash } : { width: 0 };
    (isSpread ? layer.around : layer.bands).forEach((band, i) => {
      if (layer.filled) bands.push({ series: [lines.length + 2, lines.length + 1], fill: color(layer.name + "-fill") });
      const about = { layer: layer.name, label: layer.labels[i], isBelow: i % 2 === 1, isLimit, isAround: layer.spread };
      for (const line of band) lines.push({ ...about, line, ...style });
    });
  }
  return { lines, bands };
};

/** @param {string} name @param {number} size @param {number} room @returns {uPlot.Axis} */
const axis = (name, size, room) => {
  /** @type {{text: string[], aside: string}} */
  let found = { text: [], aside: "" };
  return {
    label: () => axisName(name, found.aside), size, stroke: color("soft"), font: "11px system-ui, sans-serif",
    labelFont: "11px system-ui, sans-serif", labelSize: 18,
    splits: (plot, axisNumber, low, high) => {
      const length = (axisNumber === 0 ? plot.bbox.width : plot.bbox.height) / devicePixelRatio;
      const { at, ...rest } = ticks(low, high, Math.max(2, Math.floor(length / room)));
      found = rest;
      return at;
    },
    values: () => found.text,
    grid: { stroke: color("grid"), width: 1 }, ticks: { stroke: color("grid"), width: 1, size: 4 },
  };
};

/** One zoom for all: a plot whose times change hands them on to those that show others. @param {uPlot} plot */
const shareTimes = plot => {
  const { min = 0, max = 0 } = plot.scales.x;
  shown = { min, max };
  for (const { plot: other } of drawn) {
    if (other && other !== plot && (other.scales.x.min !== min || other.scales.x.max !== max)) other.setScale("x", shown);
  }
};

/**
 * How many pieces of lines go through a rectangle of the canvas; those of the layer itself do not count.
 * @param {uPlot} plot @param {Drawn[]} lines @param {string} own
 * @param {number} left @param {number} right @param {number} top @param {number} bottom
 */
const crossings = (plot, lines, own, left, right, top, bottom) => {
  const from = Math.max(0, time.findIndex(t => plot.valToPos(t, "x", true) >= left) - 1);
  let found = 0;
  lines.forEach(({ layer, line }, k) => {
    if (layer === own || !plot.series[k + 1].show) return;
    for (let t = from + 1; t < time.length && plot.valToPos(time[t - 1], "x", true) <= right; ++t) {
      const before = line[t - 1], now = line[t];
      if (before == null || now == null) continue;
      const a = plot.valToPos(before, "y", true), b = plot.valToPos(now, "y", true);
      if (Math.max(a, b) >= top && Math.min(a, b) <= bottom) ++found;
    }
  });
  return found;
};

/** What a label covers of the canvas. @typedef {{left: number, right: number, base: number, height: number}} Label */
/** @param {Label} a @param {Label} b */
const meet = (a, b) => a.left < b.right && b.left < a.right && Math.abs(a.base - b.base) < Math.max(a.height, b.height);

/**
 * At the end or the beginning of what is seen, above or below the line, over no other label if that can be, where the
 * fewest lines are: as on paper.
 * @param {uPlot} plot @param {Drawn[]} lines @param {Drawn} drawnLine @param {Label[]} others
 */
const placeOfLabel = (plot, lines, { label, layer, line, isBelow }, others) => {
  const { ctx, bbox } = plot, px = devicePixelRatio, last = line.findLastIndex(x => x != null);
  if (last < 0) return null;
  const end = Math.min(plot.valToPos(time[last], "x", true), bbox.left + bbox.width) - 4 * px;
  const begin = Math.max(plot.valToPos(time[line.findIndex(x => x != null)], "x", true), bbox.left) + 4 * px;
  const y = plot.valToPos(line[last] ?? 0, "y", true), wide = ctx.measureText(label).width;
  if (end < bbox.left || y < bbox.top || y > bbox.top + bbox.height) return null;
  const isBelowFirst = isBelow || y < bbox.top + 16 * px;
  /** @type {{found: number, label: Label} | null} */
  let best = null;
  for (const edge of [end - wide, begin]) {
    const left = Math.max(bbox.left, Math.min(edge, bbox.left + bbox.width - wide));
    for (const isUnder of [isBelowFirst, !isBelowFirst]) {
      const base = y + (isUnder ? 13 : -4) * px, place = { left, right: left + wide, base, height: 13 * px };
      if (base - 11 * px < bbox.top || base > bbox.top + bbox.height) continue;
      const unreadable = 1e6 * others.filter(other => meet(place, other)).length;
      const found = unreadable + crossings(plot, lines, layer, left, left + wide, base - 11 * px, base + 2 * px);
      if (best == null || found < best.found) best = { found, label: place };
    }
  }
  return best?.label ?? null;
};

/** @param {uPlot} plot @param {Drawn[]} lines */
const drawLabels = (plot, lines) => {
  const { ctx } = plot, px = devicePixelRatio;
  ctx.save();
  ctx.font = 11 * px + "px system-ui, sans-serif";
  ctx.textAlign = "left";
  ctx.textBaseline = "alphabetic";  // axes leave another behind
  ctx.lineWidth = 3 * px;
  ctx.lineJoin = "round";
  ctx.strokeStyle = color("paper");
  /** @type {Label[]} */
  const written = [];
  lines.forEach((line, i) => {
    const place = line.label && plot.series[i + 1].show ? placeOfLabel(plot, lines, line, written) : null;
    if (!place) return;
    written.push(place);
    ctx.strokeText(line.label, place.left, place.base);
    ctx.fillStyle = line.stroke ?? "";
    ctx.fillText(line.label, place.left, place.base);
  });
  ctx.restore();
};

/**
 * Least and greatest of what is seen: limits count wherever they are, or, beside a spread, not at all.
 * @param {uPlot} plot @param {Drawn[]} lines @param {boolean} isSpread @returns {[number, number]}
 */
const rangeOf = (plot, lines, isSpread) => {
  const [from, to] = plot.series[0].idxs ?? [0, time.length - 1];
  let low = Infinity, high = -Infinity;
  lines.forEach(({ line, isLimit }, k) => {
    if (!plot.series[k + 1].show || isLimit && isSpread) return;
    const [first, last] = isLimit ? [0, time.length - 1] : [from, to];
    for (let i = first; i <= last; ++i) {
      const x = line[i];
      if (x == null) continue;
      low = Math.min(low, x);
      high = Math.max(high, x);
    }
  });
  return padded(low, high, 0.04);
};

/**
 * Along the lower end, where a requirement may be violated, wide enough to be seen.
 * @param {uPlot} plot @param {number[][]} missed
 */
const drawMarks = (plot, missed) => {
  const { ctx, bbox } = plot, px = devicePixelRatio, right = bbox.left + bbox.width;
  ctx.save();
  ctx.fillStyle = color("outside");
  for (const [from, until] of missed) {
    const a = Math.max(plot.valToPos(from, "x", true), bbox.left), b = Math.min(plot.valToPos(until, "x", true), right);
    const wide = Math.max(b - a, 3 * px);
    if (b >= a) ctx.fillRect(Math.min((a + b - wide) / 2, right - wide), bbox.top + bbox.height - 6 * px, wide, 6 * px);
  }
  ctx.restore();
};

/** Samples that are chosen, those that violate a requirement dashed. @param {uPlot} plot @param {import("./dom.js").Curve[]} curves */
const drawCurves = (plot, curves) => {
  const { ctx, bbox } = plot, px = devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = px;
  for (const { time: times, values, isMissed } of curves) {
    ctx.strokeStyle = color(isMissed ? "outside" : "sure");
    ctx.setLineDash(isMissed ? [5 * px, 3 * px] : []);
    ctx.beginPath();
    values.forEach((value, i) => {
      const x = plot.valToPos(times[i], "x", true), y = plot.valToPos(value ?? NaN, "y", true);
      if (value == null || i === 0 || values[i - 1] == null) ctx.moveTo(x, value == null ? 0 : y);
      else ctx.lineTo(x, y);
    });
    ctx.stroke();
  }
  ctx.restore();
};

/** A click, unless it ends a zoom, chooses the time of the page. @param {uPlot} plot */
const chooseByClick = plot => {
  let begun = NaN;
  plot.over.addEventListener("mousedown", ({ clientX }) => { begun = clientX; });
  plot.over.addEventListener("click", ({ clientX }) => {
    if (Math.abs(clientX - begun) < 3) chooseTime(plot.posToVal(clientX - plot.over.getBoundingClientRect().left, "x"));
  });
};

/** @param {HTMLElement} place */
const heightIn = place => place.clientWidth < 480 ? 240 : 300;

/**
 * @typedef {{name: string, lines: Drawn[], bands: uPlot.Band[], isSpread: boolean, onCursor: (i?: number | null) => void,
 *   onDraw: (plot: uPlot) => void}} Look
 */

/** @param {HTMLElement} place @param {Look} look */
const makePlot = (place, { name, lines, bands, isSpread, onCursor, onDraw }) => {
  let isReady = false;
  const plot = new uPlot({
    width: Math.max(place.clientWidth, 160), height: heightIn(place), bands,
    scales: { x: { time: false }, y: { range: drawnPlot => rangeOf(drawnPlot, lines, isSpread) } },
    legend: { show: false },
    cursor: { y: false, sync: { key: "gamut", scales: ["x", null] }, points: { show: false }, drag: { x: true, y: true, uni: 24 } },
    axes: [axis("time (s)", 32, 80), axis(name, 58, 45)],
    series: [{}, ...lines.map(({ layer, stroke, width, dash }) => ({
      stroke: stroke || "transparent", width, dash, show: !hidden.has(layer), points: { show: false }, spanGaps: false,
    }))],
    hooks: {
      setScale: [(changed, key) => { if (key === "x" && isReady) shareTimes(changed); }],
      setCursor: [({ cursor }) => onCursor(cursor.idx)], draw: [onDraw, painted => drawLabels(painted, lines)],
    },
  }, [time, ...lines.map(({ line }) => line)], place);
  if (shown) plot.setScale("x", shown);
  chooseByClick(plot);
  isReady = true;
  return plot;
};

// ---- Plots ----------------------------------------------------------------------------------------------------------

/** One output: its views and its plot. The first of the page shows some layers in one view. */
class OutputPlot {
  /** @param {HTMLElement} section */
  constructor(section) {
    this.section = section;
    this.place = one(".live", section);
    /** @type {uPlot | null} */
    this.plot = null;
    /** @type {Drawn[]} */
    this.lines = [];
    /** Where the time of the page is: what is drawn below it stays as it is. */
    this.mark = made("div", { className: "mark" });
    /** @type {(plot: uPlot) => void} */
    this.showBeside = () => {};
    readDrawings(section);
    for (const details of all(".static details", section)) details.replaceWith(one("figure", details));
    if (section.dataset.layers == null) this.addViews();
    const pair = made("div", { className: "pair" }, this.place), [beside] = all("script.beside", section);
    this.main = made("div", { className: "canvas" }, pair);
    this.beside = beside ? new Beside(beside.textContent ?? "", pair) : null;
    const about = made("div", { className: "about" }, this.place);
    this.readout = made("p", { className: "readout" }, about);
    section.classList.add("plotted");
    addButtons(about, {
      columns: () => {
        const output = this.output();
        return columnsOf(output, time, shownOf(output, section.dataset), section.dataset.layers == null ? output.ratios : []);
      },
      figure: () => one(".static figure[data-view='" + section.dataset.view + "']", section),
      title: () => headingOf(section),
    });
  }

  output() {
    return outputOf(this.section.dataset.output);
  }

  addViews() {
    const views = made("div", { className: "views" }, this.place);
    for (const figure of all(".static figure", this.section)) {
      const view = figure.dataset.view;
      views.append(pressable([one("figcaption", figure).textContent ?? ""], view === this.section.dataset.view, button => {
        this.section.dataset.view = view;
        for (const other of all("[aria-pressed]", views)) press(other, other === button);
        this.draw();
      }));
    }
    const closer = made("button", { type: "button", textContent: "Zoom to the time" }, views);
    closer.addEventListener("click", () => this.zoom());
  }

  /** So close to the time of the page that what is known there fills much of the plot. */
  zoom() {
    const { plot, lines } = this, bounds = lines.filter(({ isAround }) => isAround), at = nearestTo(time, pageTime);
    const values = bounds.map(({ line }) => line[at]).filter(x => x != null);
    if (!plot || values.length === 0) return;
    const [low, high] = padded(Math.min(...values), Math.max(...values), 0.6);
    /** @param {number} i */
    const isSeen = i => bounds.some(({ line }) => (line[i] ?? low) >= low && (line[i] ?? low) <= high);
    let from = Math.max(0, at - 2), until = Math.min(time.length - 1, at + 2);
    while (from > 0 && at - from < time.length / 16 && isSeen(from)) --from;
    while (until + 1 < time.length && until - at < time.length / 16 && isSeen(until)) ++until;
    plot.batch(() => {
      plot.setScale("x", { min: time[from], max: time[until] });
      plot.setScale("y", { min: low, max: high });
    });
  }

  draw() {
    this.plot?.destroy();
    const { section } = this, output = this.output(), { view } = this.section.dataset, { unit, ratios } = output;
    const { lines, bands } = linesOf(view === "ratio" ? ratios : shownOf(output, this.section.dataset), view === "spread");
    const name = view === "ratio" ? ratios[0].words : view === "spread" ? "deviation" + (unit ? " (" + unit + ")" : "") : unit;
    /** @param {number | null} [i] */
    const read = i => {
      this.readout.textContent = i == null
        ? "Point at the plot to read it, click to choose the time; drag to zoom, double-click to see all." : readoutOf(output, time, i);
    };
    this.lines = lines;
    const isSpread = view === "spread", isRatio = view === "ratio", missed = isRatio ? [] : output.missed;
    const limits = isSpread ? [] : lines.filter(({ isLimit }) => isLimit).map(({ line }) => line);
    this.showBeside = plot => this.beside?.draw(plot, isRatio ? null : pageTime, isSpread, limits);
    /** @param {uPlot} plot */
    const onDraw = plot => {
      if (view === "absolute" || view == null) drawCurves(plot, curvesOf?.(section.dataset.output ?? "") ?? []);
      drawMarks(plot, missed);
      this.showTime(plot);
    };
    this.beside?.measure();
    this.plot = makePlot(this.main, { name, lines, bands, isSpread, onCursor: read, onDraw });
    this.plot.over.append(this.mark);
    read();
    drawn.add(this);
  }

  /** @param {uPlot | null} plot */
  showTime(plot = this.plot) {
    if (!plot) return;
    const at = plot.valToPos(pageTime, "x");
    this.mark.hidden = !(at >= 0 && at <= plot.bbox.width / devicePixelRatio);
    this.mark.style.transform = "translateX(" + at + "px)";
    this.showBeside(plot);
  }

  /** @param {string} layer @param {boolean} isShown */
  show(layer, isShown) {
    const { plot, lines } = this;
    plot?.batch(() => lines.forEach((line, i) => {
      if (line.layer === layer) plot.setSeries(i + 1, { show: isShown });
    }));
  }

  resize() {
    const width = this.main.clientWidth;
    this.beside?.measure();
    if (width > 0 && this.plot?.width !== width) this.plot?.setSize({ width, height: heightIn(this.main) });  // 0: printed
  }
}

followTime(at => {
  pageTime = at;
  for (const plot of drawn) if (plot.section.matches(".foremost, :has(> details[open])")) plot.showTime();
  const [first] = drawn;  // whose cursor all others have
  first?.plot?.setCursor({ left: first.plot.valToPos(at, "x"), top: 1 });
});

followCurves(chosen => {
  curvesOf = chosen;
  for (const { plot, main } of drawn) if (main.clientWidth > 0) plot?.redraw(false, false);
});

makeSwitches(".outputs > .keys li", (layer, isShown) => {
  if (isShown) hidden.delete(layer);
  else hidden.add(layer);
  for (const plot of drawn) plot.show(layer, isShown);
});

/** Those that somebody saw. @type {Map<Element, OutputPlot>} */
const plots = new Map();
/** @param {HTMLElement} section */
const drawOnce = section => {
  if (plots.has(section)) return;
  const plot = new OutputPlot(section);
  plots.set(section, plot);
  plot.draw();
};
const sections = all("section.output[data-output]");
for (const section of sections) all("details.panel", section)[0]?.addEventListener("toggle", () => drawOnce(section));
// The first, as soon as there is nothing else to do. <html data-plots> says whether it is waiting.
document.documentElement.dataset.plots = "waiting";
/** @param {() => void} then */
const later = then => "requestIdleCallback" in window ? requestIdleCallback(then, { timeout: 300 }) : setTimeout(then, 50);
later(() => {
  for (const section of sections) if (section.matches(".foremost")) drawOnce(section);
  document.documentElement.dataset.plots = "drawn";
});
new ResizeObserver(() => drawn.forEach(plot => plot.resize())).observe(document.body);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawn.forEach(plot => plot.draw()));
