// What the comparison says beside its error: numbers that stand for themselves.
"use strict";

const Facts = (() => {
  function lag(estimate) {
    if (!estimate || !Numbers.known(estimate.value)) return null;
    const told = Math.abs(estimate.value) > 3 * estimate.std;
    return [
      "lag of the torque", Numbers.withStd(1e3 * estimate.value, 1e3 * estimate.std) + " ms",
      told ? estimate.value > 0 ? "it acts later than the model says" : "it acts earlier" :
             "none that can be told from 0"
    ];
  }

  function of (compare) {
    const loop = compare.loop;
    return [
      Numbers.known(compare.repeatable_share) &&
          [
            "comes back with each period", Numbers.percent(compare.repeatable_share),
            "of the residual's power: a better model could explain it"
          ],
      loop &&
          [
            "the model in its own loop", Numbers.percent(loop.torque_error),
            `of the torque, ${Numbers.percent(loop.position_error)} of the position`
          ],
      lag(compare.lag_s)
    ].filter(Boolean);
  }

  function list(story) {
    const facts = story.compare ? of(story.compare) : [];
    if (!facts.length) return null;
    return Table.wide(
        {id: "facts"}, null,
        facts.map(
            ([name, value, meaning]) =>
                Table.row({}, Table.head(name), Table.text(value), Table.text(meaning))));
  }

  return {list};
})();
