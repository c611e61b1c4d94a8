// Small plots in SVG: scales, ticks, a frame with a unit on every axis, lines and dots.
"use strict";

const Axes = (() => {
  const margin = {left: 52, right: 12, top: 24, bottom: 40};

  // From the data's range to pixels. `log` where all is positive.
  function scale(from, to, start, end, log) {
    const f = log ? Math.log10 : x => x;
    const a = f(from), b = f(to);
    const share = x => b > a ? (f(x) - a) / (b - a) : 0.5;  // one value is in the middle
    const map = x => start + (end - start) * share(x);
    return Object.assign(map, {from, to, log: Boolean(log)});
  }

  // The least and the most of lists of numbers, widened a little; `log` ignores what has no
  // logarithm.
  function extent(lists, {log = false, zero = false, pad = 0.05} = {}) {
    let least = zero ? 0 : Infinity, most = zero ? 0 : -Infinity;
    for (const list of lists) {
      for (const x of list || []) {
        if (!Numbers.known(x) || (log && x <= 0)) continue;
        least = Math.min(least, x);
        most = Math.max(most, x);
      }
    }
    if (least > most) return log ? [1, 10] : [0, 1];
    if (log) return [least / 1.15, most * 1.15];
    const margin = (most - least || Math.abs(most) || 1) * pad;
    return [least - margin, most + margin];
  }

  function linearTicks(from, to, count) {
    const rough = (to - from) / Math.max(1, count);
    const power = Math.pow(10, Math.floor(Math.log10(rough)));
    const step = power * [1, 2, 5, 10].find(m => m * power >= rough * 0.999);
    const ticks = [];
    for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k)
      ticks.push(k * step);
    return ticks.map(t => Number(t.toPrecision(10)));
  }

  function logTicks(from, to, count) {
    const decades = Math.log10(to / from);
    const heads = decades > 2.6 ? [1] : decades > 1 ? [1, 3] : [1, 2, 5];
    const every = Math.max(1, Math.ceil(decades / count));
    const ticks = [];
    for (let p = Math.floor(Math.log10(from)); p <= Math.ceil(Math.log10(to)); ++p) {
      if (heads.length === 1 && p % every) continue;
      for (const head of heads) {
        const t = Number((head * Math.pow(10, p)).toPrecision(3));
        if (t >= from && t <= to) ticks.push(t);
      }
    }
    return ticks.length > 1 ? ticks : linearTicks(from, to, Math.min(count, 3));
  }

  function ticksOf(map, count) {
    if (map.log) return logTicks(map.from, map.to, count);
    const ticks = linearTicks(map.from, map.to, count);
    const few = ticks.length < 2 && map.to > map.from && count < 20;
    return few ? ticksOf(map, 2 * count) : ticks;  // one is no scale
  }

  function title(axis, spec, place) {
    return Dom.svg(
        "text", {class: "axis-title", "data-axis": axis, "data-unit": spec.unit, ...place},
        spec.unit === "1" ? spec.name : `${spec.name}, ${spec.unit}`);
  }

  function xTicks(map, bottom, count) {
    return ticksOf(map, count)
        .map(
            t => Dom.svg(
                "g", {class: "tick"},
                Dom.svg("line", {x1: map(t), x2: map(t), y1: bottom, y2: bottom + 4}),
                Dom.svg(
                    "text", {x: map(t), y: bottom + 16, "text-anchor": "middle"},
                    Numbers.significant(t, 4))));
  }

  function yTicks(map, left, right, count) {
    return ticksOf(map, count)
        .map(
            t => Dom.svg(
                "g", {class: "tick"},
                Dom.svg("line", {class: "grid", x1: left, x2: right, y1: map(t), y2: map(t)}),
                Dom.svg(
                    "text", {x: left - 6, y: map(t) + 4, "text-anchor": "end"},
                    Numbers.significant(t, 4))));
  }

  // x, y: {name, unit, range, log}. Gives the picture and where a value of x or y is in it.
  function frame(width, height, x, y, label) {
    const right = width - margin.right, bottom = height - margin.bottom;
    const X = scale(x.range[0], x.range[1], margin.left, right, x.log);
    const Y = scale(y.range[0], y.range[1], bottom, margin.top, y.log);
    const picture = Dom.svg(
        "svg", {
          width,
          height,
          viewBox: `0 0 ${width} ${height}`,
          role: "img",
          "aria-label": label,
          class: "plot"
        },
        yTicks(Y, margin.left, right, height / 45), xTicks(X, bottom, (right - margin.left) / 64),
        Dom.svg("line", {class: "axis", x1: margin.left, x2: right, y1: bottom, y2: bottom}),
        title("y", y, {x: 4, y: 12}),
        title("x", x, {x: right, y: height - 6, "text-anchor": "end"}));
    if (!y.log && y.range[0] < 0 && y.range[1] > 0) {
      picture.append(
          Dom.svg("line", {class: "zero", x1: margin.left, x2: right, y1: Y(0), y2: Y(0)}));
    }
    return {picture, X, Y, left: margin.left, right, top: margin.top, bottom};
  }

  const drawable = (map, v) => Numbers.known(v) && (!map.log || v > 0);

  // A line that stops where there is no number.
  function line(X, Y, xs, ys, style) {
    let path = "", down = false;
    xs.forEach((x, k) => {
      const there = drawable(X, x) && drawable(Y, ys[k]);
      if (there) path += `${down ? "L" : "M"}${X(x).toFixed(1)} ${Y(ys[k]).toFixed(1)}`;
      down = there;
    });
    return Dom.svg("path", {class: "line " + style, d: path});
  }

  // All dots are one path: thousands of elements would be slow.
  function dots(X, Y, xs, ys, style) {
    let path = "";
    xs.forEach((x, k) => {
      if (drawable(X, x) && drawable(Y, ys[k]))
        path += `M${X(x).toFixed(1)} ${Y(ys[k]).toFixed(1)}h0`;
    });
    return Dom.svg("path", {class: "dots " + style, d: path});
  }

  function band(X, Y, xs, lows, highs, style) {
    const held = xs.map((x, k) => [x, lows[k], highs[k]])
                     .filter(p => drawable(X, p[0]) && drawable(Y, p[1]) && drawable(Y, p[2]));
    const there = held.map(p => `${X(p[0]).toFixed(1)} ${Y(p[2]).toFixed(1)}`);
    const back = held.reverse().map(p => `${X(p[0]).toFixed(1)} ${Y(p[1]).toFixed(1)}`);
    return Dom.svg(
        "path",
        {class: "band " + style, d: held.length ? `M${there.concat(back).join("L")}Z` : ""});
  }

  // Lines over one axis: tracks of {name, values, style}. The names stand above the plot as its
  // legend.
  function chart(attributes, height, x, y, tracks, extra) {
    const shown = tracks.filter(t => t.values && t.values.some(Numbers.known));
    const box = Dom.drawing(attributes, width => {
      const f = frame(
          width, height, {...x, range: extent([x.values], {log: x.log, pad: 0})},
          {...y, range: y.range || extent(shown.map(t => t.values), {log: y.log})},
          attributes["data-name"]);
      if (extra) f.picture.append(...extra(f));
      for (const t of shown)
        f.picture.append((t.dots ? dots : line)(f.X, f.Y, x.values, t.values, t.style));
      return f.picture;
    });
    return [legend(shown), box];
  }

  function legend(tracks) {
    const named = tracks.length > 1 ?
        tracks :
        [];  // one needs no name, but its place: plots side by side stay level
    return Dom.make(
        "p", {class: "legend"},
        named.map(t => Dom.make("span", {}, Dom.make("i", {class: "swatch " + t.style}), t.name)));
  }

  return {scale, extent, frame, line, dots, band, chart, legend, ticksOf};
})();
