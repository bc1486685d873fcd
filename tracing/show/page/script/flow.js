// SPDX-License-Identifier: Apache-2.0
// The whole way of a message through one instance of a callback: back to where it began, and on to everything that came
// of it.

const kMostOnWay = 200;  // messages, before and after

// {instance, begin, end, instances, messages, steps, isCut}. A step is {time, depth, kind, instance or message}, in the order
// in which the list shows them; kinds: 'begin' and 'end' of an instance, 'call', 'publish', 'write', 'take', 'lost' of a message.
// `isKept` marks an instance whose message was kept for the publication that follows.
function messageFlow(data, instance) {
  return new FlowFinder(data, instance).flow;
}

class FlowFinder {
  constructor(data, instance) {
    this.data = data;
    this.flow = {instance, instances: [instance], messages: [], steps: [], isCut: false};
    this.lead(instance, 0, false);
    this.follow(instance, 0);
    const times = this.flow.steps.map(({time}) => time);
    this.flow.begin = Math.min(...times);
    this.flow.end = Math.max(...times);
  }

  step(time, depth, kind, what) {
    if (!Number.isNaN(time)) this.flow.steps.push({time, depth, kind, ...what});
  }

  // Whether there is room for another message, which has not been met yet.
  isNew(message) {
    if (this.flow.messages.includes(message)) return false;
    if (this.flow.messages.length >= kMostOnWay) this.flow.isCut = true;
    return !this.flow.isCut;
  }

  // What led to an instance, the first of it first. Kept messages come before the one that made the callback publish.
  lead(instance, depth) {
    const {data, flow} = this;
    const message = data.instances.message[instance];
    if (message < 0 || !this.isNew(message)) return;
    flow.messages.push(message);
    const own = data.messages.from[message];
    const causes = causesOf(data, message);
    for (const cause of [...causes.filter(cause => cause !== own), ...causes.filter(cause => cause === own)]) {
      const isKept = cause !== own;
      if (!flow.instances.includes(cause)) {
        flow.instances.push(cause);
        this.lead(cause, depth + (isKept ? 1 : 0));
      }
      this.step(data.instances.start[cause], depth + (isKept ? 1 : 0), 'begin', {instance: cause, isKept});
    }
    this.send(message, depth);
    this.step(data.messages.taken[message], depth, 'take', {message});
  }

  send(message, depth) {
    const {called, published, written} = this.data.messages;
    if (called[message] < published[message]) this.step(called[message], depth, 'call', {message});
    this.step(published[message], depth, 'publish', {message});
    if (written[message] > 0) this.step(published[message] + written[message], depth, 'write', {message});
  }

  // What came of an instance.
  follow(instance, depth) {
    const {data} = this;
    const {start, end} = data.instances;
    this.step(start[instance], depth, 'begin', {instance});
    this.followMessages(data.publishedBy(instance), depth + 1);
    this.step(end[instance], depth, 'end', {instance});
    // Other callbacks that publish what this one has kept.
    let publisher = -1;
    for (const message of sentLater(data, instance)) {
      const from = data.messages.from[message];
      if (!this.isNew(message)) continue;
      if (from >= 0 && from !== publisher) {
        this.step(start[from], depth + 1, 'begin', {instance: from});
        if (!this.flow.instances.includes(from)) this.flow.instances.push(from);
      }
      publisher = from;
      this.followMessages([message], depth + 2);
    }
  }

  followMessages(list, depth) {
    const {data, flow} = this;
    const {messages} = data;
    let isSent = false;
    for (const message of list) {
      if (!this.isNew(message)) continue;
      flow.messages.push(message);
      // A publication is in the list once for each subscription that took it.
      if (!messages.repeated[message] || !isSent) this.send(message, depth);
      isSent = true;
      const to = messages.to[message];
      this.step(messages.taken[message], depth, 'take', {message});
      if (to < 0) {
        if (Number.isNaN(messages.taken[message]) && hasSubscription(data, message)) this.step(messages.published[message], depth, 'lost', {message});
      } else if (!flow.instances.includes(to)) {
        flow.instances.push(to);
        this.follow(to, depth);
      }
    }
  }
}

function hasSubscription(data, message) {
  const topic = topicOf(data, message);
  return data.subscriptions.some(end => end.topic === topic);
}

function stepText(data, {kind, instance, message, isKept}) {
  const {instances, messages} = data;
  const topic = message === undefined ? '' : data.topics[topicOf(data, message)] ?? 'a topic that is not in the trace';
  const isWithin = message !== undefined && messages.to[message] >= 0 && instances.intraProcess(messages.to[message]);
  const taker = () => nodeName(data, data.subscriptions[messages.subscription[message]]?.node);
  switch (kind) {
    case 'begin': return `${callbackName(data, instances.callback[instance])} begins${isKept ? ', its message is kept' : ''}`;
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
