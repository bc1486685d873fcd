// SPDX-License-Identifier: Apache-2.0
// The whole way of a message through one instance of a callback: back to where it began, and on to everything that came
// of it.

const kMostOnWay = 200;  // messages, before and after

// {instance, begin, end, instances, messages, steps, isCut}. A step is {time, depth, kind, instance or message}, in the order
// in which the list shows them; kinds: 'begin' and 'end' of an instance, 'call', 'publish', 'write', 'take', 'lost' of a message.
function messageFlow(data, instance) {
  const {instances, messages} = data;
  const flow = {instance, instances: [], messages: [], steps: [], isCut: false};
  const led = [];  // the messages that led to the instance, the first one first
  for (let i = instance, seen = new Set(); i >= 0 && !seen.has(i);) {
    seen.add(i);
    flow.instances.push(i);
    const message = instances.message[i];
    if (message < 0) break;
    flow.isCut ||= led.length >= kMostOnWay;
    if (flow.isCut) break;
    led.unshift(message);
    i = messages.from[message];
  }
  const step = (time, depth, kind, what) => { if (!Number.isNaN(time)) flow.steps.push({time, depth, kind, ...what}); };
  const sent = (message, depth) => {
    flow.messages.push(message);
    if (messages.called[message] < messages.published[message]) step(messages.called[message], depth, 'call', {message});
    step(messages.published[message], depth, 'publish', {message});
    if (messages.written[message] > 0) step(messages.published[message] + messages.written[message], depth, 'write', {message});
  };
  led.forEach(message => {
    const from = messages.from[message];
    if (from >= 0) step(instances.start[from], 0, 'begin', {instance: from});
    sent(message, 0);
    step(messages.taken[message], 0, 'take', {message});
  });
  let after = 0;
  const run = (i, depth, path) => {
    step(instances.start[i], depth, 'begin', {instance: i});
    let last = -1;
    for (const message of data.publishedBy(i)) {
      if (++after > kMostOnWay) {
        flow.isCut = true;
        break;
      }
      // A publication is in the list once for each subscription that took it.
      if (messages.repeated[message] && last >= 0) flow.messages.push(message);
      else sent(message, depth + 1);
      last = message;
      const to = messages.to[message];
      step(messages.taken[message], depth + 1, 'take', {message});
      if (to < 0) {
        if (Number.isNaN(messages.taken[message]) && hasSubscription(data, message)) step(messages.published[message], depth + 1, 'lost', {message});
      } else if (!path.has(to)) {
        flow.instances.push(to);
        run(to, depth + 1, new Set(path).add(to));
      }
    }
    step(instances.end[i], depth, 'end', {instance: i});
  };
  run(instance, 0, new Set(flow.instances));
  flow.begin = Math.min(...flow.steps.map(({time}) => time));
  flow.end = Math.max(...flow.steps.map(({time}) => time));
  return flow;
}

function hasSubscription(data, message) {
  const topic = topicOf(data, message);
  return data.subscriptions.some(end => end.topic === topic);
}

function stepText(data, {kind, instance, message}) {
  const {instances, messages} = data;
  const topic = message === undefined ? '' : data.topics[topicOf(data, message)] ?? 'a topic that is not in the trace';
  const isWithin = message !== undefined && messages.to[message] >= 0 && instances.intraProcess(messages.to[message]);
  const taker = () => nodeName(data, data.subscriptions[messages.subscription[message]]?.node);
  switch (kind) {
    case 'begin': return `${callbackName(data, instances.callback[instance])} begins`;
    case 'end': return instances.finished(instance) ? `${callbackName(data, instances.callback[instance])} ends` : `${callbackName(data, instances.callback[instance])} has no end in the trace`;
    case 'call': return `publish() of ${topic} is called`;
    case 'publish': return isWithin ? `${topic} is put into the buffers of its process` : `${topic} is given to the middleware (rmw_publish)`;
    case 'write': return `${topic} is written (dds:write)`;
    case 'take': return `${taker() || 'somebody'} takes ${topic}${isWithin ? ' from its buffer' : ' (rmw_take)'}`;
    default: return `nobody took this message of ${topic}`;
  }
}

