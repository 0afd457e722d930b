// Curves of several variants with bands: log or linear, whose of them, mean or median, each seed. All charts of a page
// follow the same switches. page.data: {optimum, names, labels, axes}; axes[i]: {name, at, curves}, a curve per name:
// {mean, deviation, median, lower, upper, searches}.
"use strict";
const charts = {
  view: {scale: "log", band: "mean", seeds: false, hidden: new Set()},
  all: [],
};

charts.element = (svg, name, attributes, text) => {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  svg.append(node);
  return node;
};

// About `count` round numbers within [low, high].
charts.ticks = (low, high, count) => {
  const rough = (high - low) / count || 1, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * 0.999);
  const list = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) list.push(i * step || 0);
  return list;
};
// 1, 2, 5 of each power of ten, or powers alone where there are many.
charts.logTicks = (low, high, count) => {
  const list = [], powers = Math.log10(high / low), factors = powers * 3 <= count ? [1, 2, 5] : [1];
  const stride = Math.max(1, Math.ceil(powers / count));
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power) {
    for (const factor of factors) {
      const value = factor * 10 ** power;
      if (power % stride === 0 && value >= low * 0.999 && value <= high * 1.001) list.push(value);
    }
  }
  return list;
};
charts.label = (value) => {
  const size = Math.abs(value);
  const [divisor, letter] = size >= 1e9 ? [1e9, "G"] : size >= 1e6 ? [1e6, "M"] : size >= 1e4 ? [1e3, "k"] : [1, ""];
  return Number((value / divisor).toPrecision(4)).toLocaleString("en", {maximumFractionDigits: 6}) + letter;
};

// Middle line and band of a curve, as the switch has it.
charts.lines = (curve) => charts.view.band === "mean"
    ? {middle: curve.mean, low: curve.mean.map((v, i) => v === null ? null : v - curve.deviation[i]),
       high: curve.mean.map((v, i) => v === null ? null : v + curve.deviation[i])}
    : {middle: curve.median, low: curve.lower, high: curve.upper};

