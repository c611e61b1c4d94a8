// Which effect: what was tried, best first, and why.
"use strict";

const Candidates = (() => {
  const atLeast = 4, likely = 0.001;

  function probabilityBar(c) {
    return Dom.make("div", { class: "probability" },
      Dom.make("meter", { min: 0, max: 1, value: c.probability || 0, "aria-label": "probability" }),
      Dom.value(null, c.probability, Numbers.probability(c.probability), { "data-figure": "probability" }));
  }

  function errors(c, before, unseenBefore) {
    const row = (name, from, to, figure) => Dom.make("tr", {}, Dom.make("th", { scope: "row" }, name),
      Dom.make("td", { class: "number" }, Numbers.percent(from)), Dom.make("td", { class: "arrow" }, "→"),
      Dom.make("td", { class: "number", "data-figure": figure, "data-value": to }, Numbers.percent(to)));
    return Dom.make("table", { class: "errors" }, Dom.make("tbody", {},
      row("torque error", before, c.error_after, "error-after"),
      row("on unseen data", unseenBefore, c.validation_error_after, "unseen-after")));
  }

  function parameters(c) {
    const all = Object.entries(c.parameters || {});
    if (!all.length) return null;
    return Dom.make("table", { class: "found" }, Dom.make("tbody", {}, all.map(([name, p]) =>
      Dom.make("tr", { "data-parameter": name }, Dom.make("th", { scope: "row" }, Dom.name(name)),
        Dom.make("td", { class: "number", "data-value": p.value, "data-std": p.std }, Numbers.withStd(p.value, p.std)),
        Dom.make("td", { class: "unit" }, Numbers.unit(p.unit))))));
  }

  // What the model leaves, and what this effect would take of it: alike where the effect is right.
  function signaturePlot(s, unit) {
    if (!s) return null;
    return Axes.chart({ class: "signature", "data-name": `signature of ${s.effect}` }, 190,
      { name: s.against, unit: s.against_unit, values: s.x }, { name: "torque", unit: unit.torque }, [
        { name: "left by the model", values: s.residual, style: "residual" },
        { name: "taken by " + s.effect, values: s.effect_torque, style: "refined" }]);
  }

  function card(c, context) {
    const { story, add } = context;
    const d = story.diagnose;
    return Dom.make("article", { class: "candidate", "data-effect": c.effect, "data-probability": c.probability },
      Dom.make("div", { class: "facts" },
        Dom.make("h3", {}, Dom.name(c.effect)), probabilityBar(c), errors(c, d.error_before, d.validation_error_before), parameters(c),
        Dom.make("p", { class: "hint" }, c.signature), c.note && Dom.make("p", { class: "note" }, c.note),
        add && Dom.make("button", { type: "button", id: "add-" + c.effect, "data-add": c.effect, click: () => add(c.effect) }, "Add " + c.effect)),
      Dom.make("div", { class: "proof" }, signaturePlot((story.candidates || []).find(s => s.effect === c.effect), story.unit)));
  }

  function notFitted(all) {
    if (!all.length) return null;
    return Dom.fold("not-fitted", `${all.length} not fitted, and why`, Dom.make("table", {}, Dom.make("tbody", {}, all.map(c =>
      Dom.make("tr", { "data-effect": c.effect }, Dom.make("th", { scope: "row" }, c.effect), Dom.make("td", {}, c.note || ""))))));
  }

  function probes(d) {
    const all = (d.probes || []).filter(p => Numbers.known(p.explained) && p.explained > 0);
    if (!all.length) return null;
    return Dom.fold("probes", "What the residual depends on, in the catalogue or not", Dom.make("table", {}, Dom.make("thead", {}, Dom.make("tr", {},
      Dom.make("th", { scope: "col" }, "function of"), Dom.make("th", { scope: "col", class: "number" }, "explains of the residual"))),
    Dom.make("tbody", {}, all.map(p => Dom.make("tr", {}, Dom.make("th", { scope: "row" }, p.variable),
      Dom.make("td", { class: "number", "data-value": p.explained }, Numbers.percent(p.explained)))))));
  }

  // `add`: what the studio does with a candidate's button; a report has none.
  function section(story, add) {
    const d = story.diagnose;
    if (!d || !d.candidates.length) return null;
    const context = { story, add };
    const fitted = d.candidates.filter(c => Numbers.known(c.error_after));
    const shown = fitted.filter((c, k) => k < atLeast || c.probability >= likely);
    const rest = fitted.filter(c => !shown.includes(c));
    return Dom.section("candidates", "Which effect", "Every effect of the catalogue was fitted together with all numbers of the model, and judged on data that it was not fitted to.",
      d.outside ? Dom.make("p", { id: "outside" }, "A law outside the catalogue explains as much: ", Dom.make("code", {}, d.outside)) : null,
      Dom.make("div", { class: "cards" }, shown.map(c => card(c, context))),
      rest.length ? Dom.fold("less-likely", `${rest.length} more that were fitted and are less likely`, Dom.make("div", { class: "cards" }, rest.map(c => card(c, context)))) : null,
      notFitted(d.candidates.filter(c => !Numbers.known(c.error_after))), probes(d));
  }

  return { section };
})();
