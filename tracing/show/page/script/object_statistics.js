// SPDX-License-Identifier: Apache-2.0
// Statistics of callbacks, topics and threads, from the instances and messages that the page holds.

// Each is computed once.
function computedOf(data) {
  return data.computed ??= {callbacks: new Map(), topics: new Map(), subscriptions: null};
}

function callbackStatistics(data, id) {
  const computed = computedOf(data);
  if (!computed.callbacks.has(id)) {
    const list = data.instancesOf(id);
    const {start, end, finished} = data.instances;
    const starts = Float64Array.from(list, i => start[i]);
    const ended = list.filter(finished);
    const times = Float64Array.from(ended, i => start[i]);
    const values = Float64Array.from(ended, i => end[i] - start[i]);
    const between = intervals(starts);
    const {period} = data.callbacks[id];
    const jitter = period > 0 ? summary(between.map(gap => Math.abs(gap - period))).p99 : NaN;
    computed.callbacks.set(id, {id, count: list.length, unfinished: list.length - ended.length, starts, times, values,
      durations: summary(values), between, gaps: summary(between), jitter, rate: rateOf(starts.length, starts[0], starts[starts.length - 1], data.duration)});
  }
  return computed.callbacks.get(id);
}

// Latencies are from the publication to the start of the callback. A message that several subscriptions take has several.
function topicStatistics(data) {
  const computed = computedOf(data);
  if (computed.topics.size > 0) return [...computed.topics.values()];
  const {messages, instances} = data;
  const topics = data.topics.map((name, id) => ({id, name, publishers: 0, subscriptions: 0, published: 0, taken: 0, missed: 0, isEstimated: false, times: [], values: [], publishedAt: []}));
  for (const end of data.publishers) ++topics[end.topic].publishers;
  for (const end of data.subscriptions) ++topics[end.topic].subscriptions;
  for (let i = 0; i < messages.count; ++i) {
    const topic = topics[topicOf(data, i)];
    if (!topic) continue;
    if (!messages.repeated[i]) {
      ++topic.published;
      topic.publishedAt.push(messages.published[i]);
    }
    if (Number.isNaN(messages.taken[i])) {
      if (topic.subscriptions > 0) ++topic.missed;
      continue;
    }
    ++topic.taken;
    if (messages.to[i] < 0) continue;
    topic.times.push(messages.published[i]);
    topic.values.push(instances.start[messages.to[i]] - messages.published[i]);
  }
  // Of these it is not known whether somebody took them.
  for (const [id, , undecided] of data.estimates) {
    if (id === null) continue;
    topics[id].isEstimated = true;
    topics[id].missed = Math.max(0, topics[id].missed - undecided);
  }
  for (const topic of topics) {
    topic.latency = summary(Float64Array.from(topic.values));
    topic.rate = formatRate(rateOf(topic.published, topic.publishedAt[0], topic.publishedAt[topic.published - 1], data.duration));
    topic.between = intervals(topic.publishedAt);
    computed.topics.set(topic.id, topic);
  }
  return topics;
}

// How much of the time between its first and its last callback a thread was in callbacks.
function threadUse(data, thread) {
  const list = data.instancesIn(thread);
  if (list.length < 2) return {count: list.length, busy: 0, share: 0};
  const {start, end} = data.instances;
  let [busy, until] = [0, -Infinity];
  for (const i of list) {
    busy += Math.max(0, end[i] - Math.max(start[i], until));  // callbacks within callbacks count once
    until = Math.max(until, end[i]);
  }
  return {count: list.length, busy, share: busy / (until - start[list[0]])};
}
