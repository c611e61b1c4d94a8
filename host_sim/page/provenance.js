// Where all this comes from: files, program, commands, models.
"use strict";

const Provenance = (() => {
  function files(all) {
    return Dom.make("div", { class: "scroll" }, Dom.make("table", { id: "files" },
      Dom.make("thead", {}, Dom.make("tr", {}, ["file", "size", "sha256"].map(h => Dom.make("th", { scope: "col" }, h)))),
      Dom.make("tbody", {}, all.map(f => Dom.make("tr", { "data-file": f.file }, Dom.make("th", { scope: "row" }, f.file),
        Dom.make("td", { class: "number" }, Numbers.bytes(f.bytes)), Dom.make("td", {}, Dom.make("code", { class: "hash" }, f.sha256)))))));
  }

  function captures(all) {
    return Dom.make("div", { class: "scroll" }, Dom.make("table", { id: "capture-table" },
      Dom.make("thead", {}, Dom.make("tr", {}, [["capture"], ["rows", 1], ["duration, s", 1], ["sample time, s", 1], ["band, Hz", 1], ["columns"]].map(([h, number]) =>
        Dom.make("th", { scope: "col", class: number ? "number" : "" }, h)))),
      Dom.make("tbody", {}, all.map(c => Dom.make("tr", { "data-file": c.file }, Dom.make("th", { scope: "row" }, c.file),
        [c.rows, Numbers.significant(c.duration_s), Numbers.significant(c.sample_time_s), Numbers.significant(c.band_Hz, 3)].map(v => Dom.make("td", { class: "number" }, v)),
        Dom.make("td", {}, (c.columns || []).join(", ")))))));
  }

  function model(id, title, toml) {
    return toml ? Dom.fold(id + "-fold", title, Dom.block(id, toml)) : null;
  }

  function section(story) {
    const p = story.provenance;
    if (!p) return null;
    const commands = (p.commands || []).map((c, k) => Dom.block("command-" + (k + 1), c));
    return Dom.section("provenance", "Provenance", `${p.program} ${p.version}, ${p.date}`,
      files(p.files || []), captures(story.captures || []),
      commands.length ? [Dom.make("h3", {}, "To repeat it"), commands] : null,
      model("model-toml", "The model", story.model_toml), model("refined-toml", "The refined model", story.refined_toml));
  }

  return { section };
})();
