// SPDX-License-Identifier: Apache-2.0
// What the time chart tells of one instance of a callback: when, how long, why, and what came of it.

function instanceText(data, instance) {
  const {instances, messages} = data;
  const callback = data.callbacks[instances.callback[instance]];
  const lines = [
    callback.name,
    callback.symbol && callback.symbol !== callback.label ? callback.symbol : null,
    `${formatDuration(instances.end[instance] - instances.start[instance])} from ${formatTime(instances.start[instance])}`,
  ];
  const message = instances.message[instance];
  lines.push(instanceStatesText(data, instance));
  if (message >= 0) lines.push(`message after ${formatDuration(instances.start[instance] - messages.published[message])}`);
  return lines.filter(Boolean).join('\n');
}

// A list of facts with buttons to the instances around it.
function instanceDetails(data, instance, show) {
  if (instance === null) {
    return element('p', {class: 'note'}, 'Choose a callback in the chart to see what led to it and what came of it.');
  }
  const {instances, messages} = data;
  const id = instances.callback[instance];
  const callback = data.callbacks[id];
  const thread = data.threads[instances.thread[instance]];
  const same = data.instancesOf(id);
  const place = lowerBound(same, instance);
  const gap = place > 0 ? instances.start[instance] - instances.start[same[place - 1]] : null;
  const link = (to, text) => element('button', {onclick: () => show(to)}, text);
  const nameOf = to => callbackName(data, instances.callback[to]);
  const facts = [
    ['Callback', callback.name],
    ['Symbol', callback.symbol],
    ['Thread', `${thread.vtid} of ${processName(data, thread.process)}`],
    ['Start', formatTime(instances.start[instance], 1)],
    ['Duration', instances.finished(instance) ? formatDuration(instances.end[instance] - instances.start[instance]) : 'it has no end in the trace'],
    ['Of that', instanceStatesText(data, instance)],
    ['Since the one before', gap === null ? '' : formatDuration(gap) + (callback.period ? ` (period ${formatDuration(callback.period)})` : '')],
  ];
  const message = instances.message[instance];
  if (message >= 0) {
    const taken = messages.taken[message];
    facts.push(['Message', `${data.topics[topicOf(data, message)]}: ${formatDuration(instances.start[instance] - messages.published[message])} after its publication; ` +
      `${formatDuration(taken - messages.published[message])} until it was taken, ${formatDuration(instances.start[instance] - taken)} until the callback`]);
    if (messages.from[message] >= 0) facts.push(['Published by', link(messages.from[message], nameOf(messages.from[message]))]);
  }
  const sent = [...data.publishedBy(instance)].filter(m => messages.to[m] >= 0);
  if (sent.length > 0) facts.push(['Went on to', element('span', {class: 'tools'}, ...sent.slice(0, 20).map(m => link(messages.to[m], nameOf(messages.to[m]))))]);
  const step = element('span', {class: 'tools'},
    place > 0 ? link(same[place - 1], 'previous') : null, place + 1 < same.length ? link(same[place + 1], 'next') : null,
    element('button', {onclick: () => { select({callback: id}); showView('callbacks'); }}, 'statistics'));
  facts.push(['This callback', step]);
  return element('dl', {}, ...facts.filter(([, value]) => value).flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]));
}
