// SPDX-License-Identifier: Apache-2.0
// Recordings made by hand: what ran when in which thread.
#pragma once

#include <string>

#include "tracing/model/twin/recording.hpp"

namespace tracing::twin::testing {

struct HandRecording {
  using Owner = CallbackResult::Owner;

  timeline::Index add_process() {
    recording.timeline.processes.push_back({100, "process", "", std::nullopt});
    return static_cast<timeline::Index>(recording.timeline.processes.size() - 1);
  }
  timeline::Index add_node(const std::string& name, timeline::Index process = 0) {
    recording.timeline.nodes.push_back({process, name});
    return static_cast<timeline::Index>(recording.timeline.nodes.size() - 1);
  }
  timeline::Index add_thread(std::int64_t vtid, timeline::Index process = 0) {
    recording.timeline.threads.push_back({process, vtid});
    return static_cast<timeline::Index>(recording.timeline.threads.size() - 1);
  }
  timeline::Index add_timer(timeline::Index node, std::int64_t period_ns = 100) {
    timeline::Callback callback;
    callback.process = recording.timeline.nodes[node].process;
    callback.node = node;
    callback.owner = Owner::kTimer;
    callback.period_ns = period_ns;
    recording.timeline.callbacks.push_back(callback);
    return static_cast<timeline::Index>(recording.timeline.callbacks.size() - 1);
  }
  timeline::Index add_subscription(timeline::Index node, const std::string& topic) {
    recording.timeline.topics.push_back(topic);
    const timeline::Index callback = add_timer(node);
    recording.timeline.callbacks[callback].owner = Owner::kSubscription;
    recording.timeline.callbacks[callback].topic = static_cast<timeline::Index>(recording.timeline.topics.size() - 1);
    recording.timeline.callbacks[callback].owner_id =
        static_cast<timeline::Index>(recording.timeline.subscriptions.size());
    recording.timeline.subscriptions.push_back({node, recording.timeline.callbacks[callback].topic});
    recording.subscriptions.push_back({5, false, false});
    return callback;
  }
  // To be called in the order of starts.
  timeline::Index run(timeline::Index callback, timeline::Index thread, std::int64_t start_ns, std::int64_t end_ns) {
    timeline::Instance instance;
    instance.start_ns = start_ns;
    instance.end_ns = end_ns;
    instance.callback = callback;
    instance.thread = thread;
    instance.finished = true;
    recording.timeline.instances.push_back(instance);
    recording.timeline.end_ns = std::max(recording.timeline.end_ns, end_ns);
    return static_cast<timeline::Index>(recording.timeline.instances.size() - 1);
  }
  // A message that led to the run.
  void send(std::int64_t published_ns, timeline::Index instance, timeline::Index publisher = timeline::kNone) {
    timeline::Message message;
    message.published_ns = published_ns;
    message.publisher = publisher;
    message.receiving_instance = instance;
    recording.timeline.messages.push_back(message);
  }
  void wait(std::int64_t vtid, std::int64_t begin_ns, std::int64_t end_ns, ProcessId process = 0) {
    recording.waits.push_back({{process, vtid}, begin_ns, end_ns});
    recording.looks.push_back({{process, vtid}, 1});
  }

  Recording recording;
};

}  // namespace tracing::twin::testing
