// The studio's model: its terms, their numbers, and the effects that could be added.
"use strict";

const Terms = (() => {
  const calm = 300;  // ms without another key before a number is sent

  // An arrow moves the second digit: what is worth trying, whatever the size.
  function stepOf(value) {
    return value === 0 ? 0.1 : Math.pow(10, Math.floor(Math.log10(Math.abs(value))) - 1);
  }

  function parse(text) {
    return text.trim() === "" ? NaN : Number(text.trim().replace(",", "."));
  }

  function numberInput(p, act) {
    const input = Dom.make("input", {
      type: "text",
      inputmode: "decimal",
      id: "value-" + p.name,
      value: Numbers.significant(p.value, 5),
      "data-value": p.value,
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": `${p.name}, ${p.unit}`,
      title: p.meaning
    });
    let sent = input.value, timer = 0;
    const commit = () => {
      clearTimeout(timer);
      const value = parse(input.value);
      input.setAttribute("aria-invalid", String(!Numbers.known(value)));
      if (!Numbers.known(value) || input.value === sent) return;
      sent = input.value;
      act("set", {name: p.name, value});
    };
    const nudge = direction => {
      const value = parse(input.value);
      if (!Numbers.known(value)) return;
      input.value = Numbers.significant(value + direction * stepOf(value), 5);
      clearTimeout(timer);
      timer = setTimeout(commit, calm);
    };
    input.addEventListener("change", commit);
    input.addEventListener("keydown", event => {
      const direction = {ArrowUp: 1, ArrowDown: -1}[event.key];
      if (direction) {
        event.preventDefault();
        nudge(direction);
      } else if (event.key === "Enter")
        commit();
    });
    return input;
  }

  function limits(p) {
    if (!Numbers.known(p.lower) && !Numbers.known(p.upper)) return "";
    return `within ${Numbers.known(p.lower) ? Numbers.significant(p.lower) : "−∞"} … ${
        Numbers.known(p.upper) ? Numbers.significant(p.upper) : "∞"}`;
  }

  function parameter(p, act) {
    const fixed = Dom.make("input", {type: "checkbox", id: "fixed-" + p.name, checked: p.fixed});
    fixed.addEventListener("change", () => act("fix", {name: p.name, fixed: fixed.checked}));
    return Dom.make(
        "div", {
          class: "parameter",
          "data-parameter": p.name,
          title: [p.meaning, limits(p)].filter(Boolean).join("; ")
        },
        Dom.make(
            "label",
            { for: "value-" + p.name
            },
            Dom.name(p.key)),
        numberInput(p, act), Dom.make("span", {class: "unit"}, Numbers.unit(p.unit)),
        Dom.make("label", {class: "fix"}, fixed, " fixed"),
        Dom.make(
            "span", {class: "std number", "data-std": p.std},
            Numbers.known(p.std) && p.std > 0 ? "± " + Numbers.significant(p.std, 2) : ""));
  }

  function term(t, act) {
    const on = Dom.make("input", {
      type: "checkbox",
      class: "term-on",
      id: "term-on-" + t.index,
      checked: t.on,
      "aria-label": `${t.effect} on`
    });
    on.addEventListener("change", () => act("turn", {index: t.index, on: on.checked}));
    return Dom.make(
        "div",
        {class: "term" + (t.on ? "" : " off"), "data-index": t.index, "data-effect": t.effect},
        Dom.make(
            "div", {class: "term-head"},
            Dom.make("label", {}, on, " ", Dom.make("b", {}, t.effect)),
            Dom.make(
                "button", {
                  type: "button",
                  class: "term-remove quiet",
                  id: "term-remove-" + t.index,
                  "aria-label": "remove " + t.effect,
                  click: () => act("remove", {index: t.index})
                },
                "Remove")),
        Dom.make("code", {class: "law"}, t.law), t.parameters.map(p => parameter(p, act)));
  }

  function inertia(p, act) {
    return Dom.make("div", {class: "term", "data-effect": "inertia"}, parameter(p, act));
  }

  function show(box, model, act) {
    Dom.list(
        box, [{inertia: model.inertia}].concat(model.terms),
        t => t.inertia ? inertia(t.inertia, act) : term(t, act));
  }

  // Effects that cannot be added stay in the list: the reason is worth knowing.
  function effectChoice(effects, act, chosen) {
    const select = Dom.make(
        "select", {id: "effect-choice", "aria-label": "effect to add"},
        effects.map(
            e => Dom.make(
                "option", {value: e.name, selected: e.name === chosen.name},
                e.cannot_add ? `${e.name} (not now)` : e.name)));
    const why = Dom.make("p", {id: "effect-why", class: "hint"});
    const add = Dom.make(
        "button",
        {type: "button", id: "effect-add", click: () => act("add", {effect: select.value})}, "Add");
    const tell = () => {
      chosen.name = select.value;
      const e = effects.find(x => x.name === select.value);
      add.disabled = !e || Boolean(e.cannot_add);
      Dom.refill(why, e ? [Dom.make("code", {}, e.law), ": ", e.cannot_add || e.signature] : "");
    };
    select.addEventListener("change", tell);
    tell();
    return [Dom.make("div", {class: "row"}, select, add), why];
  }

  function lawForm(act) {
    const name = Dom.make("input", {
      id: "law-name",
      type: "text",
      placeholder: "cubic",
      "aria-label": "name of the law",
      required: true,
      autocomplete: "off"
    });
    const law = Dom.make("input", {
      id: "law-text",
      type: "text",
      placeholder: "k*theta^3",
      "aria-label": "law",
      required: true,
      autocomplete: "off",
      spellcheck: "false"
    });
    const form = Dom.make(
        "form", {id: "law-form"},
        Dom.make("div", {class: "row"}, name, law, Dom.make("button", {id: "law-add"}, "Add")));
    form.addEventListener("submit", event => {
      event.preventDefault();
      act("add", {name: name.value.trim(), law: law.value.trim()});
    });
    return Dom.fold(
        "law", "A law of your own", form,
        Dom.make(
            "dl", {class: "help"},
            [
              ["t", "time from the start of the capture, s"], ["theta", "position"],
              ["v", "velocity"], ["a", "acceleration"], ["T", "torque that reaches the motor"],
              ["sin cos tan exp log sqrt abs sign tanh min max", "functions; angles in rad"],
              ["any other name", "a parameter, which is fitted"]
            ]
                .map(
                    ([term, meaning]) =>
                        [Dom.make("dt", {}, Dom.make("code", {}, term)),
                         Dom.make("dd", {}, meaning)])));
  }

  return {show, effectChoice, lawForm};
})();
