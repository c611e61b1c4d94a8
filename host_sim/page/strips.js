// One strip of the time plot: a dygraph of some tracks, its legend that reads the cursor, its
// bands.
"use strict";

const Strips = (() => {
  const axisWidth = 58;

  // Fixed names: the library writes its labels as markup, so nothing of a file may reach it.
  function options(strip, view) {
    const quiet = Theme.colour("muted"), line = Theme.colour("line");
    return {
      labels: ["time"].concat(strip.shown.map(t => t.name)),
      legend: "never",
      colors: strip.shown.map(t => Theme.colour(t.style)),
      strokeWidth: 1.1,
      connectSeparatedPoints: true,
      highlightCircleSize: 0,
      rightGap: 0,
      interactionModel: {},
      axisLineColor: quiet,
      gridLineColor: line,
      gridLineWidth: 1,
      axisLabelFontSize: 12,
      dateWindow: [view.from, view.to],
      yRangePad: 6,
      axes: {
        x: {drawAxis: strip.last, drawGrid: true, pixelsPerLabel: 90},
        y: {
          axisLabelWidth: axisWidth,
          pixelsPerLabel: 32,
          axisLabelFormatter: v => Numbers.significant(v, 4)
        }
      },
      underlayCallback: (canvas, area, graph) => shade(canvas, area, graph, view.bands),
    };
  }

  function shade(canvas, area, graph, bands) {
    canvas.save();
    bands.forEach((band, k) => {
      const left = Math.max(area.x, graph.toDomXCoord(band.from_s));
      const right = Math.min(area.x + area.w, graph.toDomXCoord(band.to_s));
      if (right <= area.x || left >= area.x + area.w) return;
      canvas.fillStyle = Theme.colour("shade");
      canvas.fillRect(left, area.y, Math.max(2, right - left), area.h);
      canvas.fillStyle = Theme.colour("residual");
      canvas.font = "11px system-ui";
      canvas.fillText(String(k + 1), left + 3, area.y + 11);
    });
    canvas.restore();
  }

  function reading(track, t) {
    const pair = t === null ? null : Series.at(track.decoded(), t);
    if (!pair) return "";
    const [low, high] = pair.map(v => Numbers.significant(v, 4));
    return low === high ? low : `${low} … ${high}`;
  }

  function entry(strip, track) {
    const value = Dom.make("span", {class: "number", "data-track": track.key});
    strip.outputs.push({track, value});
    return Dom.make(
        "span", {}, Dom.make("i", {class: "swatch " + track.style}), track.name, " ", value);
  }

  function columns(strip) {
    return Math.max(50, Math.floor(strip.body.clientWidth - axisWidth));
  }

  function rows(strip, view) {
    const found =
        Series.rows(strip.shown.map(t => t.decoded()), view.from, view.to, columns(strip));
    return found.length ? found : [[view.from].concat(strip.shown.map(() => null))];
  }

  // New tracks or colours: a new graph.
  function build(strip, view, wanted) {
    strip.shown = strip.tracks.filter(t => wanted(t.key));
    if (!strip.shown.length) strip.shown = strip.tracks;
    strip.outputs = [];
    Dom.refill(
        strip.head,
        Dom.make(
            "span", {class: "axis-title", "data-axis": "y", "data-unit": strip.unit},
            `${strip.name}, ${strip.unit}`),
        strip.shown.map(t => entry(strip, t)));
    if (strip.graph) strip.graph.destroy();
    strip.graph = new Dygraph(strip.canvas, rows(strip, view), options(strip, view));
  }

  function show(strip, view) {
    strip.graph.updateOptions({file: rows(strip, view), dateWindow: [view.from, view.to]});
  }

  function point(strip, t) {
    strip.cursor.hidden = t === null;
    if (t !== null) strip.cursor.style.left = strip.graph.toDomXCoord(t) + "px";
    strip.outputs.forEach(o => {
      o.value.textContent = reading(o.track, t);
    });
  }

  // spec: {key, name, unit, tracks, last}
  function make(spec) {
    const canvas = Dom.make("div", {class: "canvas"});
    const cursor = Dom.make("div", {class: "cursor", hidden: true});
    const selection = Dom.make("div", {class: "selection", hidden: true});
    const body = Dom.make("div", {class: "strip-body " + spec.key}, canvas, cursor, selection);
    const head = Dom.make("p", {class: "legend strip-head"});
    const box = Dom.make("div", {class: "strip", id: "strip-" + spec.key}, head, body);
    return {
      ...spec,
      canvas,
      cursor,
      selection,
      body,
      head,
      box,
      graph: null,
      shown: [],
      outputs: []
    };
  }

  return {make, build, show, point};
})();
