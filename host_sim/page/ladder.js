// The ladder: error after each step, as bars down to the noise floor.
"use strict";

const Ladder = (() => {
  const rowHeight = 30, foot = 40;

  // Steps: {name, error, unseen}. Logarithmic, so that the last steps are seen beside the first.
  function picture(width, steps, floor) {
    const known = steps.flatMap(s => [s.error, s.unseen]).concat(floor).filter(v => Numbers.known(v) && v > 0);
    if (!known.length) return null;
    const least = Math.min(...known);
    const X = Axes.scale(least / 1.3, Math.max(...known) * 1.1, 12, width - 16, true);
    const bottom = steps.length * rowHeight;
    const base = X(floor > 0 ? floor : X.from);
    const bars = steps.map((s, k) => [
      s.error > 0 ? Dom.svg("rect", { class: "rung", "data-step": k, x: Math.min(base, X(s.error)), y: k * rowHeight + 8, width: Math.max(1, Math.abs(X(s.error) - base)), height: 14 }) : null,
      s.unseen > 0 ? Dom.svg("circle", { class: "unseen", cx: X(s.unseen), cy: k * rowHeight + 15, r: 4 }) : null]);
    const ticks = Axes.ticksOf(X, width / 90).map(t => Dom.svg("g", { class: "tick" },
      Dom.svg("line", { class: "grid", x1: X(t), x2: X(t), y1: 0, y2: bottom }),
      Dom.svg("text", { x: X(t), y: bottom + 14, "text-anchor": "middle" }, Numbers.significant(100 * t, 3))));
    return Dom.svg("svg", { width, height: bottom + foot, class: "plot", role: "img", "aria-label": "error per step" }, ticks, bars,
      floor > 0 ? Dom.svg("line", { class: "floor-line", x1: base, x2: base, y1: 0, y2: bottom }) : null,
      floor > 0 && width > 340 ? Dom.svg("text", { x: base, y: bottom + 32 }, "noise floor") : null,
      Dom.svg("text", { class: "axis-title", "data-axis": "x", "data-unit": "%", x: width - 16, y: bottom + 32, "text-anchor": "end" }, width > 220 ? "torque error (logarithmic), %" : "error, %"));
  }

  function numbers(steps) {
    const unseen = steps.some(s => Numbers.known(s.unseen));
    const head = (text, number) => Dom.make("th", { scope: "col", class: number ? "number" : "" }, text);
    return Dom.make("table", { class: "ladder-table" },
      Dom.make("thead", {}, Dom.make("tr", {}, head("step"), head("fitted", true), unseen && head("unseen", true))),
      Dom.make("tbody", {}, steps.map((s, k) => Dom.make("tr", { "data-step": k }, Dom.make("th", { scope: "row" }, Dom.name(s.name)),
        Dom.make("td", { class: "number", "data-figure": "fitted", "data-value": s.error }, Numbers.percent(s.error)),
        unseen && Dom.make("td", { class: "number", "data-figure": "unseen", "data-value": s.unseen }, Numbers.percent(s.unseen))))));
  }

  function draw(steps, floor) {
    return Dom.make("div", { class: "ladder" }, numbers(steps), Dom.drawing({ class: "rungs" }, width => picture(width, steps, floor)));
  }

  function section(story) {
    const r = story.refine;
    if (!r || r.ladder.length === 0) return null;
    const steps = r.ladder.map(s => ({ name: s.added ? "+ " + s.added : "as it was", error: s.torque_error, unseen: s.validation_error }));
    return Dom.section("ladder", "The ladder", "One effect at a time, as long as data that was not fitted say so. Bars: fitted data, down to the noise floor. Dots: unseen data.",
      draw(steps, r.noise_floor),
      Dom.make("p", { class: "floor-note" }, "Noise floor ", Dom.value("ladder-floor", r.noise_floor, Numbers.percent(r.noise_floor)), "."),
      r.removed && r.removed.length ? Dom.make("p", { id: "removed" }, "Removed again, needless in the end: ", r.removed.join(", "), ".") : null);
  }

  return { section, draw };
})();
