// The ladder: error after each step, as bars down to the noise floor.
"use strict";

const Ladder = (() => {
  const rowHeight = 30, foot = 40;
  const lede = "One effect at a time, as long as data that was not fitted say so. " +
      "Bars: fitted data, down to the noise floor. Dots: unseen data.";

  function bar(s, k, X, base) {
    const y = k * rowHeight + 8;
    const width = Math.max(1, Math.abs(X(s.error) - base));
    return [
      s.error > 0 ? Dom.svg("rect", {
        class: "rung",
        "data-step": k,
        x: Math.min(base, X(s.error)),
        y,
        width,
        height: 14
      }) :
                    null,
      s.unseen > 0 ? Dom.svg("circle", {class: "unseen", cx: X(s.unseen), cy: y + 7, r: 4}) : null
    ];
  }

  function ticks(X, width, bottom) {
    const apart = 26;  // pixels, so that none runs into the next
    let last = -apart;
    return Axes.ticksOf(X, width / 90)
        .filter(t => X(t) - last >= apart && (last = X(t)))
        .map(
            t => Dom.svg(
                "g", {class: "tick"},
                Dom.svg("line", {class: "grid", x1: X(t), x2: X(t), y1: 0, y2: bottom}),
                Dom.svg(
                    "text", {x: X(t), y: bottom + 14, "text-anchor": "middle"},
                    Numbers.significant(100 * t, 3))));
  }

  function floorLine(x, width, bottom) {
    return [
      Dom.svg("line", {class: "floor-line", x1: x, x2: x, y1: 0, y2: bottom}),
      width > 340 ? Dom.svg("text", {x, y: bottom + 32}, "noise floor") : null
    ];
  }

  // Steps: {name, error, unseen}. Logarithmic, so that the last steps are seen beside the first.
  function picture(width, steps, floor) {
    const known = steps.flatMap(s => [s.error, s.unseen])
                      .concat(floor)
                      .filter(v => Numbers.known(v) && v > 0);
    if (!known.length) return null;
    const X = Axes.scale(Math.min(...known) / 1.3, Math.max(...known) * 1.1, 12, width - 16, true);
    const bottom = steps.length * rowHeight;
    const base = X(floor > 0 ? floor : X.from);
    const place = {x: width - 16, y: bottom + 32, "text-anchor": "end"};
    return Dom.svg(
        "svg",
        {width, height: bottom + foot, class: "plot", role: "img", "aria-label": "error per step"},
        ticks(X, width, bottom), steps.map((s, k) => bar(s, k, X, base)),
        floor > 0 ? floorLine(base, width, bottom) : null,
        Dom.svg(
            "text", {class: "axis-title", "data-axis": "x", "data-unit": "%", ...place},
            width > 220 ? "torque error (logarithmic), %" : "error, %"));
  }

  function numbers(steps) {
    const unseen = steps.some(s => Numbers.known(s.unseen));
    const figure = (kind, v) => Table.number(v, Numbers.percent(v), {"data-figure": kind});
    return Table.make(
        {class: "ladder-table"}, ["step", ["fitted"], unseen && ["unseen"]],
        steps.map(
            (s, k) => Table.row(
                {"data-step": k}, Table.head(Dom.name(s.name)), figure("fitted", s.error),
                unseen && figure("unseen", s.unseen))));
  }

  function draw(steps, floor) {
    return Dom.make(
        "div", {class: "ladder"}, numbers(steps),
        Dom.drawing({class: "rungs"}, width => picture(width, steps, floor)));
  }

  function removed(names) {
    if (!names || !names.length) return null;
    return Dom.make(
        "p", {id: "removed"}, "Removed again, needless in the end: ", names.join(", "), ".");
  }

  function section(story) {
    const r = story.refine;
    if (!r || r.ladder.length === 0) return null;
    const steps = r.ladder.map(s => ({
                                 name: s.added ? "+ " + s.added : "as it was",
                                 error: s.torque_error,
                                 unseen: s.validation_error
                               }));
    return Dom.section(
        "ladder", "The ladder", lede, draw(steps, r.noise_floor),
        Dom.make(
            "p", {class: "floor-note"}, "Noise floor ",
            Dom.value("ladder-floor", r.noise_floor, Numbers.percent(r.noise_floor)), "."),
        removed(r.removed));
  }

  return {section, draw};
})();
