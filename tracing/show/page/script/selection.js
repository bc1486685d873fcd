// SPDX-License-Identifier: Apache-2.0
// What the reader has chosen: a node, a topic, a callback, an instance. All views show the same choice.

const selection = {node: null, topic: null, callback: null, instance: null, listeners: []};

// select({node: 3}) changes only what is named.
function select(change) {
  Object.assign(selection, change);
  for (const listener of selection.listeners) listener(change);
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

// A button for each choice, which takes it back.
function showSelection(data, container) {
  const chip = (what, name, none) =>
    element('button', {class: 'chip', 'data-chip': what, title: 'Show everything again', onclick: () => select(none)}, `${what} ${name} ✕`);
  container.replaceChildren(...[
    selection.node === null ? null : chip('node', nodeName(data, selection.node), {node: null}),
    selection.topic === null ? null : chip('topic', data.topics[selection.topic], {topic: null}),
  ].filter(Boolean));
}
