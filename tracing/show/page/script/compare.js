// SPDX-License-Identifier: Apache-2.0
// Two runs: what both have under the same name, the percentiles of each, and what the comparison says about them.

const kSides = ['before', 'after'];

// Prepares two runs: callbacks with the same name get the same colour.
function connectRuns(comparison, [before, after]) {
  [before, after].forEach((data, side) => { data.names = comparison.names[side]; });
  const colors = new Map(after.names.callbacks.map((name, id) => [name, id]));
  before.callbacks.forEach((callback, id) => { callback.color = colors.get(before.names.callbacks[id]) ?? after.callbacks.length + id; });
}

// What has a name, with what it has in each run: {kind, subject, sides: [{times: summary, values, id or chain} or null, …]}.
// The summaries are of what the page holds, so they may differ a little from what the comparison has of the whole trace.
function comparedSubjects(runs) {
  const subjects = new Map();
  runs.forEach((data, side) => {
    const seen = new Map();
    const add = (kind, subject, times, rest = {}) => {
      if (!times || times.count === 0) return;
      const key = `${kind} ${subject}`;
      seen.set(key, (seen.get(key) ?? 0) + 1);
      const name = seen.get(key) === 1 ? subject : `${subject} #${seen.get(key)}`;
      if (!subjects.has(`${kind} ${name}`)) subjects.set(`${kind} ${name}`, {kind, subject: name, sides: [null, null]});
      subjects.get(`${kind} ${name}`).sides[side] = {times, ...rest};
    };
    data.callbacks.forEach((_, id) => {
      const {durations} = callbackStatistics(data, id);
      add('callback', data.names.callbacks[id], durations, {id, sorted: durations.sorted});
    });
    for (const [id, {latency, messages}] of hopStatistics(data)) add('hop', data.names.subscriptions[id], latency, {messages, sorted: latency.sorted});
    const paths = new Set();
    for (const chain of data.chains) {
      const subject = chain.steps.map(step => data.names.steps[step.callback]).join(' -> ');
      const path = chain.steps.map(step => step.callback).join();
      if (paths.has(path)) continue;  // it has several names
      paths.add(path);
      add('chain', subject, chain.response, {chain});
    }
    for (const call of data.calls) add('call', `${call.service}, asked by ${call.client}`, call.round_trip);
  });
  return [...subjects.values()];
}

// Of each subscription: latencies from the first publish function to the callback, and the messages.
function hopStatistics(data) {
  const computed = computedOf(data);
  if (computed.subscriptions) return computed.subscriptions;
  const {messages, instances} = data;
  const lists = new Map();
  for (let i = 0; i < messages.count; ++i) {
    if (messages.to[i] < 0 || messages.subscription[i] < 0) continue;
    if (!lists.has(messages.subscription[i])) lists.set(messages.subscription[i], []);
    lists.get(messages.subscription[i]).push(i);
  }
  computed.subscriptions = new Map([...lists].map(([id, list]) =>
    [id, {messages: list, latency: summary(Float64Array.from(list, i => instances.start[messages.to[i]] - messages.called[i]))}]));
  return computed.subscriptions;
}

// {word, kind: of its colour, changes} of a subject. A change holds with the confidence of the comparison, or is likely.
function verdictOf(comparison, {kind, subject, sides}) {
  const of = list => list.filter(change => change.kind === kind && change.subject === subject);
  const direction = changes => {
    const largest = changes.reduce((a, b) => Math.abs(b.shift_ns) > Math.abs(a.shift_ns) ? b : a);
    return largest.shift_ns > 0 ? 'slower' : 'faster';
  };
  const changes = of(comparison.changes);
  if (changes.length > 0) return {word: direction(changes), kind: direction(changes), changes, rank: 0};
  const likely = of(comparison.likely);
  if (likely.length > 0) return {word: `likely ${direction(likely)}`, kind: direction(likely), changes: likely, rank: 1};
  if (!sides[0] || of(comparison.new).length > 0) return {word: 'only after', kind: 'lone', changes: [], rank: 2};
  if (!sides[1] || of(comparison.gone).length > 0) return {word: 'only before', kind: 'lone', changes: [], rank: 2};
  if (kind === 'chain' && !comparison.names.every(({chains}) => chains.includes(subject))) return {word: 'not compared', kind: 'none', changes: [], rank: 5};
  if (sides.some(side => side.times.count < 16)) return {word: 'too few to tell', kind: 'none', changes: [], rank: 4};
  return {word: 'no change holds', kind: 'none', changes: [], rank: 3};
}

function changeText({quantity, statistic, before_ns, after_ns, shift_ns}) {
  return `${quantity}, ${statistic} ${formatDuration(before_ns)} → ${formatDuration(after_ns)} (${signedDuration(shift_ns)})`;
}

function signedDuration(ns) {
  return Number.isNaN(ns) ? '–' : `${ns > 0 ? '+' : ns < 0 ? '−' : '±'}${formatDuration(Math.abs(ns))}`;
}

// What to show of a subject in a run: {instance, since}, the run whose time is at this percentile, or null.
function exampleOf(data, side, kind, share) {
  if (!side) return null;
  const {start, end, finished} = data.instances;
  const at = (list, time) => {
    const sorted = [...list].sort((a, b) => time(a) - time(b));
    return sorted.length === 0 ? null : sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)];
  };
  if (kind === 'callback') {
    const instance = at(data.instancesOf(side.id).filter(finished), i => end[i] - start[i]);
    return instance === null ? null : {instance, since: start[instance]};
  }
  if (kind === 'hop') {
    const {to, called} = data.messages;
    const message = at(side.messages, i => start[to[i]] - called[i]);
    return message === null ? null : {instance: to[message], since: called[message]};
  }
  if (kind === 'chain') {
    const run = runAt(chainRuns(data, side.chain), share);
    return run && {instance: run.last, since: start[run.first]};
  }
  return null;
}
