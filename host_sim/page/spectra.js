// The residual over frequency and over the position, the frequency response, and the lines of a periodic move.
"use strict";

const Spectra = (() => {
  const kinds = [
    ["excited", "excited lines", "the model's numbers"], ["odd", "odd lines, not excited", "friction, saturation"],
    ["even", "even lines", "direction, place, gravity"]];

  function spectrum(story) {
    const s = story.spectrum;
    if (!s || !s.frequency_Hz.length) return null;
    return plot("spectrum", "Amplitude spectrum", Axes.chart({ "data-name": "amplitude spectrum" }, 240,
      { name: "frequency", unit: "Hz", values: s.frequency_Hz.map(f => f > 0 ? f : null), log: true },
      { name: "amplitude", unit: story.unit.torque, log: true }, [
        { name: "torque", values: s.torque, style: "measured" }, { name: "residual", values: s.residual, style: "residual" },
        { name: "noise floor", values: s.floor, style: "floor dashed" }]));
  }

  function orders(story) {
    const o = story.orders;
    if (!o || !o.order.length) return null;
    return plot("orders", "Residual over the position", Axes.chart({ "data-name": "order spectrum" }, 240,
      { name: "order", unit: o.unit, values: o.order }, { name: "amplitude", unit: story.unit.torque },
      [{ name: "residual", values: o.residual, style: "residual" }]));
  }

  function plot(id, title, ...content) {
    return Dom.make("figure", { id }, Dom.make("h3", {}, title), ...content);
  }

  function biasBand(r) {
    const known = r.bias_std_percent || [];
    const lows = r.bias_percent.map((b, k) => b - known[k]), highs = r.bias_percent.map((b, k) => b + known[k]);
    return { lows, highs, draw: f => [Axes.band(f.X, f.Y, r.frequency_Hz, lows, highs, "model")] };
  }

  function response(story) {
    const r = story.response;
    if (!r || !r.frequency_Hz.length) return null;
    const x = { name: "frequency", unit: "Hz", values: r.frequency_Hz, log: true };
    const bias = biasBand(r);
    const pair = (measured, model) => [{ name: "measured", values: measured, style: "measured", dots: true }, { name: "model", values: model, style: "model" }];
    const gainUnit = `${story.unit.acceleration} per ${story.unit.torque}`;
    const chart = (name, y, tracks, extra) => plot("response-" + name, y.title, Axes.chart({ "data-name": y.title }, 200, x, y, tracks, extra));
    return Dom.make("div", { id: "response" }, Dom.make("h3", {}, "Frequency response, from torque to acceleration"),
      Dom.make("div", { class: "multiples" },
        chart("gain", { title: "Gain", name: "gain", unit: gainUnit, log: true }, pair(r.measured_gain, r.model_gain)),
        chart("phase", { title: "Phase", name: "phase", unit: "°" }, pair(r.measured_phase_deg, r.model_phase_deg)),
        chart("bias", { title: "Gain against the model's", name: "bias", unit: "%", range: Axes.extent([bias.lows, bias.highs, r.bias_percent]) },
          [{ name: "bias", values: r.bias_percent, style: "model", dots: true }], bias.draw),
        r.coherence && r.coherence.some(Numbers.known) ? chart("coherence", { title: "Coherence", name: "coherence", unit: "1", range: [0, 1.05] },
          [{ name: "coherence", values: r.coherence, style: "measured", dots: true }]) : null));
  }

  function lineRow(lines, [key, name, meaning]) {
    if (!Numbers.known(lines[key])) return null;
    const cell = (kind, v) => Dom.make("td", { class: "number", "data-kind": kind, "data-value": v }, Numbers.percent(v));
    const of = (group) => lines[group] && lines[group][key];
    return Dom.make("tr", { "data-lines": key }, Dom.make("th", { scope: "row" }, name),
      Dom.make("td", { class: "number" }, lines.count && lines.count[key] !== undefined ? lines.count[key] : ""),
      cell("residual", lines[key]), cell("torque", of("torque")), cell("noise", of("noise")), Dom.make("td", {}, meaning));
  }

  function lines(story) {
    const l = story.compare && story.compare.lines;
    if (!l) return null;
    const heads = ["lines", "number", "residual", "torque", "noise", "from"];
    const rest = [["between", "between the lines", "noise, what does not repeat"], ["mean", "mean", "constant torque"]];
    return Dom.make("figure", { id: "lines" }, Dom.make("h3", {}, "Lines of the periodic move"),
      Dom.make("p", { class: "hint" }, "Shares of power" + (Numbers.known(l.base_Hz) ? `; the lines are multiples of ${Numbers.significant(l.base_Hz, 4)} Hz.` : ".")),
      Dom.make("table", {}, Dom.make("thead", {}, Dom.make("tr", {}, heads.map((h, k) =>
        Dom.make("th", { scope: "col", class: k > 0 && k < 5 ? "number" : "" }, h)))),
      Dom.make("tbody", {}, kinds.concat(rest).map(kind => lineRow(l, kind)))));
  }

  function parts(story) {
    const pair = [spectrum(story), orders(story)].filter(Boolean);
    return [pair.length ? Dom.make("div", { class: "pair" }, pair) : null, response(story), lines(story)];
  }

  return { parts };
})();
