// The worst stretches of a capture, as buttons that zoom there.
"use strict";

const Worst = (() => {
  function button(w, k, view) {
    const margin = Math.max(0.5 * (w.to_s - w.from_s), 20 * view.full.step);
    const instant = t => Numbers.seconds(t, w.to_s - w.from_s);
    const [residual, samples] = [w.residual_share, w.sample_share].map(Numbers.percent);
    return Dom.make(
        "button", {
          type: "button",
          id: "worst-" + (k + 1),
          "data-from": w.from_s,
          "data-to": w.to_s,
          click: () => view.set(w.from_s - margin, w.to_s + margin)
        },
        Dom.make("b", {}, w.what),
        Dom.make("span", {}, `${instant(w.from_s)} … ${instant(w.to_s)} s`),
        Dom.make("span", {}, `${residual} of the residual on ${samples} of the samples`));
  }

  // adequate: what is left is noise.
  function list(view, adequate) {
    if (!view.bands.length) return null;
    return Dom.make(
        "div", {class: "worst"}, Dom.make("h3", {}, "Where the residual is densest"),
        adequate && Dom.make("p", {class: "hint"}, "What is left is noise: by chance, then."),
        Dom.make("ol", {}, view.bands.map((w, k) => Dom.make("li", {}, button(w, k, view)))));
  }

  return {list};
})();
