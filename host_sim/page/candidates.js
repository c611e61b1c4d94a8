// Which effect: what was tried, best first, and why.
"use strict";

const Candidates = (() => {
  const atLeast = 4, likely = 0.001;
  const lede = "Every effect of the catalogue was fitted together with all numbers of the model, " +
      "and judged on data that it was not fitted to.";

  function probabilityBar(c) {
    return Dom.make(
        "div", {class: "probability"},
        Dom.make("meter", {min: 0, max: 1, value: c.probability || 0, "aria-label": "probability"}),
        Dom.value(
            null, c.probability, Numbers.probability(c.probability),
            {"data-figure": "probability"}));
  }

  function errors(c, d) {
    const row = (name, from, to, figure) => Table.row(
        {}, Table.head(name), Table.number(from, Numbers.percent(from)), Table.text("→"),
        Table.number(to, Numbers.percent(to), {"data-figure": figure}));
    return Table.make({class: "errors"}, null, [
      row("torque error", d.error_before, c.error_after, "error-after"),
      row("on unseen data", d.validation_error_before, c.validation_error_after, "unseen-after")
    ]);
  }

  function parameters(c) {
    const all = Object.entries(c.parameters || {});
    return all.length ?
        Table.make(
            {class: "found"}, null,
            all.map(
                ([name, p]) => Table.row(
                    {"data-parameter": name}, Table.head(Dom.name(name)),
                    Table.number(p.value, Numbers.withStd(p.value, p.std), {"data-std": p.std}),
                    Table.unit(p.unit)))) :
        null;
  }

  // What the model leaves, and what this effect would take of it: alike where the effect is right.
  function signaturePlot(s) {
    if (!s) return null;
    return Axes.chart(
        {class: "signature", "data-name": `signature of ${s.effect}`}, 190,
        {name: s.against, unit: s.against_unit, values: s.x}, {name: s.value, unit: s.value_unit}, [
          {name: "left by the model", values: s.residual, style: "residual"},
          {name: "taken by " + s.effect, values: s.effect_torque, style: "refined"}
        ]);
  }

  function addButton(c, add) {
    const go = () => add(c.effect);
    return Dom.make(
        "button", {type: "button", id: "add-" + c.effect, "data-add": c.effect, click: go},
        "Add " + c.effect);
  }

  function card(c, story, add) {
    const view = (story.candidates || []).find(s => s.effect === c.effect);
    const facts = [
      Dom.make("h3", {}, Dom.name(c.effect)), probabilityBar(c), errors(c, story.diagnose),
      parameters(c), Dom.make("p", {class: "hint"}, c.signature),
      c.note && Dom.make("p", {class: "note"}, c.note), add && addButton(c, add)
    ];
    return Dom.make(
        "article", {class: "candidate", "data-effect": c.effect, "data-probability": c.probability},
        Dom.make("div", {class: "facts"}, facts),
        Dom.make("div", {class: "proof"}, signaturePlot(view)));
  }

  function notFitted(all) {
    if (!all.length) return null;
    const row = c =>
        Table.row({"data-effect": c.effect}, Table.head(Dom.name(c.effect)), Table.text(c.note));
    return Dom.fold(
        "not-fitted", `${all.length} not fitted, and why`, Table.make({}, null, all.map(row)));
  }

  function probes(d) {
    const all = (d.probes || []).filter(p => Numbers.known(p.explained) && p.explained > 0);
    if (!all.length) return null;
    const row = p => Table.row(
        {}, Table.head(p.variable), Table.number(p.explained, Numbers.percent(p.explained)));
    return Dom.fold(
        "probes", "What the residual depends on, in the catalogue or not",
        Table.make({}, ["function of", ["explains of the residual"]], all.map(row)));
  }

  function lessLikely(cards) {
    if (!cards.length) return null;
    const title = `${cards.length} more that were fitted and are less likely`;
    return Dom.fold("less-likely", title, Dom.make("div", {class: "cards"}, cards));
  }

  function outside(law) {
    if (!law) return null;
    return Dom.make(
        "p", {id: "outside"},
        "A law outside the catalogue explains as much: ", Dom.make("code", {}, law));
  }

  // `add`: what the studio does with a candidate's button; a report has none.
  function section(story, add) {
    const d = story.diagnose;
    if (!d || !d.candidates.length) return null;
    const fitted = d.candidates.filter(c => Numbers.known(c.error_after));
    const shown = fitted.filter((c, k) => k < atLeast || c.probability >= likely);
    const rest = fitted.filter(c => !shown.includes(c));
    const cards = list => list.map(c => card(c, story, add));
    return Dom.section(
        "candidates", "Which effect", lede, outside(d.outside),
        Dom.make("div", {class: "cards"}, cards(shown)), lessLikely(cards(rest)),
        notFitted(d.candidates.filter(c => !fitted.includes(c))), probes(d));
  }

  return {section};
})();
