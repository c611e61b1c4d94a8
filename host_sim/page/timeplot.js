// The time section: torque, what is left of it, position; one window and one cursor over all three.
"use strict";

const TimePlot = (() => {
  // What is shown at first; the others wait for their switch.
  const switches = [
    {key: "recorded_torque", label: "recorded torque, unfiltered", on: false},
    {key: "refined_torque", label: "refined model", on: false},
    {key: "refined_residual", label: "residual of the refined model", on: true},
    {key: "loop_position", label: "position of the model in its own loop", on: false}
  ];

  const keysHelp = "Plots over time. Arrows move, plus and minus zoom, Home shows all.";
  const handHelp =
      "Drag to zoom, shift-drag or two fingers to pan, Ctrl and wheel to zoom, double click for all.";

  // Outlives the section, which the studio builds anew with every story.
  const kept = {file: null, on: Object.fromEntries(switches.map(s => [s.key, s.on]))};

  // Those on the page; a graph listens to the window until it is told to stop.
  let alive = [];

  function replace(strips) {
    alive.filter(s => s.graph).forEach(s => s.graph.destroy());
    alive = strips;
  }

  // Draws the strips in other colours, or with other tracks.
  let themed = () => {};

  function track(capture, key, name, style) {
    let decoded;
    const source = capture.series[key];
    return source &&
        {key, name, style, decoded: () => decoded || (decoded = Series.decode(source))};
  }

  function stripsOf(capture, unit) {
    const tracks = (...specs) => specs.map(s => track(capture, ...s)).filter(Boolean);
    const specs = [
      {
        key: "torque",
        name: "torque",
        unit: unit.torque,
        tracks: tracks(
            ["recorded_torque", "recorded", "recorded"], ["torque", "measured", "measured"],
            ["model_torque", "model", "model"], ["refined_torque", "refined model", "refined"])
      },
      {
        key: "residual",
        name: "residual",
        unit: unit.torque,
        tracks: tracks(
            ["residual", "what the model leaves", "residual"],
            ["refined_residual", "what the refined model leaves", "refined"])
      },
      {
        key: "position",
        name: "position",
        unit: unit.position,
        tracks: tracks(
            ["position", "measured", "measured"], ["loop_position", "model in its loop", "model"])
      }
    ];
    const there = specs.filter(s => s.tracks.length);
    return there.map((s, k) => Strips.make({...s, last: k === there.length - 1}));
  }

  const wanted = key => !(key in kept.on) || kept.on[key];

  // Only what the capture holds.
  function toggles(capture, rebuild) {
    const there = switches.filter(s => capture.series[s.key]);
    return Dom.make("div", {class: "toggles"}, there.map(s => {
      const box =
          Dom.make("input", {type: "checkbox", id: "show-" + s.key, checked: kept.on[s.key]});
      box.addEventListener("change", () => {
        kept.on[s.key] = box.checked;
        rebuild();
      });
      return Dom.make("label", {}, box, " ", s.label);
    }));
  }

  // A capture is built once it has a width; a graph cannot be drawn without.
  function whenWide(box, strips, view) {
    let width = 0;
    const rebuild = () => width && strips.forEach(s => Strips.build(s, view, wanted));
    new ResizeObserver(() => {
      if (box.clientWidth === width || box.clientWidth === 0) return;
      width = box.clientWidth;
      rebuild();
      performance.mark("servoid-time-drawn");
    }).observe(box);
    return rebuild;
  }

  function panel(capture, unit, adequate) {
    const strips = stripsOf(capture, unit);
    replace(strips);
    const {span, tell} = TimeWindow.reading();
    const view = TimeWindow.make(capture, strips, tell);
    tell(view);
    const under =
        Dom.make("p", {class: "axis-title under", "data-axis": "x", "data-unit": "s"}, "time, s");
    const plots = Dom.make(
        "div",
        {id: "time-plots", class: "strips", tabindex: "0", role: "group", "aria-label": keysHelp},
        strips.map(s => s.box), under);
    strips.forEach(s => Gestures.attach(s, view));
    Gestures.attachKeys(plots, view);
    themed = whenWide(plots, strips, view);
    return [
      Dom.make(
          "div", {class: "controls"}, TimeWindow.buttons(view), span, toggles(capture, themed)),
      plots, Dom.make("p", {class: "hint"}, handHelp), Worst.list(view, adequate)
    ];
  }

  // Without the folder, where that still tells them apart.
  function shortNames(captures) {
    const short = captures.map(c => c.file.split(/[\\/]/).pop());
    return new Set(short).size === short.length ? short : captures.map(c => c.file);
  }

  function tabs(captures, chosen, choose) {
    if (captures.length < 2) return null;
    const names = shortNames(captures);
    return Dom.make(
        "div", {class: "tabs", role: "group", "aria-label": "captures"},
        captures.map(
            (c, k) => Dom.make(
                "button", {
                  type: "button",
                  id: "capture-tab-" + k,
                  title: c.file,
                  "aria-pressed": String(c === chosen),
                  click: () => choose(c)
                },
                names[k])));
  }

  function band(captures) {
    const all = captures.map(c => c.band_Hz).filter(Numbers.known);
    if (!all.length) return ".";
    const ends = [Math.min(...all), Math.max(...all)].map(f => Numbers.significant(f, 3));
    return `; both up to ${[...new Set(ends)].join(" … ")} Hz.`;
  }

  Theme.onChange(() => themed());

  function section(story) {
    const captures = (story.captures || []).filter(c => Object.values(c.series).some(Boolean));
    if (!captures.length) return null;
    const place = Dom.make("div", {});
    const choose = capture => {
      kept.file = capture.file;
      Dom.refill(
          place, tabs(captures, capture, choose),
          panel(capture, story.unit, story.verdict === "adequate"));
    };
    choose(captures.find(c => c.file === kept.file) || captures[0]);
    return Dom.section(
        "time", "Over time",
        "Measured torque and the model's, below it what the model leaves" + band(captures), place);
  }

  return {section};
})();
