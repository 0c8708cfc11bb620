// What a page knows of an output, as numbers: read, put into words and into columns.
"use strict";

/** @typedef {(number | null)[]} Line */
/**
 * @typedef {{name: string, words: string, kind: "band" | "line" | "stack", readout: string, filled: boolean, width: number,
 *   dashed: boolean, spread: boolean, labels: string[], levels: (number | null)[], bands: Line[][], around: Line[][]}} Layer
 */
/**
 * As timeData and plotData (reports/drawing/screen.hpp) write it.
 * @typedef {{name: string, unit: string, middleName: string, thin: boolean, scale: number, middle: Line, layers: Layer[],
 *   around: Layer[] | null, ratios: Layer[], missed: number[][]}} Output
 */

/** Whole numbers from second differences: null where there is none. @param {Line} list @returns {Line} */
export const wholes = list => {
  let value = 0, slope = 0, isFirst = true;
  return list.map(c => {
    if (c == null) return null;
    if (!isFirst) slope += c;
    value = isFirst ? c : value + slope;
    isFirst = false;
    return value;
  });
};

/** Of whole * 10^scale, rounded once. @param {number} scale @returns {(whole: number | null) => number | null} */
export const decimal = scale => {
  const power = Number("1e" + Math.abs(scale));
  return whole => whole == null ? null : scale < 0 ? whole / power : whole * power;
};

/** With its lines as numbers: of each layer the motion, and the spread around the middle. @param {string} json */
export const readOutput = json => {
  /** @type {Output} */
  const output = JSON.parse(json);
  const value = decimal(output.scale), middle = wholes(output.middle);
  for (const layer of output.layers) {
    const bands = layer.bands.map(band => band.map(wholes));
    layer.bands = bands.map(band => band.map(line => line.map((x, i) => x == null ? null : value(x + (middle[i] ?? 0)))));
    layer.around = bands.map(band => band.map(line => line.map((x, i) => middle[i] == null ? null : value(x))));
  }
  for (const { name, bands } of output.around ?? []) {
    const layer = output.layers.find(other => other.name === name);
    if (layer) layer.around = bands.map(band => band.map(list => wholes(list).map(value)));
  }
  return output;
};

/**
 * The first plot of a page shows only some layers, and of the limits those of one requirement; both separated by blanks.
 * @param {Output} output @param {{layers?: string, limits?: string}} only @returns {Layer[]}
 */
export const shownOf = (output, { layers, limits = "" }) => {
  if (layers == null) return output.layers;
  /** @template T @param {T[]} list */
  const some = list => list.filter((_, i) => limits.split(" ").includes(String(i)));
  return output.layers.filter(layer => layers.split(" ").includes(layer.name)).map(layer => layer.name !== "limit" ? layer :
    { ...layer, bands: some(layer.bands), around: some(layer.around), labels: some(layer.labels) });
};

/**
 * As many digits as show a difference of the given width; rounded down (side -1), up (side 1) or to nearest (side 0).
 * @param {number | null} x @param {number} [width] @param {number} [side]
 */
export const numberText = (x, width = 0, side = 0) => {
  if (x == null) return "none";
  const wanted = width > 0 && x !== 0 ? Math.ceil(Math.log10(Math.abs(x) / width)) + 4 : 5;
  const digits = Math.min(15, Math.max(4, wanted));
  const nearest = Number(x.toPrecision(digits));
  if (x === 0 || side * (nearest - x) >= 0) return nearest.toString();
  const unit = Math.pow(10, Math.floor(Math.log10(Math.abs(x))) - digits + 1);
  return Number((nearest + side * unit).toPrecision(digits)).toString();
};

/** What is known at a time. @param {Output} output @param {number[]} time @param {number} i */
export const readoutOf = (output, time, i) => {
  const said = output.layers.filter(layer => layer.readout);
  const widths = said.map(layer => layer.kind === "band" && layer.bands[0][1][i] != null ? layer.bands[0][1][i] - (layer.bands[0][0][i] ?? 0) : 0);
  const width = Math.max(0, ...widths);
  /** @param {Layer} layer */
  const numbers = layer => {
    const [lower, upper] = layer.bands[0];
    return layer.kind === "line" ? numberText(lower[i], width) : "[" + numberText(lower[i], width, -1) + ", " + numberText(upper[i], width, 1) + "]";
  };
  const parts = ["t = " + numberText(time[i]) + " s", ...said.map(layer => layer.readout + " " + numbers(layer))];
  for (const ratio of output.ratios) {
    if (ratio.bands[0][0][i] != null) parts.push(ratio.readout + " " + numberText(ratio.bands[0][0][i]));
  }
  return parts.join(" · ") + (output.unit ? " (" + output.unit + ")" : "");
};

/**
 * A plot over time as columns, each with its heading: all these layers, whichever the reader sees.
 * @param {Output} output @param {number[]} time @param {Layer[]} layers @param {Layer[]} ratios
 */
export const columnsOf = (output, time, layers, ratios) => {
  /** @param {string} words */
  const named = words => output.name + ", " + words + (output.unit ? " (" + output.unit + ")" : "");
  /** @type {unknown[][]} */
  const columns = [["time (s)", ...time]];
  for (const layer of layers) {
    layer.bands.forEach((band, i) => {
      const words = layer.kind === "stack" ? "level " + layer.levels[i] + " of " + layer.name : layer.labels[i] ?? layer.words;
      if (layer.kind === "line") columns.push([named(words), ...band[0]]);
      else columns.push([named(words + ", from"), ...band[0]], [named(words + ", to"), ...band[1]]);
    });
  }
  for (const ratio of ratios) columns.push([output.name + ", " + ratio.words, ...ratio.bands[0][0]]);
  return columns;
};

/** @param {unknown[][]} columns */
export const csv = columns => {
  /** @param {string} text */
  const quoted = text => /[",\r\n]/.test(text) ? "\"" + text.replaceAll("\"", "\"\"") + "\"" : text;
  const rows = Math.max(...columns.map(column => column.length));
  /** @param {number} i */
  const row = i => columns.map(column => quoted(String(column[i] ?? ""))).join(",");
  return Array.from({ length: rows }, (_, i) => row(i)).join("\n") + "\n";
};
