// SPDX-License-Identifier: Apache-2.0
// The keys, each declared once: for what it does and for the help. A view has its keys in keysOf, with what they act on in
// its element's `keyTarget`. They work at once, wherever the focus is, but not in a field that takes text.

// Of each view: [{keys, shown: as the help names them, what, act: target => …}].
const keysOf = {};

const kKeyNames = {ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓', ' ': 'Space'};
const kPointerHelp = {};  // of each view: [what the pointer does, …], pairs

function takesText(target) {
  return target.tagName === 'SELECT' || target.tagName === 'TEXTAREA' ||
    (target.tagName === 'INPUT' && !['checkbox', 'radio', 'button'].includes(target.type));
}

function listenToKeys(viewKeys) {
  document.addEventListener('keydown', event => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || takesText(event.target) || document.querySelector('dialog[open]')) return;
    const target = document.getElementById('view').firstElementChild?.keyTarget;
    const found = (target ? keysOf[page.shown] ?? [] : []).find(({keys}) => keys.includes(event.key));
    const act = found ? () => found.act(target) : viewKeys.find(({keys}) => keys.includes(event.key))?.act;
    if (!act) return;
    event.preventDefault();
    act();
  });
}

function keyList(entries) {
  return element('dl', {}, ...entries.flatMap(({keys, shown, what}) => [
    element('dt', {}, ...(shown ?? keys).flatMap(key => [element('kbd', {}, kKeyNames[key] ?? key), ' '])), element('dd', {}, what)]));
}

// The keys of all views, those of the one that is shown first.
function showHelp(viewKeys, titles) {
  const parts = Object.keys(keysOf).filter(view => titles.has(view)).sort((a, b) => (b === page.shown) - (a === page.shown));
  const close = element('button', {onclick: () => help.close()}, 'Close');
  const help = element('dialog', {class: 'help', 'aria-label': 'Keys', onclose: () => help.remove(),
    onclick: event => { if (event.target === help) help.close(); }},
  element('div', {class: 'tools'}, element('h2', {}, 'Keys'), close),
  element('div', {class: 'columns'}, element('section', {}, element('h3', {}, 'Everywhere'), keyList(viewKeys)),
    ...parts.map(view => element('section', {}, element('h3', {}, titles.get(view)), keyList([...keysOf[view], ...(kPointerHelp[view] ?? [])])))));
  help.addEventListener('keydown', event => {
    if (event.key !== '?') return;
    event.stopPropagation();  // it would open the help again
    help.close();
  });
  document.body.append(help);
  help.showModal();
}
