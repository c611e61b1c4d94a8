// The studio's panel. All state is the server's: the page shows it and asks for changes.
"use strict";

const Studio = (() => {
  const boxes = {}, shown = {};
  const chosen = {name: null}, typed = {text: null};
  let latest = null, storyRevision = null, telling = false, serverError = null;
  let unit = {torque: "N·m", position: "rad"}, floor = null;

  // What somebody types is theirs until they leave the field.
  function remember(box) {
    const active = document.activeElement;
    if (!box.contains(active) || !active.id) return () => {};
    const typing =
        active.type === "text" && active.value !== active.defaultValue ? active.value : null;
    return () => {
      const again = document.getElementById(active.id);
      if (!again) return;
      if (typing !== null) again.value = typing;
      again.focus({preventScroll: true});
    };
  }

  // Built anew only where what it shows has changed: by what `render` gives, or does itself.
  function keep(name, slice, render) {
    const text = JSON.stringify(slice);
    if (shown[name] === text) return;
    shown[name] = text;
    const restore = remember(boxes[name]);
    const content = render(boxes[name]);
    if (content !== undefined) Dom.refill(boxes[name], content);
    restore();
  }

  function complain(text) {
    if (boxes.error.textContent !== (text || "")) boxes.error.textContent = text || "";
    boxes.error.hidden = !text;
  }

  // A refusal stays until something succeeds, or the server has another complaint.
  async function attempt(work) {
    try {
      await work();
      complain(serverError);
    } catch (fault) {
      complain(fault.message);
    }
  }

  const act = (action, details) => attempt(() => Server.act(action, details));
  const send = file => attempt(() => Server.send(file));

  function connection(open, fault) {
    boxes.connection.dataset.state = open ? "open" : "lost";
    boxes.connection.textContent =
        open ? "connected" : `connection lost, trying again (${fault.message})`;
  }

  function panel(state) {
    const free = !state.busy;
    if (state.error !== serverError) complain(state.error);
    serverError = state.error;
    keep("actions", [free, state.undo, state.redo], () => Actions.buttons(state, act));
    keep("busy", state.busy, () => Actions.progress(state.busy));
    keep("captures", state.captures, box => Captures.show(box, state.captures, act));
    keep("model", state.model, box => Terms.show(box, state.model, act));
    keep("effects", state.effects, () => Terms.effectChoice(state.effects, act, chosen));
    keep("next", [state.experiment, free], () => Actions.next(state.experiment, free, act));
    keep(
        "can", [state.can && [state.can.interface, state.can.running], state.experiment, free],
        () => Bus.view(state.can, state.experiment, free, act, typed));
    keep("live", state.can, () => Bus.live(state.can, unit));
    keep("history", [state.history, floor], () => Actions.history(state.history, floor));
  }

  // A story of a long capture takes its time; what the panel says of the work goes on meanwhile.
  function changed(state) {
    latest = state;
    panel(state);
    if (!telling) tell();
  }

  function told(now) {
    telling = !now;
    document.getElementById("studio").dataset.told = String(now);
  }

  // Until the story that is shown is that of the latest state.
  async function tell() {
    try {
      while (storyRevision !== latest.story_revision) {
        told(false);
        const wanted = latest.story_revision;
        show(await Server.story());
        storyRevision = wanted;
        panel(latest);
      }
    } catch (fault) {
      complain(fault.message);
    } finally {
      told(true);
    }
  }

  function show(story) {
    unit = story.unit;
    floor = story.compare && story.compare.noise_floor;
    Story.tell(story, effect => act("add", {effect}));
  }

  function build() {
    const box = (name, attributes, kind = "div") => {
      boxes[name] = Dom.make(kind, attributes);
      return boxes[name];
    };
    const part = (title, ...content) => Dom.make("section", {}, Dom.make("h2", {}, title), content);
    const place = document.getElementById("studio");
    place.hidden = false;
    document.body.classList.add("studio");
    Dom.refill(
        place,
        Dom.make(
            "div", {id: "now"},
            box("connection", {id: "connection", role: "status", "data-state": "open"}),
            box("error", {id: "error", role: "alert", hidden: true}),
            box("actions", {id: "actions"}), box("busy", {id: "busy"})),
        Actions.downloads(),
        part(
            "Captures", box("captures", {id: "captures", class: "plain"}, "ul"),
            Captures.dropZone(send)),
        part(
            "Model", box("model", {id: "model"}), Dom.make("h3", {}, "Add an effect"),
            box("effects", {id: "effects"}), Terms.lawForm(act)),
        box("next", {id: "next-step"}), box("can", {id: "can"}), box("live", {id: "live"}),
        box("history", {id: "history"}));
  }

  function start() {
    build();
    ["dragover", "drop"].forEach(
        kind => window.addEventListener(kind, event => event.preventDefault()));
    Actions.keys(act, () => latest);
    Server.follow({changed, lost: fault => connection(false, fault), back: () => connection(true)});
    connection(true);
  }

  return {start};
})();
