// SPDX-License-Identifier: Apache-2.0
// Twins made by hand, with round numbers.
#pragma once

#include <string>

#include "tracing/model/twin/description/twin_system.hpp"

namespace tracing::twin::testing {

inline constexpr std::int64_t kMs = 1'000'000;

// One process with one executor and one node, whose callbacks share a group.
struct SmallSystem {
  SmallSystem() {
    system.cpus = 1;
    system.processes.push_back({"one"});
    system.executors.push_back({0, Executor::Kind::kSingle, 1, 0});
    system.nodes.push_back({0, "/one", false});
    system.groups.push_back({0, 0, false});
  }

  // Another process with its executor, node and group; returns the group.
  Index add_process(const std::string& node) {
    system.processes.push_back({node});
    system.executors.push_back({system.processes.size() - 1, Executor::Kind::kSingle, 1, 0});
    system.nodes.push_back({system.processes.size() - 1, node, false});
    system.groups.push_back({system.nodes.size() - 1, system.executors.size() - 1, false});
    return system.groups.size() - 1;
  }

  Index add_timer(const std::string& name, std::int64_t period_ns, std::int64_t run_ns, Index group = 0) {
    Callback timer;
    timer.name = name;
    timer.group = group;
    timer.period_ns = period_ns;
    timer.runs = 1;
    timer.run_times.values = {run_ns};
    system.callbacks.push_back(timer);
    return system.callbacks.size() - 1;
  }

  Index add_subscription(const std::string& name, Index topic, std::int64_t run_ns, std::int64_t delay_ns,
                         Index group = 0) {
    Callback subscription;
    subscription.kind = Callback::Kind::kSubscription;
    subscription.name = name;
    subscription.group = group;
    subscription.topic = topic;
    subscription.runs = 1;
    subscription.run_times.values = {run_ns};
    subscription.delays.values = {delay_ns};
    system.callbacks.push_back(subscription);
    return system.callbacks.size() - 1;
  }

  // The callback publishes on a topic, at a part of its run.
  Index publish(Index callback, const std::string& topic, double part) {
    system.topics.push_back({topic, 64});
    system.publishers.push_back({system.groups[system.callbacks[callback].group].node, system.topics.size() - 1, {}});
    Output output;
    output.publisher = system.publishers.size() - 1;
    output.called = part;
    output.sent = part;
    system.callbacks[callback].outputs.push_back(output);
    return system.topics.size() - 1;
  }

  System system;
};

}  // namespace tracing::twin::testing
