// The numbers of the model, before and after, and how they depend on each other.
"use strict";

const Parameters = (() => {
  function rowsOf(p) {
    if (!p) return [];
    const at = (list, k) => list ? list[k] : null;
    return p.name.map((name, k) => ({ name, unit: at(p.unit, k), value: at(p.value, k), std: at(p.std, k),
      believed: at(p.believed, k), fixed: at(p.fixed, k), bound: at(p.at_bound, k), lower: at(p.lower, k), upper: at(p.upper, k) }));
  }

  function bounds(r) {
    const low = Numbers.known(r.lower), high = Numbers.known(r.upper);
    if (!low && !high) return "";
    return `${low ? Numbers.significant(r.lower) : "−∞"} … ${high ? Numbers.significant(r.upper) : "∞"}`;
  }

  function flags(r) {
    const all = [r.fixed && "fixed", r.bound && "at bound"].filter(Boolean);
    return all.map(f => Dom.make("span", { class: "flag", "data-flag": f }, f));
  }

  function cell(when, r) {
    return Dom.make("td", { class: "number", "data-when": when, "data-value": r && r.value, "data-std": r && r.std },
      r ? Numbers.withStd(r.value, r.std) : "");
  }

  function table(before, after) {
    const names = [...new Set(before.concat(after).map(r => r.name))];
    const of = (rows, name) => rows.find(r => r.name === name);
    const heads = [["parameter"], ["before", 1], after.length && ["after", 1], ["unit"], ["believed", 1], ["bounds", 1], [""]].filter(Boolean);
    return Dom.make("div", { class: "scroll" }, Dom.make("table", { id: "parameter-table" },
      Dom.make("thead", {}, Dom.make("tr", {}, heads.map(([h, number]) => Dom.make("th", { scope: "col", class: number ? "number" : "" }, h)))),
      Dom.make("tbody", {}, names.map(name => {
        const old = of(before, name), found = of(after, name), last = found || old;
        return Dom.make("tr", { "data-parameter": name }, Dom.make("th", { scope: "row" }, Dom.name(name)), cell("before", old),
          after.length ? cell("after", found) : null, Dom.make("td", { class: "unit" }, Numbers.unit(last.unit)),
          Dom.make("td", { class: "number", "data-value": last.believed }, Numbers.significant(last.believed)),
          Dom.make("td", { class: "number" }, bounds(last)), Dom.make("td", {}, flags(last)));
      }))));
  }

  function heat(names, matrix, i, j, say) {
    const c = matrix[i][j];
    if (!Numbers.known(c)) return Dom.make("td", {}, Numbers.none);
    const text = `${names[i]} and ${names[j]}: ${c.toFixed(3)}`;
    const td = Dom.make("td", { class: "heat number", tabindex: i === 0 && j === 0 ? "0" : "-1", "data-row": i, "data-column": j, "data-value": c,
      title: text, focus: () => say(text), pointerenter: () => say(text) }, c.toFixed(2));
    td.style.setProperty("--strength", Math.round(50 * Math.abs(c)) + "%");
    td.classList.add(c < 0 ? "negative" : "positive");
    return td;
  }

  // One stop for the tab key; arrows go through the cells.
  function walk(event) {
    const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[event.key];
    const from = event.target.dataset;
    if (!step || from.row === undefined) return;
    const next = event.currentTarget.querySelector(`[data-row="${+from.row + step[0]}"][data-column="${+from.column + step[1]}"]`);
    if (!next) return;
    event.preventDefault();
    event.target.tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
  }

  function correlation(p) {
    const matrix = p && p.correlation;
    if (!matrix || matrix.length < 2) return null;
    const reading = Dom.make("output", { id: "correlation-reading" }, "Point at a cell to read it in full.");
    const say = text => { reading.textContent = text; };
    return Dom.make("figure", { id: "correlation" }, Dom.make("h3", {}, "Correlation"),
      Dom.make("p", { class: "hint" }, "Near ±1: the captures cannot tell these two apart. ", reading),
      Dom.make("div", { class: "scroll" }, Dom.make("table", { class: "heat-table", keydown: walk },
        Dom.make("thead", {}, Dom.make("tr", {}, Dom.make("td"), Dom.make("td"), p.name.map((n, k) => Dom.make("th", { scope: "col", title: n, "aria-label": n }, k + 1)))),
        Dom.make("tbody", {}, p.name.map((n, i) => Dom.make("tr", {}, Dom.make("th", { scope: "row" }, Dom.name(n)), Dom.make("td", { class: "index" }, i + 1),
          p.name.map((m, j) => heat(p.name, matrix, i, j, say))))))));
  }

  function section(story) {
    const p = story.parameters;
    if (!p || !p.before) return null;
    return Dom.section("parameters", "Parameters", "Value ± one standard deviation. Believed: what the model file says.",
      table(rowsOf(p.before), rowsOf(p.after)), correlation(p.after || p.before));
  }

  return { section };
})();
