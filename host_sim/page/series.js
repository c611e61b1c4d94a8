// Tracks over time: int16 in base64, and what of them a plot of so many pixels has to show.
"use strict";

const Series = (() => {
  const noValue = -32768;

  // Little-endian, as every machine with a browser is.
  function int16(text) {
    const raw = atob(text);
    const bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
    return new Int16Array(bytes.buffer);
  }

  // A value of a bucket stands for its middle.
  function decode(s) {
    if (!s) return null;
    const low = int16(s.low), high = s.high ? int16(s.high) : low;
    const start = s.start_s + s.step_s * (s.bucket - 1) / (2 * s.bucket);
    return {
      start,
      step: s.step_s,
      count: low.length,
      low,
      high,
      offset: s.offset,
      scale: s.scale,
      end: start + s.step_s * Math.max(0, low.length - 1)
    };
  }

  function clamp(k, count) {
    return Math.min(count, Math.max(0, k));
  }

  // Least and most of every column of pixels, in counts. seen: 0 nothing, 1 only a gap, 2 values.
  function extremes(s, from, to, columns) {
    const least = new Int16Array(columns).fill(32767), most = new Int16Array(columns).fill(noValue);
    const seen = new Uint8Array(columns);
    const perSecond = columns / (to - from);
    const first = clamp(Math.ceil((from - s.start) / s.step - 1e-9), s.count);
    const last = clamp(Math.floor((to - s.start) / s.step + 1e-9) + 1, s.count);
    for (let k = first; k < last; ++k) {
      const c =
          Math.min(columns - 1, Math.max(0, Math.floor((s.start + k * s.step - from) * perSecond)));
      if (s.low[k] === noValue) {
        if (seen[c] === 0) seen[c] = 1;
        continue;
      }
      seen[c] = 2;
      if (s.low[k] < least[c]) least[c] = s.low[k];
      if (s.high[k] > most[c]) most[c] = s.high[k];
    }
    return {least, most, seen, before: first - 1, after: last};
  }

  // One value just outside the window, so that lines run on to the edge of the plot.
  function outer(tracks, found, side) {
    const rows = [];
    tracks.forEach((s, j) => {
      const k = found[j][side];
      if (k < 0 || k >= s.count || s.low[k] === noValue) return;
      const row = new Array(tracks.length + 1).fill(null);
      row[0] = s.start + k * s.step;
      row[j + 1] = s.offset + s.scale * s.low[k];
      rows.push(row);
    });
    return rows.sort((a, b) => a[0] - b[0]);
  }

  // Both extremes of a column, first the one that is nearer to what came before.
  function pair(s, e, c, previous) {
    if (e.seen[c] === 0) return [null, null];
    if (e.seen[c] === 1) return [NaN, NaN];
    const low = s.offset + s.scale * e.least[c], high = s.offset + s.scale * e.most[c];
    return Math.abs(previous - low) <= Math.abs(previous - high) ? [low, high] : [high, low];
  }

  // Rows for dygraphs: time and one value a track, two rows a column: no peak is ever lost. null:
  // no sample in this column, the line goes on; NaN: a gap.
  function rows(tracks, from, to, columns) {
    const found = tracks.map(s => extremes(s, from, to, columns));
    const out = outer(tracks, found, "before");
    const previous = new Float64Array(tracks.length);
    const width = (to - from) / columns;
    for (let c = 0; c < columns; ++c) {
      if (found.every(e => e.seen[c] === 0)) continue;
      const a = [from + (c + 0.25) * width], b = [from + (c + 0.75) * width];
      tracks.forEach((s, j) => {
        const [one, other] = pair(s, found[j], c, previous[j]);
        a.push(one);
        b.push(other);
        if (other !== null) previous[j] = other;
      });
      out.push(a, b);
    }
    return out.concat(outer(tracks, found, "after"));
  }

  // [least, most] of the sample nearest to an instant, or null.
  function at(s, t) {
    const k = Math.round((t - s.start) / s.step);
    if (k < 0 || k >= s.count || s.low[k] === noValue) return null;
    return [s.offset + s.scale * s.low[k], s.offset + s.scale * s.high[k]];
  }

  return {decode, rows, at};
})();
