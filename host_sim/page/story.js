// The story, top to bottom, and the way to its chapters.
"use strict";

const Story = (() => {
  // Plots are drawn a moment after they are there: until then the page keeps its height, and so its
  // place.
  function hold(main) {
    const focused = main.contains(document.activeElement) && document.activeElement.id;
    main.style.minHeight = main.offsetHeight + "px";
    return () => {
      const again = focused && document.getElementById(focused);
      if (again) again.focus({preventScroll: true});
      requestAnimationFrame(() => requestAnimationFrame(() => {
                              main.style.minHeight = "";
                            }));
    };
  }

  // `add` as in Candidates. Folds that are open stay open when the story is told anew.
  function tell(story, add) {
    const main = document.getElementById("story");
    const settle = hold(main);
    const open = [...main.querySelectorAll("details[open]")].map(d => d.id);
    const parts = [
      Head.section(story), TimePlot.section(story), Where.section(story),
      Candidates.section(story, add), Ladder.section(story), Parameters.section(story),
      Next.section(story), Provenance.section(story)
    ].filter(Boolean);
    Dom.refill(main, parts);
    settle();
    open.map(id => document.getElementById(id)).filter(Boolean).forEach(d => {
      d.open = true;
    });
    document.title = `${story.title} – servoid`;
    chapters(parts.filter(p => p.querySelector("h2")));
  }

  function chapters(sections) {
    Dom.refill(
        document.getElementById("chapters"),
        sections.map(s => Dom.make("a", {href: "#" + s.id}, s.querySelector("h2").textContent)));
  }

  return {tell};
})();
