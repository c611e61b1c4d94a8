// Light or dark: as the system says, until the button says otherwise.
"use strict";

const Theme = (() => {
  const root = document.documentElement;
  const system = matchMedia("(prefers-color-scheme: dark)");
  const listeners = [];
  let chosen = null;

  function apply() {
    wear(chosen || (system.matches ? "dark" : "light"));
  }

  function wear(theme) {
    root.dataset.theme = theme;
    const button = document.getElementById("theme");
    button.textContent = root.dataset.theme === "dark" ? "Light" : "Dark";
    listeners.forEach(tell => tell());
  }

  function start() {
    document.getElementById("theme").addEventListener("click", () => {
      chosen = root.dataset.theme === "dark" ? "light" : "dark";
      apply();
    });
    system.addEventListener("change", apply);
    addEventListener("beforeprint", () => wear("light"));
    addEventListener("afterprint", apply);
    apply();
  }

  // A canvas needs the colour itself, not the name of a variable.
  function colour(name) {
    return getComputedStyle(root).getPropertyValue("--" + name).trim();
  }

  return {start, colour, onChange: listener => listeners.push(listener)};
})();
