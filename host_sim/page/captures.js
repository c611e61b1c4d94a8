// The studio's captures: which are fitted, and the way in for more.
"use strict";

const Captures = (() => {
  function row(c, act) {
    const box = Dom.make("input", {type: "checkbox", id: "capture-on-" + c.index, checked: c.on});
    box.addEventListener("change", () => act("capture", {file: c.file, on: box.checked}));
    return Dom.make(
        "li", {"data-file": c.file},
        Dom.make("label", {}, box, " ", Dom.make("span", {class: "name"}, c.file)),
        Dom.make(
            "span", {class: "hint number"},
            `${c.rows} rows, ${Numbers.significant(c.duration_s, 3)} s`));
  }

  // Dropped or chosen, one after the other: each is judged by itself.
  function dropZone(send) {
    const input = Dom.make("input", {
      type: "file",
      id: "capture-file",
      multiple: true,
      class: "off-screen",
      tabindex: "-1",
      "aria-label": "capture files"
    });
    const take = async files => {
      for (const file of files) await send(file);
      input.value = "";
    };
    input.addEventListener("change", () => take([...input.files]));
    const zone = Dom.make(
        "div", {id: "drop", class: "drop"}, input,
        Dom.make(
            "button", {type: "button", id: "capture-choose", click: () => input.click()},
            "Add captures…"),
        " or drop them here");
    zone.addEventListener("dragover", () => zone.classList.add("over"));
    zone.addEventListener("dragleave", () => zone.classList.remove("over"));
    zone.addEventListener("drop", event => {
      zone.classList.remove("over");
      take([...event.dataTransfer.files]);
    });
    return zone;
  }

  function show(box, captures, act) {
    Dom.list(box, captures.map((c, index) => ({...c, index})), c => row(c, act));
  }

  return {show, dropZone};
})();