class Chart {
  constructor(figure) {
    this.svg = figure.querySelector("svg");
    this.readout = figure.querySelector(".readout");
    this.axis = page.data.axes[Number(figure.dataset.axis)];
    this.chosen = -1;
    const choose = (event) => this.chooseAt(event.clientX);
    this.svg.addEventListener("pointermove", choose);
    this.svg.addEventListener("pointerdown", choose);
    this.svg.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.draw()).observe(this.svg);
  }

  shown() {
    return this.axis.curves.map((curve, index) => ({curve, index, lines: charts.lines(curve)}))
        .filter(({index}) => !charts.view.hidden.has(index));
  }

  // Everything of the upper end, and below it what the lines come to once they have made a tenth of their way.
  range(shown) {
    const highs = [], lows = [];
    for (const {lines} of shown) {
      const middles = lines.middle.filter((v) => v !== null);
      if (!middles.length) continue;
      highs.push(...lines.high.filter((v) => v !== null));
      const start = Math.min(...middles), end = Math.max(...middles);
      lows.push(charts.view.scale === "log" ? start : middles[Math.floor(middles.length / 20)] ?? start);
      lows.push(end);
    }
    if (!highs.length) return [0, 1];
    let low = Math.min(...lows), high = Math.max(...highs);
    const optimum = page.data.optimum;
    if (optimum > 0 && high > 0.9 * optimum) high = Math.max(high, optimum);
    if (optimum > 0) high = Math.min(high, optimum);
    if (low < -0.5 * Math.abs(high)) low = -0.5 * Math.abs(high);  // first models may be far below all that matters
    const room = (high - low || Math.abs(high) || 1) * 0.04;
    return [low >= 0 && low < 0.12 * high ? 0 : low - room, high + room];
  }

  draw() {
    const {svg, axis} = this, width = svg.clientWidth, height = svg.clientHeight;
    if (width < 40 || axis.at.length < 1) return;
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const shown = this.shown(), [low, high] = this.range(shown), log = charts.view.scale === "log";
    const names = page.data.labels.map((name) => name.length > 14 ? name.slice(0, 13) + "\u2026" : name);
    const longest = Math.max(0, ...shown.map(({index}) => names[index].length));
    const edge = {left: 50, right: 22 + 7.2 * longest, top: 12, bottom: 40};
    const last = axis.at[axis.at.length - 1], first = log ? axis.at[0] : 0;
    const floor = height - edge.bottom, across = width - edge.left - edge.right;
    const part = (v) => log ? Math.log(v / first) / Math.log(last / first || 2) : v / (last || 1);
    const x = (v) => edge.left + (last > first ? part(v) : 0) * across;
    const y = (v) => Math.min(Math.max(floor - (v - low) / (high - low) * (floor - edge.top), edge.top), floor);
    this.layout = {x, y, floor, top: edge.top, shown};
    this.drawAxes(x, y, low, high, first, last, edge, width, height, log);
    for (const one of shown) this.drawCurve(one, x, y);
    this.drawNames(shown, names, x, y, edge, floor);
    this.choose(this.chosen < 0 ? this.lastOfAll(shown) : this.chosen);
  }

  drawAxes(x, y, low, high, first, last, edge, width, height, log) {
    const {svg, axis} = this, floor = height - edge.bottom, right = width - edge.right;
    const unit = page.data.optimum > 0 ? page.data.optimum / 100 : 1;
    for (const tick of charts.ticks(low / unit, high / unit, 6)) {
      const at = y(tick * unit);
      charts.element(svg, "line", {class: "grid", x1: edge.left, x2: right, y1: at, y2: at});
      charts.element(svg, "text", {x: edge.left - 7, y: at + 4, "text-anchor": "end"},
                     charts.label(tick) + (page.data.optimum > 0 ? "\u2009%" : ""));
    }
    const across = Math.max(2, (right - edge.left) / 70);
    for (const tick of log ? charts.logTicks(first, last, across) : charts.ticks(first, last, across)) {
      charts.element(svg, "line", {class: "axis", x1: x(tick), x2: x(tick), y1: floor, y2: floor + 5});
      charts.element(svg, "text", {x: x(tick), y: floor + 18, "text-anchor": "middle"}, charts.label(tick));
    }
    charts.element(svg, "line", {class: "axis", x1: edge.left, x2: right, y1: floor, y2: floor});
    charts.element(svg, "text", {x: (edge.left + right) / 2, y: height - 4, "text-anchor": "middle"}, axis.name);
    if (page.data.optimum > 0 && page.data.optimum < high) {
      charts.element(svg, "line", {class: "optimum", x1: edge.left, x2: right, y1: y(page.data.optimum),
                                   y2: y(page.data.optimum)});
    }
  }

  // "x,y" of the points that are there; steps, since a best stays until the next.
  points(values, x, y) {
    const list = [];
    values.forEach((v, i) => { if (v !== null) list.push(x(this.axis.at[i]).toFixed(1) + "," + y(v).toFixed(1)); });
    return list;
  }

  drawCurve({curve, index, lines}, x, y) {
    const kind = "s" + index;
    const low = this.points(lines.low, x, y), high = this.points(lines.high, x, y);
    charts.element(this.svg, "polygon", {class: "band " + kind, points: low.concat(high.reverse()).join(" ")});
    for (const search of charts.view.seeds ? curve.searches : []) {
      charts.element(this.svg, "polyline", {class: "thin " + kind, points: this.points(search, x, y).join(" ")});
    }
    charts.element(this.svg, "polyline", {class: "line " + kind, points: this.points(lines.middle, x, y).join(" ")});
  }

  // Each name beside the end of its line, moved apart where they would meet.
  drawNames(shown, names, x, y, edge, floor) {
    const labels = [];
    for (const {index, lines} of shown) {
      let i = lines.middle.length - 1;
      while (i >= 0 && lines.middle[i] === null) --i;
      if (i >= 0) labels.push({index, x: x(this.axis.at[i]), y: y(lines.middle[i])});
    }
    labels.sort((a, b) => a.y - b.y);
    const gap = 15;
    labels.forEach((one, i) => { one.at = Math.max(one.y, i ? labels[i - 1].at + gap : edge.top); });
    for (let i = labels.length - 1, limit = floor; i >= 0; --i, limit = labels[i + 1].at - gap) {
      labels[i].at = Math.min(labels[i].at, limit);
    }
    const right = this.svg.clientWidth - edge.right;
    for (const one of labels) {
      if (one.x < right - 4) {
        charts.element(this.svg, "circle", {class: "s" + one.index, r: 3, cx: one.x, cy: one.y});
      }
      const from = one.x < right - 4 ? one.at : one.y;
      charts.element(this.svg, "polyline", {class: "leader s" + one.index,
                                            points: `${right + 2},${from} ${right + 9},${one.at}`});
      charts.element(this.svg, "text", {class: "name s" + one.index, x: right + 12, y: one.at + 4}, names[one.index]);
    }
  }

  choose(index) {
    const {axis, layout} = this;
    if (!layout) return;
    this.chosen = Math.min(Math.max(index, 0), axis.at.length - 1);
    for (const old of this.svg.querySelectorAll(".mark")) old.remove();
    const at = layout.x(axis.at[this.chosen]);
    charts.element(this.svg, "line", {class: "cursor mark", x1: at, x2: at, y1: layout.top, y2: layout.floor});
    this.readout.replaceChildren();
    const say = (text, kind) => {
      const span = document.createElement("span");
      if (kind) {
        const swatch = document.createElement("i");
        swatch.className = "swatch " + kind;
        span.append(swatch);
      }
      span.append(text);
      this.readout.append(span);
    };
    say((axis.name === "seconds" ? "after " + page.readable(axis.at[this.chosen]) + " s"
                                 : "after " + charts.label(axis.at[this.chosen]) + " " + axis.name) + ":");
    const rows = layout.shown.filter(({lines}) => lines.middle[this.chosen] !== null)
        .sort((a, b) => b.lines.middle[this.chosen] - a.lines.middle[this.chosen]);
    for (const {index: which, lines} of rows) {
      const middle = lines.middle[this.chosen];
      charts.element(this.svg, "circle", {class: "mark s" + which, r: 4, cx: at, cy: layout.y(middle)});
      const around = charts.view.band === "mean"
          ? " \u00b1 " + page.score(lines.high[this.chosen] - middle)
          : " (" + page.score(lines.low[this.chosen]) + " to " + page.score(lines.high[this.chosen]) + ")";
      say(page.data.names[which] + " " + page.score(middle) + around, "s" + which);
    }
    if (!rows.length) say("no score of all seeds yet");
  }

  // The last point at which all that are shown have a value.
  lastOfAll(shown) {
    let i = this.axis.at.length - 1;
    while (i > 0 && shown.some(({lines}) => lines.middle[i] === null)) --i;
    return i;
  }

  chooseAt(clientX) {
    if (!this.layout) return;
    const at = clientX - this.svg.getBoundingClientRect().left;
    let nearest = 0;
    this.axis.at.forEach((v, i) => {
      if (Math.abs(this.layout.x(v) - at) < Math.abs(this.layout.x(this.axis.at[nearest]) - at)) nearest = i;
    });
    this.choose(nearest);
  }

  key(event) {
    const step = {ArrowLeft: -1, ArrowRight: 1, PageUp: -20, PageDown: 20, Home: -1e9, End: 1e9}[event.key];
    if (!step) return;
    event.preventDefault();
    this.choose(this.chosen + step);
  }
}

