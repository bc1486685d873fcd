// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/objects.hpp"

#include "tracing/model/objects/callback_symbol.hpp"

namespace tracing::timeline {

namespace {

Callback callback_of(const CallbackObject& object, const ObjectModel& objects) {
  using From = CallbackObject::Owner;
  using To = CallbackResult::Owner;
  Callback callback;
  callback.process = object.process;
  callback.address = object.address;
  callback.symbol = readable_symbol(object.symbol);
  const ObjectId subscription = objects.subscription_of(object);
  if (subscription != kNoObject) {
    callback.owner = To::kSubscription;
    callback.node = objects.subscriptions()[subscription].node;
    callback.topic = objects.subscriptions()[subscription].topic;
  } else if (object.owner == From::kTimer && object.owner_id != kNoObject) {
    callback.owner = To::kTimer;
    callback.node = objects.timers()[object.owner_id].node;
    callback.period_ns = objects.timers()[object.owner_id].period_ns;
  } else if (object.owner == From::kService && object.owner_id != kNoObject) {
    callback.owner = To::kService;
    callback.node = objects.services()[object.owner_id].node;
    callback.service = objects.services()[object.owner_id].name;
  } else if (object.owner == From::kClient) {
    callback.owner = To::kClient;
    if (object.owner_id != kNoObject) {
      callback.node = objects.clients()[object.owner_id].node;
      callback.service = objects.clients()[object.owner_id].name;
    }
  }
  return callback;
}

}  // namespace

void copy_objects(const TraceAnalysis& analysis, Timeline& timeline) {
  const ObjectModel& objects = analysis.objects();
  const std::vector<std::optional<ProcessIndex>> places = analysis.places();
  for (std::size_t id = 0; id < analysis.processes().size(); ++id) {
    const ProcessObject& process = analysis.processes()[id];
    timeline.processes.push_back({process.vpid.value_or(0), process.name, process.host, places[id]});
  }
  for (const NodeObject& node : objects.nodes()) {
    timeline.nodes.push_back({node.process, node.name});
  }
  for (const TopicObject& topic : objects.topics()) {
    timeline.topics.push_back(topic.name);
  }
  for (const EndpointObject& end : objects.publishers()) {
    timeline.publishers.push_back({end.node, end.topic});
  }
  for (const EndpointObject& end : objects.subscriptions()) {
    timeline.subscriptions.push_back({end.node, end.topic});
  }
  for (const CallbackObject& object : objects.callbacks()) {
    timeline.callbacks.push_back(callback_of(object, objects));
  }
}

}  // namespace tracing::timeline
