// The drive on the CAN bus: run an experiment, watch its samples arrive.
"use strict";

const Bus = (() => {
  function samples(l, unit) {
    if (!l || !l.time_s.length) return null;
    const x = {name: "time", unit: "s", values: l.time_s};
    return [
      Axes.chart(
          {id: "can-torque", "data-name": "live torque"}, 120, x,
          {name: "torque", unit: unit.torque},
          [{name: "torque", values: l.torque, style: "measured"}]),
      Axes.chart(
          {id: "can-position", "data-name": "live position"}, 120, x,
          {name: "position", unit: unit.position},
          [{name: "position", values: l.position, style: "model"}])
    ];
  }

  function status(can) {
    return Dom.make(
        "p", {class: "hint number"}, can.running ? "running: " : "stopped: ",
        Dom.make("span", {id: "can-rows", "data-value": can.rows}, `${can.rows} rows`),
        Numbers.known(can.seconds) ? `, ${Numbers.significant(can.seconds, 3)} s` : "");
  }

  // What changes with every batch of samples. The buttons are not among it: a click must not miss
  // them.
  function live(can, unit) {
    return can ? [status(can), samples(can.live, unit)] : null;
  }

  // `typed` outlives the view.
  function view(can, proposed, free, act, typed) {
    if (!can) return null;
    if (typed.text === null && proposed) typed.text = proposed.experiment;
    const text = Dom.make("input", {
      id: "can-experiment",
      type: "text",
      value: typed.text,
      placeholder: "trapezoid:stroke=0.2,cycles=2",
      "aria-label": "experiment to run",
      autocomplete: "off",
      spellcheck: "false"
    });
    text.addEventListener("input", () => {
      typed.text = text.value;
    });
    return [
      Dom.make("h3", {}, "Drive on ", can.interface),
      Dom.make(
          "div", {class: "row"}, text,
          Dom.make(
              "button", {
                type: "button",
                id: "can-run",
                disabled: !free || can.running,
                click: () => act("run", {experiment: text.value.trim()})
              },
              "Run"),
          can.running &&
              Dom.make(
                  "button", {type: "button", id: "can-stop", click: () => act("stop")}, "Stop"))
    ];
  }

  return {view, live};
})();
