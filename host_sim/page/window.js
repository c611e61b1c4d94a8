// The window on time: what part of a capture is shown, and the buttons that move it.
"use strict";

const TimeWindow = (() => {
  // By capture; outlives the section, which the studio builds anew with every story.
  const kept = new Map();

  function whole(capture) {
    const all = Object.values(capture.series).filter(Boolean);
    const from = Math.min(...all.map(s => s.start_s));
    const to = Math.max(...all.map(s => s.start_s + s.step_s * (s.count - 1)));
    return {
      from,
      to: to > from ? to : from + 1,
      step: Math.min(...all.map(s => s.step_s / s.bucket))
    };
  }

  // As wide as asked where there is that much, and never narrower than a few samples.
  function within(full, {from, to}) {
    const span = Math.min(full.to - full.from, Math.max(4 * full.step, to - from));
    const first = Math.min(full.to - span, Math.max(full.from, (from + to) / 2 - span / 2));
    return {from: first, to: first + span};
  }

  // The window on the time of one capture; whoever moves it moves all strips.
  function make(capture, strips, tell) {
    const full = whole(capture);
    const view = {
      ...within(full, kept.get(capture.file) || full),
      bands: capture.worst || [],
      full
    };
    view.set = (from, to) => {
      Object.assign(view, within(full, {from, to}));
      kept.set(capture.file, {from: view.from, to: view.to});
      strips.forEach(s => Strips.show(s, view));
      tell(view);
    };
    view.zoom = (factor, anchor = (view.from + view.to) / 2) =>
        view.set(anchor + (view.from - anchor) * factor, anchor + (view.to - anchor) * factor);
    view.move = share => {
      const by = share * (view.to - view.from);
      view.set(view.from + by, view.to + by);
    };
    view.reset = () => view.set(full.from, full.to);
    view.point = t => {
      strips.forEach(s => Strips.point(s, t));
      tell(view, t);
    };
    return view;
  }

  function buttons(view) {
    const button = (id, text, label, act) => Dom.make(
        "button", {id, type: "button", "aria-label": label, title: label, click: act}, text);
    return Dom.make(
        "div", {class: "buttons", role: "group", "aria-label": "time window"},
        button("zoom-in", "+", "zoom in", () => view.zoom(0.5)),
        button("zoom-out", "−", "zoom out", () => view.zoom(2)),
        button("pan-left", "←", "earlier", () => view.move(-0.25)),
        button("pan-right", "→", "later", () => view.move(0.25)),
        button("zoom-reset", "All", "all of the capture", () => view.reset()));
  }

  // What the window shows, as text.
  function reading() {
    const span = Dom.make("span", {id: "time-window", class: "number"});
    const tell = (view, t = null) => {
      const wide = view.to - view.from;
      const cursor = t === null ? "" : `, cursor ${Numbers.seconds(t, wide / 100)} s`;
      span.textContent =
          `${Numbers.seconds(view.from, wide)} … ${Numbers.seconds(view.to, wide)} s${cursor}`;
      span.dataset.from = view.from;
      span.dataset.to = view.to;
    };
    return {span, tell};
  }

  return {make, buttons, reading};
})();
