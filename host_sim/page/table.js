// Tables: names to the left, numbers to the right, exact values beside what is shown.
"use strict";

const Table = (() => {
  const head = text => Dom.make("th", {scope: "row"}, text);

  const text = (...content) => Dom.make("td", {}, ...content);

  function number(value, shown, attributes) {
    return Dom.make("td", {class: "number", "data-value": value, ...attributes}, shown);
  }

  // A unit may be anything that a file says; what does not fit is in the title.
  const unit = u => Dom.make("td", {class: "unit", title: u}, Numbers.unit(u));

  const row = (attributes, ...cells) => Dom.make("tr", attributes, ...cells);

  // Heads: texts; of a column of numbers in a list of its own: ["size"].
  function heading(heads) {
    return Dom.make(
        "thead", {},
        Dom.make(
            "tr", {},
            heads.filter(Boolean).map(
                h => Array.isArray(h) ? Dom.make("th", {scope: "col", class: "number"}, h) :
                                        Dom.make("th", {scope: "col"}, h))));
  }

  function make(attributes, heads, rows) {
    return Dom.make("table", attributes, heads && heading(heads), Dom.make("tbody", {}, rows));
  }

  // One that may be wider than the page.
  function wide(attributes, heads, rows) {
    return Dom.make("div", {class: "scroll"}, make(attributes, heads, rows));
  }

  return {head, text, number, unit, row, make, wide};
})();
