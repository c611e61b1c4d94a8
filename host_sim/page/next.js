// What to record next, and what these captures cannot show.
"use strict";

const Next = (() => {
  function experiment(next) {
    if (!next) return null;
    return [
      Dom.make("h3", {}, "Experiment"), Dom.make("p", {}, next.reason),
      Dom.block("next-experiment", next.experiment)
    ];
  }

  function cannotShow(all) {
    if (!all.length) return null;
    const row = u => Table.row(
        {"data-effect": u.effect}, Table.head(Dom.name(u.effect)), Table.text(u.why),
        Table.text(u.record));
    return [
      Dom.make("h3", {}, "What these captures cannot show"),
      Table.wide({id: "cannot-show"}, ["effect", "why", "record instead"], all.map(row))
    ];
  }

  function advice(id, text) {
    return text && Dom.make("p", {id, class: "advice"}, text);
  }

  // Of the refined model where there is one: its gaps are those that are left.
  function section(story) {
    const last = [story.refine, story.diagnose].filter(Boolean);
    if (!last.length && !story.advice) return null;
    const next = last.map(x => x.next_experiment).find(Boolean);
    const gaps = last.length ? last[0].cannot_show || [] : [];
    return Dom.section(
        "next", "Record next", null, advice("advice", story.advice),
        story.refine && advice("refined-advice", "with all of the ladder: " + story.refine.advice),
        experiment(next), cannotShow(gaps));
  }

  return {section};
})();
