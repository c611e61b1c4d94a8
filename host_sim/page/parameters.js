// The numbers of the model, before and after, and how they depend on each other.
"use strict";

const Parameters = (() => {
  function rowsOf(p) {
    if (!p) return [];
    const at = (list, k) => list ? list[k] : null;
    return p.name.map((name, k) => ({
                        name,
                        unit: at(p.unit, k),
                        value: at(p.value, k),
                        std: at(p.std, k),
                        believed: at(p.believed, k),
                        fixed: at(p.fixed, k),
                        bound: at(p.at_bound, k),
                        lower: at(p.lower, k),
                        upper: at(p.upper, k)
                      }));
  }

  function bounds(r) {
    const low = Numbers.known(r.lower), high = Numbers.known(r.upper);
    if (!low && !high) return "";
    const positive = low && r.lower > 0 && r.lower < 1e-6;  // only that it must not be 0
    if (positive && !high) return "> 0";
    const least = positive ? "> 0" : low ? Numbers.significant(r.lower) : "−∞";
    return `${least} … ${high ? Numbers.significant(r.upper) : "∞"}`;
  }

  function flags(r) {
    const all = [r.fixed && "fixed", r.bound && "at bound"].filter(Boolean);
    return all.map(f => Dom.make("span", {class: "flag", "data-flag": f}, f));
  }

  function cell(when, r) {
    return r ?
        Table.number(
            r.value, Numbers.withStd(r.value, r.std), {"data-when": when, "data-std": r.std}) :
        Table.number(null, "", {"data-when": when});
  }

  function table(before, after) {
    const names = [...new Set(before.concat(after).map(r => r.name))];
    const of = (rows, name) => rows.find(r => r.name === name);
    const heads = [
      "parameter", ["before"], after.length > 0 && ["after"], "unit", ["believed"], ["bounds"],
      "\u00a0"
    ];
    return Table.wide({id: "parameter-table"}, heads, names.map(name => {
      const old = of(before, name), found = of(after, name), last = found || old;
      return Table.row(
          {"data-parameter": name}, Table.head(Dom.name(name)), cell("before", old),
          after.length > 0 && cell("after", found), Table.unit(last.unit),
          Table.number(last.believed, Numbers.significant(last.believed)),
          Table.number(null, bounds(last)), Table.text(flags(last)));
    }));
  }

  // Where the fit knows no correlation there is still a cell to walk through.
  function heat(names, matrix, i, j, say) {
    const c = matrix[i][j], known = Numbers.known(c);
    const text = `${names[i]} and ${names[j]}: ${known ? c.toFixed(3) : "not known"}`;
    const tell = () => say(text);
    const td = Table.number(c, known ? (Math.abs(c) < 0.005 ? 0 : c).toFixed(2) : Numbers.none, {
      tabindex: i + j === 0 ? "0" : "-1",
      "data-row": i,
      "data-column": j,
      title: text,
      focus: tell,
      pointerenter: tell
    });
    td.style.setProperty("--strength", Math.round(50 * Math.abs(c || 0)) + "%");
    td.classList.add("heat", c < 0 ? "negative" : "positive");
    return td;
  }

  // One stop for the tab key; arrows go through the cells.
  function walk(event) {
    const step = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [
                    1, 0
                  ]}[event.key];
    const from = event.target.dataset;
    if (!step || from.row === undefined) return;
    const next = event.currentTarget.querySelector(
        `[data-row="${+ from.row + step[0]}"][data-column="${+ from.column + step[1]}"]`);
    if (!next) return;
    event.preventDefault();
    event.target.tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
  }

  function heatTable(names, matrix, say) {
    const heads =
        names.map((n, k) => Dom.make("th", {scope: "col", title: n, "aria-label": n}, k + 1));
    const row = (n, i) => Table.row(
        {}, Table.head(Dom.name(n)), Dom.make("td", {class: "index"}, i + 1),
        names.map((m, j) => heat(names, matrix, i, j, say)));
    return Dom.make(
        "div", {class: "scroll"},
        Dom.make(
            "table", {class: "heat-table", keydown: walk},
            Dom.make("thead", {}, Table.row({}, Table.text(), Table.text(), heads)),
            Dom.make("tbody", {}, names.map(row))));
  }

  // Of those whose correlations are known: numbers that were searched for have none.
  function correlation(p) {
    if (!p.correlation) return null;
    const there = p.correlation.map((row, k) => k).filter(k => Numbers.known(p.correlation[k][k]));
    if (there.length < 2) return null;
    const matrix = there.map(i => there.map(j => p.correlation[i][j]));
    const reading =
        Dom.make("output", {id: "correlation-reading"}, "Point at a cell to read it in full.");
    const say = text => {
      reading.textContent = text;
    };
    return Dom.make(
        "figure", {id: "correlation"}, Dom.make("h3", {}, "Correlation"),
        Dom.make(
            "p", {class: "hint"}, "Near ±1: the captures cannot tell these two apart. ", reading),
        heatTable(there.map(k => p.name[k]), matrix, say));
  }

  function section(story) {
    const p = story.parameters;
    if (!p || !p.before) return null;
    return Dom.section(
        "parameters", "Parameters",
        "Value ± one standard deviation. Believed: what the model file says.",
        table(rowsOf(p.before), rowsOf(p.after)), correlation(p.after || p.before));
  }

  return {section};
})();