// What the thread that took a message did while the message was on its way: callbacks with their times, the longest first,
// and how long it waited for a processor.
function meanwhile(data, message) {
  const {instances, messages} = data;
  const receiver = messages.to[message];
  if (receiver < 0) return '';
  const [begin, end] = [messages.published[message], messages.taken[message]];
  const thread = instances.thread[receiver];
  const list = data.instancesIn(thread);
  const running = [];
  for (let k = lowerBound(list, receiver) - 1; k >= 0 && instances.end[list[k]] > begin; --k) running.unshift(list[k]);
  const times = new Map();
  let until = begin;  // callbacks within callbacks count once
  for (const i of running) {
    const time = Math.min(instances.end[i], end) - Math.max(instances.start[i], until);
    if (time <= 0) continue;
    until = Math.min(instances.end[i], end);
    const name = callbackName(data, instances.callback[i]);
    times.set(name, (times.get(name) ?? 0) + time);
  }
  const texts = [...times].sort(([, a], [, b]) => b - a).slice(0, 3).map(([name, time]) => `${name} for ${formatDuration(time)}`);
  const parts = texts.length === 0 ? [] : [`its thread ran ${texts.join(', ')}`];
  const waited = statesOf(data, thread)?.between(begin, end).times[kRunnable] ?? 0;
  if (waited > 0) parts.push(`its thread waited for a processor for ${formatDuration(waited)}`);
  return parts.join('; ');
}

// What the time before a step was spent with.
function stepRemark(data, {kind, message}) {
  if (kind === 'take') return ['on the way, or in the queue', meanwhile(data, message)].filter(Boolean).join('; ');
  return '';
}

// The list: steps with their times since the first one, and since the step before.
function flowList(data, flow, show, showAll) {
  if (!flow) return [];
  const rows = flow.steps.map((step, i) => {
    const before = flow.steps.slice(0, i).reverse().find(other => precedes(data, other, step));
    const text = stepText(data, step);
    const stage = before && {publish: 'sending', write: 'sending', take: 'way', begin: 'taken'}[step.kind];
    const isInstance = step.instance !== undefined && step.kind === 'begin';
    return element('tr', {class: step.instance === flow.instance ? 'active' : null},
      element('td', {}, `+${formatDuration(step.time - flow.begin)}`),
      element('td', {class: 'text wide', style: `padding-left: ${10 + 18 * step.depth}px`},
        isInstance ? element('button', {class: 'link', onclick: () => show(step.instance)}, text) : text),
      element('td', {}, stage ? element('i', {class: 'swatch', style: `background: ${stageColor(stage)}`}) : null, before ? formatDuration(step.time - before.time) : ''),
      element('td', {class: 'text wide faint'}, stepRemark(data, step)));
  });
  const head = ['Time', 'What', 'After', 'In this time'].map((title, i) => element('th', {class: i % 2 ? 'text' : null, scope: 'col'}, title));
  return [
    element('p', {class: 'tools'}, element('span', {}, `${formatDuration(flow.end - flow.begin)} from ${formatTime(flow.begin)}, ${plural(flow.instances.length, 'callback')}, ${plural(flow.messages.length, 'message')}`),
      element('button', {onclick: showAll, title: 'Key f'}, 'Show all of it')),
    element('div', {class: 'scroll'}, element('table', {class: 'steps'}, element('thead', {}, element('tr', {}, ...head)), element('tbody', {}, ...rows))),
    element('p', {class: 'note'}, 'Time: since the first of these. After: since the step that led to it. A trace does not hold when a message arrives, only when it is taken.' +
      (flow.isCut ? ` More than ${kMostOnWay} messages: the rest is left out.` : '')),
  ];
}

// Whether one step led to another: in the list it stands before it, and it is of the same message or instance.
function precedes(data, before, step) {
  const {messages, instances} = data;
  switch (step.kind) {
    case 'end': return before.kind === 'begin' && before.instance === step.instance;
    case 'begin': return before.kind === 'take' && before.message === instances.message[step.instance];
    case 'call': return before.kind === 'begin' && before.instance === messages.from[step.message];
    case 'take': case 'lost': return before.kind === 'publish' && messages.published[before.message] === messages.published[step.message] && topicOf(data, before.message) === topicOf(data, step.message);
    default: return before.message === step.message || (before.kind === 'begin' && before.instance === messages.from[step.message]);
  }
}
