// SPDX-License-Identifier: Apache-2.0
// What the reader has chosen: a node, a topic, a callback, an instance. All views show the same choice, and each of them
// shows a button (a chip) for each part of it, which takes it back.

const selection = {node: null, topic: null, callback: null, instance: null, listeners: []};
const kNothingChosen = {node: null, topic: null, callback: null, instance: null};

// What a view's content depends on.
const kChoicesOf = {
  graph: ['node', 'topic'], time: ['node', 'topic', 'callback', 'instance'], callbacks: ['node', 'topic', 'callback'], topics: ['node', 'topic'],
  services: ['node'], chains: ['node', 'topic', 'callback'], lifecycle: ['node'], processes: ['node'],
};

// select({node: 3}) changes only what is named.
function select(change) {
  Object.assign(selection, change);
  for (const listener of selection.listeners) listener(change);
}

function isAnythingChosen() {
  return Object.keys(kNothingChosen).some(what => selection[what] !== null);
}

// Whether a callback belongs to the chosen node and topic. A timer belongs to a topic if its node publishes it.
function isChosen(data, callback) {
  if (selection.node !== null && callback.node !== selection.node) return false;
  if (selection.topic === null || callback.topic === selection.topic) return true;
  return callback.kind !== 'subscription' && publishes(data, callback.node, selection.topic);
}

function publishes(data, node, topic) {
  return data.publishers.some(end => end.node === node && end.topic === topic);
}

function subscribes(data, node, topic) {
  return data.subscriptions.some(end => end.node === node && end.topic === topic);
}

function chosenNames(data) {
  const {node, topic, callback, instance} = selection;
  return [
    ['node', node === null ? null : nodeName(data, node)], ['topic', topic === null ? null : data.topics[topic]],
    ['callback', callback === null ? null : callbackName(data, callback)],
    ['run', instance === null ? null : `at ${formatTime(data.instances.start[instance])}`],
  ].filter(([, name]) => name !== null);
}

// A button for each choice, which takes it back. What the view does not depend on is drawn with a dashed border.
function showSelection(data, container, view) {
  const chips = chosenNames(data).map(([what, name]) => {
    const choice = what === 'run' ? 'instance' : what;
    const applies = (kChoicesOf[view] ?? []).includes(choice);
    return element('button', {class: applies ? 'chip' : 'chip idle', 'data-chip': what, onclick: () => select({[choice]: null}),
      title: applies ? 'Show everything again' : 'This view does not depend on it. A click takes it back.'}, `${what} ${name} ✕`);
  });
  if (chips.length > 1) chips.push(element('button', {class: 'chip', 'data-chip': 'all', title: 'Escape', onclick: () => select(kNothingChosen)}, 'all ✕'));
  container.replaceChildren(...chips);
}
