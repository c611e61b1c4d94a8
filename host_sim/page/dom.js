// Elements. What comes from files and models goes in as text nodes only and never is markup.
"use strict";

const Dom = (() => {
  const svgSpace = "http://www.w3.org/2000/svg";
  const drawings = new WeakMap(), kept = new WeakMap();

  function dress(element, attributes) {
    for (const [name, value] of Object.entries(attributes || {})) {
      if (value === null || value === undefined || value === false) continue;
      if (typeof value === "function")
        element.addEventListener(name, value);
      else
        element.setAttribute(name, value === true ? "" : value);
    }
    return element;
  }

  function fill(element, children) {
    for (const child of children.flat(Infinity)) {
      if (child === null || child === undefined || child === false) continue;
      element.append(child instanceof Node ? child : String(child));
    }
    return element;
  }

  // Attributes that are functions are listeners: {click: go}.
  function make(name, attributes, ...children) {
    return fill(dress(document.createElement(name), attributes), children);
  }

  function svg(name, attributes, ...children) {
    return fill(dress(document.createElementNS(svgSpace, name), attributes), children);
  }

  function refill(element, ...children) {
    element.replaceChildren();
    return fill(element, children);
  }

  // The items of a list, each in a child of its own that stays as long as its item does.
  function list(box, items, render) {
    const old = new Map([...box.children].map(child => [kept.get(child), child]));
    const children = items.map(item => {
      const key = JSON.stringify(item);
      const child = old.get(key) || render(item);
      old.delete(key);
      kept.set(child, key);
      return child;
    });
    old.forEach(child => child.remove());
    // What is in its place is not touched: it may hold the focus.
    children.forEach((child, k) => {
      if (box.children[k] !== child) box.insertBefore(child, box.children[k] || null);
    });
  }

  function redraw(box) {
    const drawing = drawings.get(box);
    const width = Math.floor(box.clientWidth);
    if (!drawing || width === 0 || width === drawing.width) return;
    drawing.width = width;
    refill(box, drawing.render(width));
  }

  const observer = new ResizeObserver(entries => entries.forEach(e => redraw(e.target)));

  // A box that is drawn for its width, when it has one, and again when that changes.
  function drawing(attributes, render) {
    const box = make("div", {...attributes, class: "drawing " + (attributes.class || "")});
    drawings.set(box, {render, width: 0});
    observer.observe(box);
    return box;
  }

  // A page from a file may be denied the clipboard; the old command then still works.
  async function copy(text) {
    try {
      await navigator.clipboard.writeText(text);
    } catch (refused) {
      const field = make("textarea", {class: "off-screen"});
      field.value = text;
      document.body.append(field);
      field.select();
      document.execCommand("copy");
      field.remove();
    }
  }

  function copyButton(id, text) {
    const button = make("button", {id, type: "button", class: "quiet", "data-copy": true}, "Copy");
    button.addEventListener("click", async () => {
      await copy(text);
      button.textContent = "Copied";
      setTimeout(() => {
        button.textContent = "Copy";
      }, 1500);
    });
    return button;
  }

  // A name of a parameter, which may go on in the next line after a dot or an underscore.
  function name(text) {
    return text.split(/(?<=[._])/).map((part, k) => k ? [make("wbr"), part] : part);
  }

  // Text to take away, with its button.
  function block(id, text) {
    return make(
        "div", {class: "block"}, copyButton(id + "-copy", text),
        make("pre", {id, tabindex: "0"}, text));
  }

  function fold(id, title, ...content) {
    return make("details", {id}, make("summary", {}, title), ...content);
  }

  function section(id, title, lede, ...content) {
    return make(
        "section", {id, "aria-labelledby": id + "-title"}, make("h2", {id: id + "-title"}, title),
        lede && make("p", {class: "lede"}, lede), ...content);
  }

  // A number with its exact value beside it, for whoever reads the page by program.
  function value(id, number, text, attributes) {
    return make("span", {id, class: "number", "data-value": number, ...attributes}, text);
  }

  return {make, svg, refill, list, drawing, copyButton, block, fold, section, value, name};
})();
