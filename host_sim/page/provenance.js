// Where all this comes from: files, program, commands, models.
"use strict";

const Provenance = (() => {
  function files(all) {
    return Table.wide(
        {id: "files"}, ["file", ["size"], "sha256"],
        all.map(
            f => Table.row(
                {"data-file": f.file}, Table.head(f.file),
                Table.number(f.bytes, Numbers.bytes(f.bytes)),
                Table.text(Dom.make("code", {class: "hash"}, f.sha256)))));
  }

  function captures(all) {
    const heads =
        ["capture", ["rows"], ["duration, s"], ["sample time, s"], ["band, Hz"], "columns"];
    const figure = (v, digits) => Table.number(v, Numbers.significant(v, digits));
    return Table.wide(
        {id: "capture-table"}, heads,
        all.map(
            c => Table.row(
                {"data-file": c.file}, Table.head(c.file), figure(c.rows, 9), figure(c.duration_s),
                figure(c.sample_time_s), figure(c.band_Hz, 3),
                Table.text((c.columns || []).join(", ")))));
  }

  function model(id, title, toml) {
    return toml ? Dom.fold(id + "-fold", title, Dom.block(id, toml)) : null;
  }

  function section(story) {
    const p = story.provenance;
    if (!p) return null;
    const commands = (p.commands || []).map((c, k) => Dom.block("command-" + (k + 1), c));
    return Dom.section(
        "provenance", "Provenance", `${p.program} ${p.version}, ${p.date}`, files(p.files || []),
        captures(story.captures || []),
        commands.length ? [Dom.make("h3", {}, "To repeat it"), commands] : null,
        model("model-toml", "The model", story.model_toml),
        model("refined-toml", "The refined model", story.refined_toml));
  }

  return {section};
})();
