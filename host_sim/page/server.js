// The studio's server: what it says of the session, and what it is asked to do.
"use strict";

const Server = (() => {
  const firstPause = 500, longestPause = 8000,
        patience = 30000;  // ms; a poll is answered within 20 s

  const sleep = ms => new Promise(done => setTimeout(done, ms));

  async function get(path) {
    const answer = await fetch(path, {cache: "no-store", signal: AbortSignal.timeout(patience)});
    if (!answer.ok) throw new Error(`${path}: status ${answer.status}`);
    return answer.json();
  }

  // Told at every change, for as long as the page is open. A server that was started anew counts
  // anew.
  async function follow({changed, lost, back}) {
    let after = -1, pause = firstPause, away = false;
    for (;;) {
      try {
        const state = await get(`api/state?after=${after}`);
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
