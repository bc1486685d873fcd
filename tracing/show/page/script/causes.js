// SPDX-License-Identifier: Apache-2.0
// What caused what: a callback publishes because of the message that it got, and, if its node keeps messages and has said so,
// because of the last one of each subscription.

// The callback that gets the messages of a subscription, found by an instance that got one.
function callbackOfSubscription(data, subscription) {
  const computed = computedOf(data);
  if (!computed.receivers) {
    const {messages, instances} = data;
    computed.receivers = new Map();
    for (let i = 0; i < messages.count; ++i) {
      if (messages.to[i] >= 0 && !computed.receivers.has(messages.subscription[i])) computed.receivers.set(messages.subscription[i], instances.callback[messages.to[i]]);
    }
  }
  return computed.receivers.get(subscription) ?? -1;
}

// The callbacks whose last messages a publisher uses; the publishers that use the last message of a callback.
function keptFor(data, publisher) {
  return keptMessages(data).callbacksOf.get(publisher) ?? [];
}

function usersOf(data, callback) {
  return keptMessages(data).publishersOf.get(callback) ?? [];
}

function keptMessages(data) {
  const computed = computedOf(data);
  if (computed.kept) return computed.kept;
  computed.kept = {callbacksOf: new Map(), publishersOf: new Map(), sentBy: data.kept.length ? group(data.messages.publisher, data.messages.count, data.publishers.length) : null};
  const add = (map, key, value) => map.has(key) ? map.get(key).push(value) : map.set(key, [value]);
  for (const [publisher, subscription] of data.kept) {
    const callback = callbackOfSubscription(data, subscription);
    if (callback < 0) continue;
    add(computed.kept.callbacksOf, publisher, callback);
    add(computed.kept.publishersOf, callback, publisher);
  }
  return computed.kept;
}

// The last instance of a callback that began before a time, or -1.
function lastBefore(data, callback, time) {
  const list = data.instancesOf(callback);
  const {start} = data.instances;
  let [low, high] = [0, list.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (start[list[middle]] < time) low = middle + 1;
    else high = middle;
  }
  return low > 0 ? list[low - 1] : -1;
}

// The instances that caused a publication: the one that published it first, then those whose messages were kept.
function causesOf(data, message) {
  const {messages} = data;
  const causes = messages.from[message] >= 0 ? [messages.from[message]] : [];
  for (const callback of keptFor(data, messages.publisher[message])) {
    const instance = lastBefore(data, callback, messages.published[message]);
    if (instance >= 0 && !causes.includes(instance)) causes.push(instance);
  }
  return causes;
}

// The messages that an instance did not publish itself, but whose publishers used what it had kept.
function sentLater(data, instance) {
  const {instances, messages} = data;
  const users = usersOf(data, instances.callback[instance]);
  if (users.length === 0) return [];
  const list = data.instancesOf(instances.callback[instance]);
  const next = list[lowerBound(list, instance) + 1];
  const until = next === undefined ? Infinity : instances.start[next];
  const {sentBy} = keptMessages(data);
  return users.flatMap(publisher => {
    const sent = sentBy(publisher);
    const found = [];
    let [low, high] = [0, sent.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (messages.published[sent[middle]] <= instances.start[instance]) low = middle + 1;
      else high = middle;
    }
    for (; low < sent.length && messages.published[sent[low]] <= until; ++low) if (messages.from[sent[low]] !== instance) found.push(sent[low]);
    return found;
  });
}
