// SPDX-License-Identifier: Apache-2.0
// The data of the page: the facts as they stand in it, and its columns as typed arrays. Times count from the first
// event. References that are -1 refer to nothing.

// `run`: '' for the run of the page, '-before' for the run that it is compared with.
async function loadData(run = '') {
  const facts = JSON.parse(document.getElementById(`facts${run}`).textContent);
  const packed = Uint8Array.from(atob(document.getElementById(`columns${run}`).textContent.trim()), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  const read = columnReader(new Uint8Array(await new Response(stream).arrayBuffer()));
  const processes = facts.processes.map(process => process || {vpid: 0, name: '', host: null, events: 0});  // of the kernel alone
  const data = {...facts, processes, instances: readInstances(read, facts.instances)};
  data.messages = readMessages(read, facts.messages, instance => instance < 0 ? -1 : data.instances.callback[instance]);
  data.states = readStates(read, facts.states);
  connect(data);
  return data;
}

// Numbers of seven bits a byte, the last byte without its highest bit (LEB128).
function columnReader(bytes) {
  let at = 0;
  const number = () => {
    let value = 0;
    for (let factor = 1;; factor *= 128) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  };
  const signed = () => {
    const value = number();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  };
  const column = (Type, count, next) => {
    const values = new Type(count);
    for (let i = 0; i < count; ++i) values[i] = next(i);
    return values;
  };
  const times = count => {
    let last = 0;
    return column(Float64Array, count, () => last += number());
  };
  // Those that are as they were the last time with the same key are 0.
  const repeatedReferences = (count, keyOf) => {
    const last = new Map();
    return column(Int32Array, count, i => {
      const key = keyOf(i);
      const value = number();
      if (value === 0) return last.get(key) ?? -1;
      last.set(key, value - 2);
      return value - 2;
    });
  };
  const closeReferences = count => {
    let last = 0;
    return column(Int32Array, count, () => {
      const step = number();
      if (step === 0) return -1;
      last += step % 2 === 1 ? (step - 1) / 2 : -step / 2;
      return last;
    });
  };
  return {number, signed, column, times, repeatedReferences, closeReferences};
}

function readInstances(read, count) {
  const start = read.times(count);
  const end = read.column(Float64Array, count, i => start[i] + read.number());
  const callback = read.column(Uint32Array, count, read.number);
  const thread = read.repeatedReferences(count, i => callback[i]);
  const flags = read.column(Uint8Array, count, read.number);
  return {count, start, end, callback, thread, finished: i => (flags[i] & 1) !== 0, intraProcess: i => (flags[i] & 2) !== 0};
}

function readMessages(read, count, callbackOf) {
  const published = read.times(count);
  const called = read.column(Float64Array, count, i => published[i] - read.number());
  const taken = read.column(Float64Array, count, i => read.number() === 0 ? NaN : published[i] + read.signed());
  const from = read.closeReferences(count);
  const to = read.closeReferences(count);
  const publisher = read.repeatedReferences(count, i => callbackOf(from[i]));
  const subscription = read.repeatedReferences(count, i => callbackOf(to[i]));
  const thread = read.repeatedReferences(count, i => publisher[i]);
  const repeated = read.column(Uint8Array, count, read.number);
  const written = read.column(Float64Array, count, read.number);  // after `published`; 0: not in the trace
  return {count, published, called, written, taken, publisher, subscription, thread, from, to, repeated};
}

// Thread by thread.
function readStates(read, count) {
  const thread = read.closeReferences(count);
  let last = 0;
  const start = new Float64Array(count);
  const gaps = read.column(Float64Array, count, read.signed);
  const end = read.column(Float64Array, count, i => {
    start[i] = last + gaps[i];
    return last = start[i] + read.number();
  });
  const state = read.column(Uint8Array, count, read.number);
  const runnable = [];
  state.forEach((value, i) => { if (value === 1) runnable.push(i); });
  const others = read.repeatedReferences(runnable.length, i => thread[runnable[i]]);
  const other = new Int32Array(count).fill(-1);
  runnable.forEach((id, i) => { other[id] = others[i]; });
  const cpu = read.repeatedReferences(count, i => thread[i]);
  return {count, thread, start, end, state, other, cpu};
}

// The other directions: the message that an instance got, the instances of a callback and of a thread, the messages that
// an instance published, the states of a thread.
function connect(data) {
  const {instances, messages} = data;
  instances.message = new Int32Array(instances.count).fill(-1);
  let slowest = 0;
  for (let i = 0; i < messages.count; ++i) {
    const to = messages.to[i];
    if (to < 0) continue;
    instances.message[to] = i;
    slowest = Math.max(slowest, instances.start[to] - messages.published[i]);
  }
  messages.slowest = slowest;
  data.instancesOf = group(instances.callback, instances.count, data.callbacks.length);
  data.instancesIn = group(instances.thread, instances.count, data.threads.length);
  data.statesIn = group(data.states.thread, data.states.count, data.threads.length);
  data.publishedBy = group(messages.from, messages.count, instances.count);
  const seen = new Map();
  data.callbacks.forEach((callback, id) => {
    callback.label = callbackLabel(data, callback);
    callback.color = id;
    const name = [nodeName(data, callback.node), callback.label].filter(Boolean).join(' · ');
    seen.set(name, (seen.get(name) ?? 0) + 1);
    callback.name = seen.get(name) === 1 ? name : `${name} #${seen.get(name)}`;
  });
}

// group(keys)(key) gives the indices at which the key stands, in order.
function group(keys, count, groups) {
  const begin = new Uint32Array(groups + 1);
  for (let i = 0; i < count; ++i) if (keys[i] >= 0) ++begin[keys[i] + 1];
  for (let i = 0; i < groups; ++i) begin[i + 1] += begin[i];
  const next = begin.slice(0, groups);
  const order = new Uint32Array(begin[groups]);
  for (let i = 0; i < count; ++i) if (keys[i] >= 0) order[next[keys[i]]++] = i;
  return key => order.subarray(begin[key], begin[key + 1]);
}

function callbackLabel(data, callback) {
  switch (callback.kind) {
    case 'subscription': return data.topics[callback.topic];
    case 'timer': return `timer ${formatDuration(callback.period)}`;
    case 'service': return `service ${callback.service}`;
    case 'client': return `client of ${callback.service}`;
    default: return callback.symbol || 'unknown callback';
  }
}

// "/filter · /scan"; others with the same name are numbered.
function callbackName(data, id) {
  return data.callbacks[id].name;
}

// With several machines in the trace, what runs on one of them is called after it: "left: /camera".
function nodeName(data, node) {
  if (node === null || node === undefined) return '';
  const {name, process} = data.nodes[node];
  return hostOf(data, process) + name;
}

function processName(data, process) {
  const {name, vpid} = data.processes[process];
  return `${hostOf(data, process)}${name} [${vpid}]`;
}

function hostOf(data, process) {
  data.hasSeveralHosts ??= new Set(data.processes.map(({host}) => host).filter(host => host !== null)).size > 1;
  return data.hasSeveralHosts && data.processes[process] ? `${data.processes[process].host}: ` : '';
}

function topicOf(data, message) {
  const publisher = data.messages.publisher[message];
  return publisher < 0 ? -1 : data.publishers[publisher].topic;
}

// Topics that every node has, or that belong to the middleware.
function isInternalTopic(name) {
  return name === '/rosout' || name === '/parameter_events' || name.includes('/_action/');
}
