// The curve of best and mean, against seconds or evaluations.
"use strict";
(() => {
  const {best, mean, optimum} = page.data, svg = page.byId("plot"), readout = page.byId("readout");
  let by = page.kept.plot === "evaluations" ? "evaluations" : "seconds";
  let chosen = -1, layout = null;

  // About `count` round numbers within [low, high].
  const ticks = (low, high, count) => {
    const rough = (high - low) / count || 1, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * 0.999);
    const list = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) list.push(i * step || 0);
    return {list, step};
  };
  const label = (value, step) => {
    const [divisor, letter] = step >= 1e6 ? [1e6, "M"] : step >= 1000 ? [1000, "k"] : [1, ""];
    const digits = Math.max(0, -Math.floor(Math.log10(step / divisor) + 1e-9));
    return (value / divisor).toLocaleString("en", {maximumFractionDigits: digits}) + (value ? letter : "");
  };
  const element = (name, attributes, text) => {
    const node = document.createElementNS(svg.namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (text !== undefined) node.textContent = text;
    svg.append(node);
    return node;
  };

  // The first means lie far below everything that matters: the axis begins at the best's start, or where nine in ten of
  // the means are above.
  const range = () => {
    const sorted = [...mean].sort((a, b) => a - b);
    let low = Math.min(best[0], sorted[Math.floor(sorted.length / 10)]);
    let high = Math.max(...best.slice(-1), sorted[sorted.length - 1]);
    if (optimum > high) high = optimum;
    if (low > 0 && low < 0.5 * high) low = 0;
    const room = (high - low || Math.abs(high) || 1) * 0.04;
    return [low - (low === 0 ? 0 : room), high + room];
  };

  const draw = () => {
    const width = svg.clientWidth, height = svg.clientHeight;
    if (width < 40 || !best.length) return;
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const xs = page.data[by], [low, high] = range(), last = xs[xs.length - 1] || 1;
    const edge = {left: 52, right: 14, top: 40, bottom: 40};
    const x = (value) => edge.left + value / last * (width - edge.left - edge.right);
    const y = (value) => height - edge.bottom - (value - low) / (high - low) * (height - edge.top - edge.bottom);
    const yTicks = ticks(low, high, 6), xTicks = ticks(0, last, width / 95);
    for (const v of yTicks.list) {
      element("line", {class: "grid", x1: edge.left, x2: width - edge.right, y1: y(v), y2: y(v)});
      element("text", {x: edge.left - 7, y: y(v) + 4, "text-anchor": "end"}, label(v, yTicks.step));
    }
    for (const v of xTicks.list) {
      element("line", {class: "axis", x1: x(v), x2: x(v), y1: height - edge.bottom, y2: height - edge.bottom + 5});
      element("text", {x: x(v), y: height - edge.bottom + 18, "text-anchor": "middle"}, label(v, xTicks.step));
    }
    element("line", {class: "axis", x1: edge.left, x2: width - edge.right, y1: height - edge.bottom,
                     y2: height - edge.bottom});
    element("text", {x: (edge.left + width - edge.right) / 2, y: height - 4, "text-anchor": "middle"}, by);
    if (optimum > 0) {
      element("line", {class: "optimum", x1: edge.left, x2: width - edge.right, y1: y(optimum), y2: y(optimum)});
      element("text", {x: width - edge.right, y: y(optimum) - 6, "text-anchor": "end"}, "most that any model could score");
    }
    const floor = height - edge.bottom;
    for (const [name, values] of [["mean", mean], ["best", best]]) {
      const points = values.map((v, i) => x(xs[i]).toFixed(1) + "," + Math.min(y(v), floor).toFixed(1));
      element("polyline", {class: name, points: points.join(" ")});
    }
    drawLegend(edge);
    layout = {x, y, xs, floor, top: edge.top};
    if (chosen >= 0) choose(chosen);
  };

  const drawLegend = (edge) => {
    let at = edge.left + 2;
    for (const [name, text] of [["best", "best so far"], ["mean", "population's mean"]]) {
      element("polyline", {class: name, points: `${at},9 ${at + 18},9`});
      const words = element("text", {class: name, x: at + 23, y: 13}, text);
      at += 40 + words.getComputedTextLength();
    }
  };

  const choose = (index) => {
    chosen = Math.min(Math.max(index, 0), best.length - 1);
    for (const old of svg.querySelectorAll(".mark")) old.remove();
    const at = layout.x(layout.xs[chosen]);
    element("line", {class: "cursor mark", x1: at, x2: at, y1: layout.top, y2: layout.floor});
    for (const [name, values] of [["mean", mean], ["best", best]]) {
      element("circle", {class: name + " mark", r: 4, cx: at, cy: Math.min(layout.y(values[chosen]), layout.floor)});
    }
    const share = optimum > 0 ? " (" + (100 * best[chosen] / optimum).toFixed(1) + " %)" : "";
    readout.textContent = "after " + page.data.seconds[chosen].toFixed(2) + " s and " +
        page.readable(page.data.evaluations[chosen]) + " evaluations: best " + page.readable(best[chosen]) + share +
        ", mean " + page.readable(mean[chosen]);
  };
  const chooseAt = (event) => {
    if (!layout) return;
    const at = event.clientX - svg.getBoundingClientRect().left;
    let nearest = 0;
    layout.xs.forEach((v, i) => {
      if (Math.abs(layout.x(v) - at) < Math.abs(layout.x(layout.xs[nearest]) - at)) nearest = i;
    });
    choose(nearest);
  };
  svg.addEventListener("pointermove", chooseAt);
  svg.addEventListener("pointerdown", chooseAt);
  svg.addEventListener("keydown", (event) => {
    const step = {ArrowLeft: -1, ArrowRight: 1, PageUp: -50, PageDown: 50, Home: -1e9, End: 1e9}[event.key];
    if (!step || !layout) return;
    event.preventDefault();
    choose(chosen + step);
  });

  const switchTo = (axis) => {
    by = axis;
    page.keep("plot", axis);
    for (const one of ["seconds", "evaluations"]) page.byId("by-" + one).setAttribute("aria-pressed", one === axis);
    draw();
  };
  for (const one of ["seconds", "evaluations"]) page.byId("by-" + one).addEventListener("click", () => switchTo(one));
  switchTo(by);
  if (layout) choose(best.length - 1);
  new ResizeObserver(draw).observe(svg);
  const points = Math.min(...[...svg.querySelectorAll("polyline.best")].slice(0, 1).map((l) => l.points.numberOfItems));
  page.done("plot", points === best.length ? "" : "the curve has " + points + " points of " + best.length);
})();
