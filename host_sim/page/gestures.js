// Drag zooms, shift-drag or two fingers pan (and pinch), ctrl-wheel zooms, double click resets;
// with the keyboard: arrows, + and -, Home.
"use strict";

const Gestures = (() => {
  const least = 4;  // pixels: less is a click

  function instant(strip, event) {
    const box = strip.canvas.getBoundingClientRect();
    return strip.graph.toDataXCoord(event.clientX - box.left);
  }

  function mark(strip, from, to) {
    const [a, b] = [from, to].map(t => strip.graph.toDomXCoord(t)).sort((p, q) => p - q);
    strip.selection.hidden = false;
    strip.selection.style.left = a + "px";
    strip.selection.style.width = b - a + "px";
    return b - a;
  }

  function middleAndSpread(pointers) {
    const xs = [...pointers.values()].map(p => p.clientX);
    return [(xs[0] + xs[1]) / 2, Math.max(20, Math.abs(xs[0] - xs[1]))];
  }

  // Two fingers: what was under them stays under them.
  function pinch(strip, view, before, after) {
    const left = strip.canvas.getBoundingClientRect().left;
    const perPixel = (view.to - view.from) / strip.graph.getArea().w;
    const zoom = before[1] / after[1];
    const anchor = strip.graph.toDataXCoord(before[0] - left);
    const moved = (before[0] - after[0]) * perPixel;
    view.set(
        anchor + (view.from - anchor) * zoom + moved, anchor + (view.to - anchor) * zoom + moved);
  }

  function drag(strip, view, start, event) {
    if (!start.pan) {
      start.wide = mark(strip, start.t, instant(strip, event)) >= least;
      return;
    }
    const perPixel = (start.to - start.from) / strip.graph.getArea().w;
    const moved = (start.x - event.clientX) * perPixel;
    view.set(start.from + moved, start.to + moved);
  }

  function finish(strip, view, start, event) {
    strip.selection.hidden = true;
    if (start.pan || !start.wide) return;
    const ends = [start.t, instant(strip, event)].sort((a, b) => a - b);
    view.set(ends[0], ends[1]);
  }

  function attachPointer(strip, view) {
    const pointers = new Map();
    let start = null;
    strip.body.addEventListener("pointerdown", event => {
      if (event.button !== 0) return;
      pointers.set(event.pointerId, event);
      strip.body.setPointerCapture(event.pointerId);
      strip.selection.hidden = true;
      start = pointers.size > 1 ? null : {
        t: instant(strip, event),
        x: event.clientX,
        from: view.from,
        to: view.to,
        pan: event.shiftKey,
        wide: false
      };
    });
    strip.body.addEventListener("pointermove", event => {
      view.point(instant(strip, event));
      if (!pointers.has(event.pointerId)) return;
      const before = pointers.size === 2 ? middleAndSpread(pointers) : null;
      pointers.set(event.pointerId, event);
      if (before)
        pinch(strip, view, before, middleAndSpread(pointers));
      else if (start)
        drag(strip, view, start, event);
    });
    const release = event => {
      pointers.delete(event.pointerId);
      if (start && event.type === "pointerup") finish(strip, view, start, event);
      strip.selection.hidden = true;
      start = null;
    };
    strip.body.addEventListener("pointerup", release);
    strip.body.addEventListener("pointercancel", release);
    strip.body.addEventListener("pointerleave", () => view.point(null));
    strip.body.addEventListener("dblclick", () => view.reset());
  }

  function attachWheel(strip, view) {
    strip.body.addEventListener("wheel", event => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      view.zoom(Math.exp(event.deltaY / 300), instant(strip, event));
    }, {passive: false});
  }

  function attachKeys(box, view) {
    const keys = {
      ArrowLeft: () => view.move(-0.2),
      ArrowRight: () => view.move(0.2),
      "+": () => view.zoom(0.5),
      "=": () => view.zoom(0.5),
      "-": () => view.zoom(2),
      Home: () => view.reset()
    };
    box.addEventListener("keydown", event => {
      if (event.target !== box || event.ctrlKey || event.altKey || event.metaKey ||
          !keys[event.key])
        return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  function attach(strip, view) {
    attachPointer(strip, view);
    attachWheel(strip, view);
  }

  return {attach, attachKeys};
})();
