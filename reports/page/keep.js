// Two small buttons at each figure: its numbers as CSV to the clipboard, and the figure as an SVG file that needs nothing
// beside it. <html data-page="ready"> says that the page is done, <html data-error="..."> what went wrong.
"use strict";

(() => {
  const root = document.documentElement;

  // ---- Numbers ------------------------------------------------------------------------------------------------------

  const quoted = text => /[",\r\n]/.test(text) ? "\"" + text.replaceAll("\"", "\"\"") + "\"" : text;
  const csv = columns => {
    const rows = Math.max(...columns.map(column => column.length));
    const row = i => columns.map(column => quoted(String(column[i] ?? ""))).join(",");
    return Array.from({ length: rows }, (_, i) => row(i)).join("\n") + "\n";
  };

  // Columns of a plot over time: all its layers, whichever are shown.
  const columnsOf = section => {
    const output = gamut.plots.outputOf(section.dataset.output);
    const named = words => words + (output.unit ? " (" + output.unit + ")" : "");
    const columns = [["time (s)", ...gamut.plots.time]];
    const first = output.name + ", ";
    for (const layer of gamut.plots.shownOf(output, section)) {
      layer.bands.forEach((band, i) => {
        const words = first + (layer.kind === "stack" ? "level " + layer.levels[i] + " of " + layer.name : layer.labels[i] ?? layer.words);
        if (layer.kind === "line") columns.push([named(words), ...band[0]]);
        else columns.push([named(words + ", from"), ...band[0]], [named(words + ", to"), ...band[1]]);
      });
    }
    for (const ratio of section.dataset.layers == null ? output.ratios : []) columns.push([first + ratio.words, ...ratio.bands[0][0]]);
    return columns;
  };

  const copied = async text => {
    try {
      await navigator.clipboard.writeText(text);
      return true;
    } catch {  // not allowed here: by way of a selection
      const area = document.body.appendChild(Object.assign(document.createElement("textarea"), { value: text }));
      area.select();
      const isDone = document.execCommand("copy");
      area.remove();
      return isDone;
    }
  };

  // ---- Drawings -----------------------------------------------------------------------------------------------------

  const looks = ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "stroke-linejoin", "stroke-linecap",
    "opacity", "font-size", "text-anchor", "paint-order", "visibility"];
  const made = (name, attributes, parent) => {
    const element = parent.appendChild(document.createElementNS(parent.namespaceURI, name));
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  };

  // As it looks on paper, on white, with its title above and its key below.
  const drawing = (svg, title, keys, skipped) => {
    root.dataset.paper = "";
    const copy = svg.cloneNode(true), from = svg.querySelectorAll("*"), to = copy.querySelectorAll("*"), gone = [];
    from.forEach((element, i) => {
      const style = getComputedStyle(element);
      if (element.style.display === "none" || skipped.has(element.classList[0])) gone.push(to[i]);
      for (const look of looks) to[i].style.setProperty(look, style.getPropertyValue(look));
      to[i].removeAttribute("class");
    });
    gone.forEach(element => element.remove());
    const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number), above = 28;
    copy.removeAttribute("class");
    copy.setAttribute("font-family", "system-ui, sans-serif");
    const body = document.createElementNS(svg.namespaceURI, "g");
    body.append(...copy.childNodes);
    const ground = made("rect", { width, fill: "#ffffff" }, copy);
    made("text", { x: 8, y: 19, "font-size": 14, "font-weight": 600, fill: "#1d2733" }, copy).textContent = title;
    body.setAttribute("transform", "translate(0 " + above + ")");
    copy.append(body);
    let x = 10, y = above + height + 16;
    for (const key of keys) {
      const words = key.textContent.trim(), wide = 34 + 6.3 * words.length;
      if (x > 10 && x + wide > width) {
        x = 10;
        y += 18;
      }
      const swatch = key.querySelector(".swatch"), style = getComputedStyle(swatch), isLine = style.borderTopWidth !== "0px" && style.borderBottomWidth === "0px";
      const edge = style.borderTopWidth !== "0px" ? { stroke: style.borderTopColor, "stroke-width": style.borderTopWidth,
        ...(style.borderTopStyle === "dashed" && { "stroke-dasharray": "5 3" }) } : {};
      const name = key.dataset.layer, fill = getComputedStyle(root).getPropertyValue("--" + name + "-fill") || style.backgroundColor;
      if (isLine) made("path", { d: "M" + x + " " + (y - 4) + "h24", ...edge }, copy);
      else made("rect", { x, y: y - 10, width: 24, height: 11, fill, opacity: style.opacity, ...edge }, copy);
      made("text", { x: x + 30, y, "font-size": 11, fill: "#1d2733" }, copy).textContent = words;
      x += wide + 14;
    }
    delete root.dataset.paper;
    const whole = keys.length > 0 ? y + 12 : above + height + 6;
    ground.setAttribute("height", whole);
    copy.setAttribute("viewBox", "0 0 " + width + " " + whole);
    copy.setAttribute("width", width);
    copy.setAttribute("height", whole);
    return new XMLSerializer().serializeToString(copy);
  };

  const save = (text, name) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
    link.download = name.replace(/[^\p{L}\p{N}]+/gu, "_").replace(/^_|_$/g, "") + ".svg";
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  };

  // ---- Buttons ------------------------------------------------------------------------------------------------------

  const addButtons = (place, { columns, figure, title, keys }) => {
    const bar = document.createElement("div");
    bar.className = "keep";
    const button = (words, label, onPress) => {
      const one = bar.appendChild(Object.assign(document.createElement("button"), { type: "button", textContent: words }));
      one.setAttribute("aria-label", label + " of " + title());
      one.addEventListener("click", async () => {
        const said = await onPress();
        if (!said) return;
        one.textContent = said;
        setTimeout(() => { one.textContent = words; }, 1500);
      });
    };
    if (columns) button("Copy CSV", "Copy the numbers", async () => await copied(csv(columns())) ? "Copied" : "Not allowed");
    button("Save SVG", "Save the drawing", () => save(drawing(figure().querySelector("svg"), title(), keys(), gamut.plots?.hidden ?? new Set()), title()));
    place.prepend(bar);
  };

  const headingOf = element => element.closest("section").querySelector("h3, h2").textContent;
  const keysOf = svg => {
    const names = new Set([...svg.querySelectorAll("path, rect")].map(element => element.classList[0]));
    return [...document.querySelectorAll(".keys li")].filter((key, i, all) => names.has(key.dataset.layer) &&
      !gamut.plots?.hidden.has(key.dataset.layer) && all.findIndex(other => other.dataset.layer === key.dataset.layer) === i);
  };

  if (gamut.plots) {
    for (const section of document.querySelectorAll("section.output[data-output]")) {
      const figure = () => section.querySelector(".static figure[data-view='" + section.dataset.view + "']");
      addButtons(section.querySelector(".live .about"), {
        columns: () => columnsOf(section), figure, title: () => headingOf(section),
        keys: () => keysOf(figure().querySelector("svg")),
      });
    }
  }
  const captions = new Map([...document.querySelectorAll("figure.kept > figcaption")].map(caption => [caption.parentNode, caption.textContent]));
  for (const figure of document.querySelectorAll("figure.kept")) {
    const numbers = figure.querySelector("script.numbers"), caption = figure.querySelector("figcaption");
    addButtons(caption ?? figure, {
      columns: numbers && (() => JSON.parse(numbers.textContent)), figure: () => figure,
      title: () => headingOf(figure) + (caption ? ", " + captions.get(figure) : ""), keys: () => keysOf(figure.querySelector("svg")),
    });
  }
  const picture = document.querySelector(".picture figure");
  if (picture) addButtons(picture.closest(".picture"), { figure: () => picture, title: () => headingOf(picture), keys: () => [...document.querySelectorAll(".picture .keys li")] });

  window.addEventListener("beforeprint", () => document.querySelectorAll("section > details:not(.more)").forEach(part => { part.open = true; }));
  root.dataset.page = "ready";
})();
