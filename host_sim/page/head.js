// The verdict, and how far the model is from what can be reached at all.
"use strict";

const Head = (() => {
  const meaning = {
    missing: "an effect is missing",
    ambiguous: "several effects explain it",
    adequate: "the residual is noise",
    unknown: "no effect in the catalogue explains it",
    insufficient: "the captures cannot answer"
  };

  // What the diagnosis says of itself, else what the comparison says.
  function errors(story) {
    const d = story.diagnose, r = story.refine, c = story.compare;
    const now = d && Numbers.known(d.error_before) ? d.error_before : c && c.torque_error;
    const floor = [r, d, c].filter(Boolean).map(x => x.noise_floor).find(Numbers.known);
    return {now, floor, ...after(now, d, story.refined_toml ? r : null)};
  }

  function after(now, d, r) {
    const rungs = r ? r.ladder : [];
    if (rungs.length > 1)
      return {
        after: rungs[rungs.length - 1].torque_error,
        by: "refined model",
        taken: "what was added"
      };
    const best = d && d.candidates[0];
    const helps = best && d.verdict === "unknown" && best.error_after < 0.9 * now;
    const found = best && (d.verdict === "missing" || d.verdict === "ambiguous" || helps);
    return found ? {after: best.error_after, by: "with " + best.effect, taken: best.effect} :
                   {after: null, by: ""};
  }

  function figure(id, name, share, note, style) {
    return Dom.make(
        "div", {class: "figure " + style}, Dom.make("span", {class: "name"}, name),
        Dom.value(id, share, Numbers.percent(share)), Dom.make("span", {class: "note"}, note));
  }

  // A part of the bar, with its name where there is room.
  function part(style, from, to, name) {
    const width = Math.max(0, to - from);
    return [
      Dom.svg("rect", {class: style, x: from, y: 2, width, height: 20}),
      width > 16 + 6.5 * name.length ?
          Dom.svg("text", {class: "inside " + style, x: from + 8, y: 16}, name) :
          null
    ];
  }

  // From the floor up: what is left, and what the effects take.
  function bar(e) {
    const known = [e.now, e.after, e.floor].filter(v => Numbers.known(v) && v > 0);
    if (!known.length) return null;
    return Dom.drawing({id: "error-bar", class: "error-bar"}, width => {
      const X = Axes.scale(Math.min(...known) / 2, Math.max(1, ...known), 0, width - 24, true);
      const ticks =
          Axes.ticksOf(X, 5)
              .filter(t => X(t) >= 12)
              .map(
                  t => Dom.svg(
                      "g", {class: "tick"}, Dom.svg("line", {x1: X(t), x2: X(t), y1: 24, y2: 29}),
                      Dom.svg(
                          "text", {x: X(t), y: 42, "text-anchor": "middle"},
                          Numbers.significant(100 * t, 3))));
      return Dom.svg(
          "svg", {
            width,
            height: 62,
            class: "plot",
            role: "img",
            "aria-label": "error on a logarithmic scale"
          },
          barParts(e, X), ticks,
          Dom.svg(
              "text", {class: "axis-title", "data-axis": "x", "data-unit": "%", x: 0, y: 58},
              "torque error (logarithmic), %"));
    });
  }

  function barParts(e, X) {
    const floor = X(e.floor > 0 ? e.floor : X.from);
    const left = e.after > 0 ? e.after : e.now;
    return [
      part("below-floor", 0, floor, "noise"),
      left > 0 ? part("left-over", floor, X(left), "still unexplained") : null,
      e.after > 0 && e.now > 0 ? part("taken", X(e.after), X(e.now), "explained by " + e.taken) :
                                 null
    ];
  }

  function figures(story) {
    const e = errors(story);
    const band = story.compare && Numbers.known(story.compare.band_Hz) ?
        `up to ${Numbers.significant(story.compare.band_Hz, 3)} Hz` :
        "";
    const given =
        Numbers.known(story.given_error) ? `as given ${Numbers.percent(story.given_error)}` : band;
    const from = story.compare && story.compare.noise_floor_from;
    return [
      Dom.make(
          "div", {class: "figures"}, figure("error-now", "torque error now", e.now, given, "now"),
          figure(
              "error-after", "torque error after", e.after, e.by || "nothing to add yet", "after"),
          figure("noise-floor", "noise floor", e.floor, from ? `from ${from}` : band, "floor")),
      bar(e)
    ];
  }

  function section(story) {
    const verdict = story.verdict;
    return Dom.make(
        "section", {id: "verdict-section", class: "head"},
        Dom.make("h1", {id: "title"}, story.title),
        Dom.make(
            "p", {class: "verdict-line"},
            Dom.make(
                "span", {
                  id: "verdict",
                  class: "badge",
                  "data-verdict": verdict || "none",
                  title: meaning[verdict]
                },
                verdict || "not diagnosed yet"),
            Dom.make("span", {id: "sentence"}, story.sentence)),
        figures(story), warnings(story));
  }

  function warnings(story) {
    const all = [story.compare, story.diagnose, story.refine].flatMap(x => (x && x.warnings) || []);
    const once = [...new Set(all)];
    return once.length ?
        Dom.make("ul", {id: "warnings", class: "warnings"}, once.map(w => Dom.make("li", {}, w))) :
        null;
  }

  return {section};
})();