charts.draw = () => charts.all.forEach((chart) => chart.draw());
charts.switchTo = (name, value) => {
  charts.view[name] = value;
  for (const button of document.querySelectorAll(`[id^="${name}-"]`)) {
    button.setAttribute("aria-pressed", button.id === name + "-" + value);
  }
  charts.draw();
};

charts.begin = () => {
  for (const [name, values] of [["scale", ["log", "linear"]], ["band", ["mean", "median"]]]) {
    for (const value of values) {
      page.byId(name + "-" + value)?.addEventListener("click", () => charts.switchTo(name, value));
    }
  }
  page.byId("show-seeds")?.addEventListener("change", (event) => {
    charts.view.seeds = event.target.checked;
    charts.draw();
  });
  document.querySelectorAll(".series button").forEach((button, index) => button.addEventListener("click", () => {
    const {hidden} = charts.view;
    if (!hidden.delete(index)) hidden.add(index);
    button.setAttribute("aria-pressed", !hidden.has(index));
    charts.draw();
  }));
  charts.all = [...document.querySelectorAll("figure.chart")].map((figure) => new Chart(figure));
  charts.draw();
  const missing = charts.all.filter(({svg, axis}) =>
      svg.querySelectorAll("polyline.line").length !== axis.curves.length).length;
  page.done("charts", missing ? missing + " of them lack lines" : "");
};
charts.begin();
