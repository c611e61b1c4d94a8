// A report has its story inside; the studio asks for it.
"use strict";

(() => {
  const mode = JSON.parse(document.getElementById("servoid-mode").textContent);
  Theme.start();
  if (mode.mode === "studio")
    Studio.start();
  else
    Story.tell(mode.story, null);
})();
