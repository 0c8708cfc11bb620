// Round ticks whose texts differ, the same as ticksOf in reports/drawing/axes.cpp; and numbers as a page carries them.
"use strict";

const gamut = (() => {
  const orderOf = x => Math.floor(Math.log10(x) + 1e-9);
  const roundStep = (width, wanted) => {
    const raw = width / wanted, power = Math.pow(10, Math.floor(Math.log10(raw)));
    let fitting = power;
    for (const step of [1, 2, 5, 10]) {
      if (step > 1 && width < 2.5 * step * power) break;
      fitting = step * power;
      if (raw <= fitting) break;
    }
    return fitting;
  };
  const raised = n => [...String(n)].map(c => c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c]).join("");

  const clamped = n => Math.min(17, Math.max(0, n));
  const offsetText = (from, size, power) => {
    const order = orderOf(size);
    if (order >= -4 && order < 7) return from.toFixed(clamped(-orderOf(power)));
    return (from / Math.pow(10, order)).toFixed(clamped(order - orderOf(power))) + " \u00d7 10" + raised(order);
  };

  // {at, text, aside}: about `wanted` ticks; what they are counted from, or in, where their texts are not the numbers.
  const ticks = (low, high, wanted) => {
    const step = roundStep(high - low, wanted), size = Math.max(Math.abs(low), Math.abs(high)), found = { at: [], text: [], aside: "" };
    if (!(step > 0) || !isFinite(step) || !isFinite(size)) return found;
    let from = 0;
    if (orderOf(size) - orderOf(step) >= 6) {
      const power = Math.pow(10, orderOf(high - low) + 1);
      from = Math.round((low + high) / 2 / power) * power;
      found.aside = offsetText(from, size, power) + " + \u2026";
    }
    const first = Math.ceil((low - from) / step), last = Math.floor((high - from) / step);
    const greatest = step * Math.max(Math.abs(first), Math.abs(last));
    let exponent = greatest > 0 ? orderOf(greatest) : 0;
    const isLong = exponent >= 5 || exponent < -3 || exponent < 0 && orderOf(step) < -5;
    exponent = isLong ? 3 * Math.floor(exponent / 3) : 0;
    if (exponent !== 0) found.aside += (found.aside ? " " : "") + "\u00d7 10" + raised(exponent);
    const decimals = Math.min(12, Math.max(0, exponent - orderOf(step)));
    for (let k = first; k <= last && k <= first + 4 * wanted; ++k) {
      found.at.push(from + k * step);
      found.text.push(k === 0 ? "0" : (k * step / Math.pow(10, exponent)).toFixed(decimals));
    }
    return found;
  };

  const axisName = (name, aside) => name && aside ? name + ", " + aside : name || aside;

  // A range with room around it, as Range::padded in reports/drawing/axes.cpp.
  const padded = (low, high) => {
    if (low == null || high == null || !(low <= high)) return [0, 1];
    const width = high - low, size = Math.max(Math.abs(low), Math.abs(high));
    const room = width > Math.max(1e-12 * size, 1e-300) ? 0.04 * width : size > 1e-300 ? 0.5 * size : 1;
    return [low - room, high + room];
  };

  // Whole numbers from second differences: null where there is none.
  const wholes = list => {
    let value = 0, slope = 0, isFirst = true;
    return list.map(c => {
      if (c == null) return null;
      if (!isFirst) slope += c;
      value = isFirst ? c : value + slope;
      isFirst = false;
      return value;
    });
  };

  // Of whole * 10^scale, rounded once.
  const decimal = scale => {
    const power = Number("1e" + Math.abs(scale));
    return whole => whole == null ? null : scale < 0 ? whole / power : whole * power;
  };

  return { ticks, axisName, padded, wholes, decimal };
})();
