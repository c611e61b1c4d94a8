// Where it fails: the residual against what moves the axis, and the shares of the regimes.
"use strict";

const Where = (() => {
  const howToRead = "Bar: share of the residual's power. Mark: share of the samples. " +
      "A bar beyond its mark is a place where the model fails.";

  function meanBars(f, bins) {
    const parts = [];
    for (const b of bins) {
      if (!Numbers.known(b.mean)) continue;
      const left = f.X(b.from), right = f.X(b.to), spread = Numbers.known(b.std) ? b.std : 0;
      parts.push(
          Dom.svg("rect", {
            class: "spread",
            x: left,
            width: Math.max(1, right - left),
            y: f.Y(b.mean + spread),
            height: Math.max(0, f.Y(b.mean - spread) - f.Y(b.mean + spread))
          }),
          Dom.svg("line", {class: "mean", x1: left, x2: right, y1: f.Y(b.mean), y2: f.Y(b.mean)}));
    }
    return parts;
  }

  function scatter(against, unit, range) {
    const x = {
      name: against.variable,
      unit: against.unit,
      range: Axes.extent([against.x, against.bins.flatMap(b => [b.from, b.to])], {pad: 0.02})
    };
    const y = {name: "residual", unit: unit.torque, range};
    return Dom.make("figure", {id: "against-" + against.variable}, Dom.drawing({}, width => {
      const f = Axes.frame(width, 210, x, y, `residual against ${against.variable}`);
      f.picture.append(
          Axes.dots(f.X, f.Y, against.x, against.y, "faint"), ...meanBars(f, against.bins));
      return f.picture;
    }));
  }

  // One scale of the residual for all: they are to be compared.
  function scatters(story) {
    const all = (story.against || []).filter(a => a.bins.length);
    if (!all.length) return null;
    const range = Axes.extent(all.flatMap(
        a =>
            [a.y,
             a.bins.flatMap(
                 b => Numbers.known(b.mean) ? [b.mean - (b.std || 0), b.mean + (b.std || 0)] :
                                              [])]));
    return [
      Dom.make("h3", {}, "Residual against the motion"),
      Dom.make(
          "p", {class: "hint"},
          "Points: samples. Lines: mean of a bin; shaded: ± one standard deviation."),
      Dom.make("div", {class: "multiples"}, all.map(a => scatter(a, story.unit, range)))
    ];
  }

  // The residual's share as a bar, the samples' as a mark on it: a bar beyond its mark is a dense
  // place.
  function shareBar(row) {
    const X = Axes.scale(0, 1, 0, 100);
    return Dom.svg(
        "svg",
        {class: "share", viewBox: "0 0 100 12", preserveAspectRatio: "none", "aria-hidden": "true"},
        Dom.svg("rect", {class: "track", x: 0, y: 2, width: 100, height: 8}),
        Dom.svg("rect", {class: "bar", x: 0, y: 2, width: X(row.residual_share || 0), height: 8}),
        Dom.svg("rect", {
          class: "mark",
          x: Math.min(99, X(row.sample_share || 0)),
          y: 0,
          width: 0.8,
          height: 12
        }));
  }

  function shareRow(row, group) {
    const place =
        row.regime.startsWith(group + " ") ? row.regime.slice(group.length + 1) : row.regime;
    const figure = v => Table.number(v, Numbers.percent(v));
    return Table.row(
        {"data-regime": row.regime}, Table.head(place),
        Dom.make("td", {class: "bar-cell"}, shareBar(row)), figure(row.residual_share),
        figure(row.sample_share));
  }

  function shareTable(group, rows) {
    const heads = [group, "\u00a0", ["residual"], [group === "frequency" ? "band" : "samples"]];
    return Table.make(
        {class: "shares", "data-group": group}, heads, rows.map(r => shareRow(r, group)));
  }

  // What the scatters show already is folded.
  function shares(story) {
    const rows = (story.compare && story.compare.where) || [];
    const groups = [...new Set(rows.map(r => r.group))];
    if (!groups.length) return null;
    const drawn = new Set((story.against || []).map(a => a.variable));
    const table = g => shareTable(g, rows.filter(r => r.group === g));
    const folded = groups.filter(g => drawn.has(g));
    const tables = list => Dom.make("div", {class: "share-tables"}, list.map(table));
    return [
      Dom.make("h3", {}, "Share of the residual by regime"),
      Dom.make("p", {class: "hint"}, howToRead), tables(groups.filter(g => !drawn.has(g))),
      folded.length ? Dom.fold("by-value", "By value of " + folded.join(", "), tables(folded)) :
                      null
    ];
  }

  function section(story) {
    const parts =
        [scatters(story), shares(story), Spectra.parts(story)].flat(Infinity).filter(Boolean);
    if (!parts.length) return null;
    return Dom.section(
        "where", "Where it fails", "What the residual follows tells which physics is missing.",
        [Facts.list(story)].filter(Boolean).concat(parts));
  }

  return {section};
})();
