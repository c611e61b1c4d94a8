// The studio's server: what it says of the session, and what it is asked to do.
"use strict";

const Server = (() => {
  const firstPause = 500, longestPause = 8000,
        patience = 30000;  // ms; a poll is answered within 20 s

  const sleep = ms => new Promise(done => setTimeout(done, ms));

  async function get(path, signal) {
    const answer = await fetch(path, {cache: "no-store", signal});
    if (!answer.ok) throw new Error(`${path}: status ${answer.status}`);
    return answer.json();
  }

  // A browser has six lines to a server: a tab that nobody sees leaves its own to the others.
  function seen() {
    if (!document.hidden) return Promise.resolve();
    return new Promise(done => document.addEventListener("visibilitychange", done, {once: true}));
  }

  // null where the tab was hidden meanwhile.
  async function news(after) {
    await seen();
    const gone = new AbortController();
    const leave = () => document.hidden && gone.abort();
    const late = setTimeout(() => gone.abort(new Error("no answer")), patience);
    document.addEventListener("visibilitychange", leave);
    try {
      return await get(`api/state?after=${after}`, gone.signal);
    } catch (fault) {
      if (document.hidden) return null;
      throw fault;
    } finally {
      clearTimeout(late);
      document.removeEventListener("visibilitychange", leave);
    }
  }

  // Told at every change, for as long as the page is open. A server that was started anew counts
  // anew.
  async function follow({changed, lost, back}) {
    let after = -1, pause = firstPause, away = false;
    for (;;) {
      try {
        const state = await news(after);
        if (!state) continue;
        if (away) back();
        [away, pause] = [false, firstPause];
        if (state.revision !== after) changed(state);
        after = state.revision;
      } catch (fault) {
        if (!away) lost(fault);
        [away, after] = [true, -1];
        await sleep(pause);
        pause = Math.min(longestPause, 2 * pause);
      }
    }
  }

  async function post(path, body, type) {
    const answer = await fetch(path, {method: "POST", body, headers: {"Content-Type": type}});
    if (answer.ok) return;
    const said = await answer.json().catch(() => ({}));
    throw new Error(said.error || `${path}: status ${answer.status}`);
  }

  const act = (action, details) =>
      post("api/do", JSON.stringify({action, ...details}), "application/json");

  const send = file =>
      post(`api/capture?name=${encodeURIComponent(file.name)}`, file, "application/octet-stream");

  return {follow, act, send, story: () => get("api/story")};
})();
