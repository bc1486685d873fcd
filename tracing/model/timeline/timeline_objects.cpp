// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/timeline_objects.hpp"

#include <optional>
#include <vector>

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
    callback.owner_id = subscription;
    callback.node = objects.subscriptions()[subscription].node;
    callback.topic = objects.subscriptions()[subscription].topic;
  } else if (object.owner == From::kTimer && object.owner_id != kNoObject) {
    callback.owner = To::kTimer;
    callback.owner_id = object.owner_id;
    callback.node = objects.timers()[object.owner_id].node;
    callback.period_ns = objects.timers()[object.owner_id].period_ns;
  } else if (object.owner == From::kService && object.owner_id != kNoObject) {
    callback.owner = To::kService;
    callback.owner_id = object.owner_id;
    callback.node = objects.services()[object.owner_id].node;
    callback.service = objects.services()[object.owner_id].name;
  } else if (object.owner == From::kClient) {
    callback.owner = To::kClient;
    if (object.owner_id != kNoObject) {
      callback.owner_id = object.owner_id;
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
  for (ProcessId id = 0; id < analysis.processes().size(); ++id) {
    const ProcessObject& process = analysis.processes()[id];
    timeline.processes.push_back({process.vpid.value_or(0), process.name, analysis.host_of(id), places[id]});
  }
  for (const NodeObject& node : objects.nodes()) {
    timeline.nodes.push_back({node.process, node.name});
  }
  for (const TopicObject& topic : objects.topics()) {
    timeline.topics.push_back(topic.name);
  }
  for (const EndpointObject& end : objects.publishers()) {
    timeline.publishers.push_back({end.node, end.topic, end.queue_depth, end.qos});
  }
  for (const EndpointObject& end : objects.subscriptions()) {
    timeline.subscriptions.push_back({end.node, end.topic, end.queue_depth, end.qos});
  }
  for (const auto& [publisher, subscriptions] : analysis.chains().links()) {
    for (const ObjectId subscription : subscriptions) {
      timeline.kept.push_back({publisher, subscription});
    }
  }
  for (const TimerObject& timer : objects.timers()) {
    timeline.timers.push_back({timer.node, timer.period_ns});
  }
  for (const ServiceObject& service : objects.services()) {
    timeline.services.push_back({service.node, service.name});
  }
  for (const ClientObject& client : objects.clients()) {
    timeline.clients.push_back({client.node, client.name});
  }
  const CallbackGroups& groups = analysis.groups();
  for (const ExecutorObject& executor : groups.executors()) {
    timeline.executors.push_back({executor.process, executor.address, executor.kind});
  }
  for (const GroupObject& group : groups.groups()) {
    timeline.callback_groups.push_back({group.executor, group.kind});
  }
  for (const ::tracing::SimulatedTime& time : groups.simulated_times()) {
    timeline.simulated_times.push_back({time.time_ns, time.simulated_ns});
  }
  for (const CallbackObject& object : objects.callbacks()) {
    timeline.callbacks.push_back(callback_of(object, objects));
    timeline.callbacks.back().group = groups.group_of(object);
  }
}

}  // namespace tracing::timeline
