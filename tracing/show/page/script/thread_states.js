// SPDX-License-Identifier: Apache-2.0
// What threads did on the machine: running on a processor, runnable (waiting for one) or blocked. Only traces with events
// of the kernel's scheduler tell.

const kStates = [
  {color: 'running', text: 'on a processor'},
  {color: 'runnable', text: 'waited for a processor'},
  {color: 'blocked', text: 'blocked'},
];
const kRunnable = 1;

// The states of one thread. `ids` refer to states, by their begin.
class ThreadStates {
  constructor(data, ids) {
    this.data = data;
    this.ids = ids;
    this.begin = Float64Array.from(ids, id => data.states.start[id]);
    this.end = Float64Array.from(ids, id => data.states.end[id]);
    this.lines = kStates.map((_, state) => new Intervals(data.states, ids.filter(id => data.states.state[id] === state)));
  }

  // The state at a time, or -1.
  at(time) {
    const i = lowerBound(this.end, time);
    return i < this.ids.length && this.begin[i] <= time ? this.ids[i] : -1;
  }

  // How long the thread was in each state between two times, and the longest time without a processor:
  // {times: [running, runnable, blocked], longest: {time, id}}.
  between(begin, end) {
    const result = {times: kStates.map(() => 0), longest: {time: 0, id: -1}};
    const last = lowerBound(this.begin, end);
    for (let i = lowerBound(this.end, begin); i < last; ++i) {
      const time = Math.min(this.end[i], end) - Math.max(this.begin[i], begin);
      const state = this.data.states.state[this.ids[i]];
      result.times[state] += time;
      if (state === kRunnable && time > result.longest.time) result.longest = {time, id: this.ids[i]};
    }
    return result;
  }
}

// Of a thread, or null if the trace does not tell.
function statesOf(data, thread) {
  data.threadStates ??= new Map();
  if (!data.threadStates.has(thread)) {
    const ids = data.statesIn(thread);
    data.threadStates.set(thread, ids.length === 0 ? null : new ThreadStates(data, ids));
  }
  return data.threadStates.get(thread);
}

// "stress [90]", or null if the processor was idle or the trace does not tell.
function ranInstead(data, state) {
  const other = data.states.other[state];
  return other < 0 ? null : `${data.other_threads[other].name} [${data.other_threads[other].tid}]`;
}

// One state: "waited for a processor for 3.50 ms; stress [90] ran instead".
function stateText(data, id) {
  const {start, end, state, cpu} = data.states;
  const lines = `${kStates[state[id]].text} for ${formatDuration(end[id] - start[id])}`;
  if (state[id] === 0) return `${lines} (CPU ${cpu[id]})`;
  const other = state[id] === kRunnable ? ranInstead(data, id) : null;
  return other ? `${lines}; ${other} ran instead` : lines;
}

// Of an instance: "on a processor 500 µs, waited for a processor 3.50 ms (3.50 ms at once, stress [90] ran instead)".
// Empty if the trace does not tell.
function instanceStatesText(data, instance) {
  const {instances} = data;
  const states = statesOf(data, instances.thread[instance]);
  if (!states) return '';
  const {times, longest} = states.between(instances.start[instance], instances.end[instance]);
  const parts = kStates.map(({text}, state) => times[state] === 0 ? null : `${text} ${formatDuration(times[state])}`);
  if (longest.id >= 0) {
    const other = ranInstead(data, longest.id);
    const details = [longest.time < times[kRunnable] ? `at most ${formatDuration(longest.time)} at once` : null, other ? `${other} ran instead` : null].filter(Boolean);
    if (details.length > 0) parts[kRunnable] += ` (${details.join(', ')})`;
  }
  return parts.filter(Boolean).join(', ');
}

// What the colours under the callbacks mean.
function stateKey(data) {
  if (data.states.count === 0) return null;
  return element('span', {class: 'key'}, ...kStates.map(({color, text}) => element('span', {}, element('i', {style: `background: var(--${color})`}), text)));
}
