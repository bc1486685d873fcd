// SPDX-License-Identifier: Apache-2.0
// Elements of the page.

// Attributes named on… are listeners. Children are elements or texts; null is left out.
function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

function svgElement(tag, attributes = {}, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function fill(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children.flat().filter(child => child !== null && child !== undefined));
  return made;
}

function panel(title, ...children) {
  return element('section', {class: 'panel'}, title ? element('h2', {}, title) : null, ...children);
}

// The colours of page.css, which depend on the scheme of the reader's system.
function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// A colour for the number of a callback. Neighbours differ much: the golden angle lies between them. All are as bright
// to the eye, so a dark text on them can be read.
function barColor(number, lightness) {
  return `oklch(${lightness} 0.13 ${(number * 137.508 + 252) % 360})`;
}

// Moves the focus among `items` with the arrow keys.
function arrowKeys(container, items) {
  container.addEventListener('keydown', event => {
    const list = items();
    const at = list.indexOf(document.activeElement);
    const to = {ArrowRight: at + 1, ArrowDown: at + 1, ArrowLeft: at - 1, ArrowUp: at - 1, Home: 0, End: list.length - 1}[event.key];
    if (at < 0 || to === undefined || !list[to]) return;
    event.preventDefault();
    list[to].focus();
  });
}
