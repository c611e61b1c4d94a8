// What the studio can be asked to do, and what it is doing.
"use strict";

const Actions = (() => {
  function button(id, text, enabled, act, style) {
    return Dom.make(
        "button", {type: "button", id, class: style, disabled: !enabled, click: act}, text);
  }

  function buttons(state, act) {
    const free = !state.busy;
    return [
      Dom.make(
          "div", {class: "row"}, button("do-fit", "Fit", free, () => act("fit")),
          button("do-diagnose", "Diagnose", free, () => act("diagnose"), "main"),
          button("do-refine", "Refine", free, () => act("refine")),
          button("do-stop", "Stop", !free, () => act("stop"))),
      Dom.make(
          "div", {class: "row"},
          button(
              "do-undo", state.undo ? `Undo: ${state.undo}` : "Undo", state.undo, () => act("undo"),
              "wide"),
          button(
              "do-redo", state.redo ? `Redo: ${state.redo}` : "Redo", state.redo, () => act("redo"),
              "wide"))
    ];
  }

  function progress(busy) {
    if (!busy) return null;
    const left = Numbers.known(busy.left_s) ? `about ${Math.ceil(busy.left_s)} s left` : "";
    return [
      Dom.make(
          "label",
          { for: "busy-bar"
          },
          busy.detail ? `${busy.what}: ${busy.detail}` : busy.what),
      Dom.make(
          "progress",
          {id: "busy-bar", max: 1, value: Numbers.known(busy.share) ? busy.share : null}),
      Dom.make(
          "span", {id: "busy-left", class: "hint number"},
          [`${Math.floor(busy.elapsed_s || 0)} s`, left].filter(Boolean).join(", "))
    ];
  }

  function downloads() {
    return Dom.make(
        "div", {class: "row"},
        Dom.make(
            "a",
            {id: "save-model", class: "button", href: "api/model.toml", download: "model.toml"},
            "Save model"),
        Dom.make(
            "a",
            {id: "save-report", class: "button", href: "api/report.html", download: "report.html"},
            "Save report"));
  }

  // Undo by keyboard, but not from under someone who is typing.
  function keys(act, latest) {
    document.addEventListener("keydown", event => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
      if (event.target.closest("input:not([type=checkbox]), textarea, select")) return;
      event.preventDefault();
      const wanted = event.shiftKey ? "redo" : "undo";
      if (latest() && latest()[wanted]) act(wanted);
    });
  }

  function next(experiment, free, act) {
    if (!experiment) return null;
    return [
      Dom.make("h3", {}, "Next experiment"), Dom.make("p", {class: "hint"}, experiment.reason),
      Dom.make("code", {}, experiment.experiment),
      experiment.preview && Dom.make("p", {id: "next-preview", class: "hint"}, experiment.preview),
      Dom.make(
          "div", {class: "row"},
          button("simulate-next", "Simulate it", free, () => act("experiment")))
    ];
  }

  function history(steps, floor) {
    if (!steps || steps.length < 2) return null;
    return [
      Dom.make("h3", {}, "Steps so far"),
      Ladder.draw(steps.map(s => ({name: s.what, error: s.torque_error})), floor)
    ];
  }

  return {buttons, progress, downloads, keys, next, history};
})();
