// The residual over frequency and over the position, the frequency response, and the lines of a
// periodic move.
"use strict";

const Spectra = (() => {
  const kinds = [
    ["excited", "excited lines", "the model's numbers"],
    ["odd", "odd lines, not excited", "friction, saturation"],
    ["even", "even lines", "direction, place, gravity"],
    ["between", "between the lines", "noise, what does not repeat"],
    ["mean", "mean", "constant torque"]
  ];

  const longest = story => (story.captures || []).length > 1 ? ", of the longest capture" : "";

  function spectrum(story) {
    const s = story.spectrum;
    if (!s || !s.frequency_Hz.length) return null;
    return plot(
        "spectrum", "Amplitude spectrum" + longest(story),
        Axes.chart(
            {"data-name": "amplitude spectrum"}, 240, {
              name: "frequency",
              unit: "Hz",
              values: s.frequency_Hz.map(f => f > 0 ? f : null),
              log: true
            },
            {name: "amplitude", unit: story.unit.torque, log: true}, [
              {name: "torque", values: s.torque, style: "measured"},
              {name: "residual", values: s.residual, style: "residual"},
              {name: "noise floor", values: s.floor, style: "floor dashed"}
            ]));
  }

  function orders(story) {
    const o = story.orders;
    if (!o || !o.order.length) return null;
    return plot(
        "orders", "Residual over the position",
        Axes.chart(
            {"data-name": "order spectrum"}, 240, {name: "order", unit: o.unit, values: o.order},
            {name: "amplitude", unit: story.unit.torque},
            [{name: "residual", values: o.residual, style: "residual"}]));
  }

  function plot(id, title, ...content) {
    return Dom.make("figure", {id}, Dom.make("h3", {}, title), ...content);
  }

  function biasBand(r) {
    const known = r.bias_std_percent || [];
    const lows = r.bias_percent.map((b, k) => b - known[k]),
          highs = r.bias_percent.map((b, k) => b + known[k]);
    return {lows, highs, draw: f => [Axes.band(f.X, f.Y, r.frequency_Hz, lows, highs, "model")]};
  }

  // Measured points on the model's line.
  function pair(measured, model) {
    return [
      {name: "measured", values: measured, style: "measured", dots: true},
      {name: "model", values: model, style: "model"}
    ];
  }

  const points = (name, values, style) => [{name, values, style, dots: true}];

  function response(story) {
    const r = story.response;
    if (!r || !r.frequency_Hz.length) return null;
    const x = {name: "frequency", unit: "Hz", values: r.frequency_Hz, log: true};
    const bias = biasBand(r);
    const biasRange = Axes.extent([bias.lows, bias.highs, r.bias_percent]);
    const chart = (name, title, y, tracks, extra) => plot(
        "response-" + name, title,
        Axes.chart({"data-name": title}, 200, x, {name, ...y}, tracks, extra));
    const known = r.coherence && r.coherence.some(Numbers.known);
    return Dom.make(
        "div", {id: "response"},
        Dom.make("h3", {}, "Frequency response, from torque to acceleration" + longest(story)),
        Dom.make(
            "div", {class: "multiples"},
            chart(
                "gain", "Gain",
                {unit: `${story.unit.acceleration} per ${story.unit.torque}`, log: true},
                pair(r.measured_gain, r.model_gain)),
            chart("phase", "Phase", {unit: "°"}, pair(r.measured_phase_deg, r.model_phase_deg)),
            chart(
                "bias", "Gain against the model's", {unit: "%", range: biasRange},
                points("bias", r.bias_percent, "model"), bias.draw),
            known ? chart(
                        "coherence", "Coherence", {unit: "1", range: [0, 1.05]},
                        points("coherence", r.coherence, "measured")) :
                    null));
  }

  function lineRow(lines, [key, name, meaning]) {
    if (!Numbers.known(lines[key])) return null;
    const of = group => lines[group] && lines[group][key];
    const figure = (kind, v) => Table.number(v, Numbers.percent(v), {"data-kind": kind});
    const count = of("count");
    return Table.row(
        {"data-lines": key}, Table.head(name), Table.number(count, count),
        figure("residual", lines[key]), figure("torque", of("torque")),
        figure("noise", of("noise")), Table.text(meaning));
  }

  function lines(story) {
    const l = story.compare && story.compare.lines;
    if (!l) return null;
    const base = Numbers.known(l.base_Hz) ?
        `; the lines are multiples of ${Numbers.significant(l.base_Hz, 4)} Hz.` :
        ".";
    return Dom.make(
        "figure", {id: "lines"}, Dom.make("h3", {}, "Lines of the periodic move"),
        Dom.make("p", {class: "hint"}, "Shares of power" + base),
        Table.make(
            {}, ["lines", ["number"], ["residual"], ["torque"], ["noise"], "from"],
            kinds.map(kind => lineRow(l, kind))));
  }

  function parts(story) {
    const pair = [spectrum(story), orders(story)].filter(Boolean);
    return [
      pair.length ? Dom.make("div", {class: "pair"}, pair) : null, response(story), lines(story)
    ];
  }

  return {parts};
})();
