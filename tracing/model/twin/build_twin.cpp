// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/build_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "tracing/model/twin/delays.hpp"
#include "tracing/model/twin/executors.hpp"
#include "tracing/model/twin/figures.hpp"
#include "tracing/model/twin/outputs.hpp"
#include "tracing/model/twin/recorded_names.hpp"
#include "tracing/model/twin/run_times.hpp"

namespace tracing::twin {

namespace {

class Builder {
 public:
  Builder(const Recording& recording, const BuildOptions& options)
      : recording_(recording),
        timeline_(recording.timeline),
        options_(options),
        found_(find_executors(recording)),
        names_(callback_names(recording.timeline)) {
    system_.duration_ns = timeline_.end_ns - timeline_.begin_ns;
    system_.cpus = std::max<std::size_t>(1, options.cpus);
    system_.seed = options.seed;
  }

  System build() {
    system_.processor_times = !timeline_.states.empty();
    add_nodes();
    add_executors();
    add_ends();
    add_callbacks();
    for (const auto& [publisher, sendings] : publications_of(recording_)) {
      add_outputs(publisher_of_[publisher], kNone, sendings);
    }
    for (const auto& [client, sendings] : requests_of(recording_)) {
      add_outputs(kNone, client_of_[client], sendings);
    }
    finish_phases();
    name_assumptions();
    return std::move(system_);
  }

 private:
  void miss(std::string sentence) { system_.missing.push_back(std::move(sentence)); }

  void add_nodes() {
    std::vector<Index> process_of(timeline_.processes.size(), kNone);
    std::set<std::string> names;
    node_of_.assign(timeline_.nodes.size(), kNone);
    for (std::size_t index = 0; index < timeline_.nodes.size(); ++index) {
      const timeline::Node& node = timeline_.nodes[index];
      if (node.process == timeline::kNone || is_hidden(node.name)) {
        continue;
      }
      if (!names.insert(node.name).second) {
        miss(fmt::format("{} was there several times, one after the other or at once: the twin has its first one",
                         node.name));
        continue;
      }
      Index& process = process_of[node.process];
      if (process == kNone) {
        process = system_.processes.size();
        system_.processes.push_back({timeline_.processes[node.process].name});
      }
      node_of_[index] = system_.nodes.size();
      system_.nodes.push_back({process, node.name, false});
    }
    process_of_ = std::move(process_of);
  }

  void add_executors() {
    executor_of_.assign(found_.executors.size(), kNone);
    for (std::size_t index = 0; index < found_.executors.size(); ++index) {
      const FoundExecutor& found = found_.executors[index];
      if (found.process == timeline::kNone || process_of_[found.process] == kNone) {
        continue;
      }
      executor_of_[index] = system_.executors.size();
      const bool is_multi = found.threads.size() > 1 || found.recorded_kind == "multi_threaded_executor";
      const bool is_single = found.waits || !found.recorded_kind.empty();
      const Executor::Kind kind = is_multi    ? Executor::Kind::kMulti
                                  : is_single ? Executor::Kind::kSingle
                                              : Executor::Kind::kEvents;
      system_.executors.push_back({process_of_[found.process], kind, found.threads.size(), 0});
    }
    for (std::size_t process = 0; process < system_.processes.size(); ++process) {
      if (std::none_of(system_.executors.begin(), system_.executors.end(),
                       [&](const Executor& executor) { return executor.process == process; })) {
        system_.executors.push_back({process, Executor::Kind::kSingle, 1, 0});
      }
    }
    for (const FoundGroup& found : found_.groups) {
      const Index node = node_of_[found.node];
      const Index executor = executor_of_[found.executor];
      group_of_.push_back(node == kNone || executor == kNone ? kNone : add_group({node, executor, found.reentrant}));
    }
  }

  Index add_group(const Group& group) {
    system_.groups.push_back(group);
    return system_.groups.size() - 1;
  }

  Index executor_of_node(Index node) const {
    for (const Group& group : system_.groups) {
      if (group.node == node) {
        return group.executor;
      }
    }
    const auto found = std::find_if(system_.executors.begin(), system_.executors.end(), [&](const Executor& executor) {
      return executor.process == system_.nodes[node].process;
    });
    return static_cast<Index>(found - system_.executors.begin());
  }

  // For a callback that never ran.
  Index any_group(Index node) {
    for (Index index = 0; index < system_.groups.size(); ++index) {
      if (system_.groups[index].node == node) {
        return index;
      }
    }
    return add_group({node, executor_of_node(node), false});
  }

  Index topic_of(timeline::Index topic) {
    const std::string& name = timeline_.topics[topic];
    for (Index index = 0; index < system_.topics.size(); ++index) {
      if (system_.topics[index].name == name) {
        return index;
      }
    }
    const auto size = options_.sizes.find(name);
    system_.topics.push_back({name, size == options_.sizes.end() ? options_.bytes : size->second});
    return system_.topics.size() - 1;
  }

  Index node_of(timeline::Index node) const { return node == timeline::kNone ? kNone : node_of_[node]; }

  void add_ends() {
    publisher_of_.assign(timeline_.publishers.size(), kNone);
    for (std::size_t index = 0; index < timeline_.publishers.size(); ++index) {
      const timeline::Endpoint& end = timeline_.publishers[index];
      const std::string name = end.topic == timeline::kNone ? "" : timeline_.topics[end.topic];
      if (node_of(end.node) == kNone || name.empty() || is_own_topic(name)) {
        continue;
      }
      if (is_hidden(name)) {
        note_action(name);
        continue;
      }
      const Recording::Endpoint& qos = recording_.publishers[index];
      publisher_of_[index] = system_.publishers.size();
      system_.publishers.push_back({node_of(end.node), topic_of(end.topic), {qos.reliable, qos.depth}});
    }
    client_of_.assign(recording_.clients.size(), kNone);
    for (std::size_t index = 0; index < recording_.clients.size(); ++index) {
      const Recording::Named& client = recording_.clients[index];
      if (node_of(client.node) != kNone && !is_own_service(client.name) && !is_hidden(client.name)) {
        client_of_[index] = system_.clients.size();
        system_.clients.push_back({node_of(client.node), client.name});
      }
    }
  }

  void note_action(const std::string& name) {
    if (is_of_action(name)) {
      actions_.insert(name.substr(0, name.find("/_action/")));
    }
  }

  // Whether the twin has this callback. Sets what depends on the kind.
  bool set_kind(const timeline::Callback& recorded, Callback& callback) {
    const Index node = node_of(recorded.node);
    switch (recorded.owner) {
      case CallbackResult::Owner::kTimer:
        callback.kind = Callback::Kind::kTimer;
        callback.period_ns = recorded.period_ns;
        return recorded.period_ns > 0;
      case CallbackResult::Owner::kSubscription: {
        const std::string name = recorded.topic == timeline::kNone ? "" : timeline_.topics[recorded.topic];
        if (name.empty() || is_own_topic(name) || is_hidden(name)) {
          note_action(name);
          return false;
        }
        callback.kind = Callback::Kind::kSubscription;
        callback.topic = topic_of(recorded.topic);
        for (std::size_t index = 0; index < timeline_.subscriptions.size(); ++index) {
          const timeline::Endpoint& end = timeline_.subscriptions[index];
          if (end.node == recorded.node && end.topic == recorded.topic) {
            const Recording::Endpoint& qos = recording_.subscriptions[index];
            callback.qos = {qos.reliable, qos.depth};
            if (qos.is_filtered) {
              miss(fmt::format("{} filters its messages by content; its stand-in gets all of them", callback.name));
            }
            break;
          }
        }
        return true;
      }
      case CallbackResult::Owner::kService:
        note_action(recorded.service);
        callback.kind = Callback::Kind::kService;
        callback.service = recorded.service;
        return !recorded.service.empty() && !is_own_service(recorded.service) && !is_hidden(recorded.service);
      case CallbackResult::Owner::kClient:
        callback.kind = Callback::Kind::kClient;
        for (Index index = 0; index < system_.clients.size(); ++index) {
          if (system_.clients[index].node == node && system_.clients[index].service == recorded.service) {
            callback.client = index;
          }
        }
        return callback.client != kNone;
      case CallbackResult::Owner::kUnknown:
        break;
    }
    return false;
  }

  void add_callbacks() {
    const RunTimes runs(recording_);
    const std::vector<WayTimes> ways = way_times(recording_, found_, runs);
    callback_of_.assign(timeline_.callbacks.size(), kNone);
    for (std::size_t index = 0; index < timeline_.callbacks.size(); ++index) {
      const timeline::Callback& recorded = timeline_.callbacks[index];
      Callback callback;
      callback.name = names_[index];
      if (node_of(recorded.node) == kNone || !set_kind(recorded, callback)) {
        if (recorded.owner == CallbackResult::Owner::kUnknown && runs.count(index) > 0) {
          miss(fmt::format("a callback whose creation is not in the trace ran {} times", runs.count(index)));
        }
        continue;
      }
      const std::size_t group = found_.group_of[index];
      callback.group = group == FoundExecutors::kNone ? kNone : group_of_[group];
      if (callback.group == kNone) {
        callback.group = any_group(node_of(recorded.node));
      }
      callback.runs = runs.count(index);
      callback.run_times = runs.sending(index);
      callback.silent_run_times = runs.silent(index);
      callback.blocked = runs.blocked(index);
      callback.delays = ways[index].delays;
      callback.near_delays = ways[index].near_delays;
      callback.gaps = ways[index].gaps;
      callback.ways = ways[index].ways;
      callback.phase_ns = runs.first_due_ns(index, recorded.period_ns) - timeline_.begin_ns;  // of a timer
      Node& node = system_.nodes[node_of(recorded.node)];
      node.intra_process = node.intra_process || runs.has_intra_process(index);
      callback_of_[index] = system_.callbacks.size();
      system_.callbacks.push_back(std::move(callback));
    }
    for (const timeline::Message& message : timeline_.messages) {
      if (message.receiving_instance != timeline::kNone && message.publisher != timeline::kNone &&
          timeline_.instances[message.receiving_instance].intra_process) {
        const Index node = node_of(timeline_.publishers[message.publisher].node);
        if (node != kNone) {
          system_.nodes[node].intra_process = true;
        }
      }
    }
    set_call_delays(recording_, client_of_, system_);
  }

  void add_outputs(Index publisher, Index client, const std::vector<Sending>& sendings) {
    if (publisher == kNone && client == kNone) {
      return;
    }
    for (auto& [recorded, output] : outputs_of(recording_, sendings)) {
      const Index callback = callback_of_[recorded];
      if (callback == kNone) {
        continue;
      }
      output.publisher = publisher;
      output.client = client;
      std::vector<Index> inputs;
      for (const Index input : output.inputs) {
        if (callback_of_[input] != kNone) {
          inputs.push_back(callback_of_[input]);
        }
      }
      output.inputs = std::move(inputs);
      system_.callbacks[callback].outputs.push_back(output);
    }
    std::vector<std::int64_t> outside;
    for (const Sending& sending : sendings) {
      if (sending.instance == timeline::kNone) {
        outside.push_back(sending.called_ns);
      }
    }
    add_loop(publisher, client, std::move(outside));
  }

  // A timer for what was sent outside of callbacks.
  void add_loop(Index publisher, Index client, std::vector<std::int64_t> times) {
    if (times.empty()) {
      return;
    }
    const Index node = publisher != kNone ? system_.publishers[publisher].node : system_.clients[client].node;
    const std::string what = publisher != kNone
                                 ? "messages on " + system_.topics[system_.publishers[publisher].topic].name
                                 : "requests to " + system_.clients[client].service;
    const std::string name = system_.nodes[node].name;
    // A burst has no rate: what a report says of rates holds here, too.
    const bool is_burst = 10 * (times.back() - times.front()) < timeline_.end_ns - times.front();
    if (times.size() < 3 || is_burst) {
      miss(fmt::format("{} sent {} {} outside of its callbacks; the twin does not", name, times.size(), what));
      return;
    }
    Callback timer;
    timer.period_ns = (times.back() - times.front()) / static_cast<std::int64_t>(times.size() - 1);
    timer.phase_ns = times.front() - timeline_.begin_ns;
    timer.name = fmt::format("{}, loop of {}", name, what);
    timer.replaces_loop = true;
    timer.runs = times.size();
    timer.run_times.values = {0};
    timer.group = add_group({node, executor_of_node(node), false});
    timer.outputs.push_back({.publisher = publisher, .client = client});
    miss(fmt::format("{} sent {} {} outside of its callbacks; a timer of {:.3g} ms stands for that", name, times.size(),
                     what, static_cast<double>(timer.period_ns) / 1e6));
    system_.callbacks.push_back(std::move(timer));
  }

  // Phases count from the earliest first call.
  void finish_phases() {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    for (const Callback& callback : system_.callbacks) {
      if (callback.kind == Callback::Kind::kTimer && callback.runs > 0) {
        first = std::min(first, callback.phase_ns);
      }
    }
    for (Callback& callback : system_.callbacks) {
      callback.phase_ns = callback.kind == Callback::Kind::kTimer && callback.runs > 0 ? callback.phase_ns - first : 0;
    }
    system_.begin_ns = timeline_.begin_ns + (first == std::numeric_limits<std::int64_t>::max() ? 0 : first);
    std::int64_t last = 0;
    for (const timeline::Instance& instance : timeline_.instances) {
      last = std::max(last, instance.end_ns - timeline_.begin_ns);
    }
    system_.active_ns = first < last ? last - first : system_.duration_ns;
    system_.up_ns = std::max<std::int64_t>(0, begin_of_figures(timeline_) - system_.begin_ns);
  }

  void name_assumptions() {
    for (const std::string& action : actions_) {
      miss(fmt::format("the action {} has no stand-in", action));
    }
    if (!timeline_.lifecycle.empty()) {
      miss(fmt::format("{} has lifecycle states; its stand-in is always active",
                       timeline_.nodes[timeline_.lifecycle.front().node].name));
    }
    if (timeline_.states.empty() && !timeline_.instances.empty()) {
      miss(
          "the trace has no events of the kernel's scheduler: what callbacks waited for a processor counts as their "
          "work");
    }
    const auto unknown = std::count_if(system_.topics.begin(), system_.topics.end(),
                                       [&](const Topic& topic) { return !options_.sizes.contains(topic.name); });
    if (unknown > 0) {
      miss(
          fmt::format("a trace does not tell the sizes of messages: those of {} topics have {} bytes (--bytes, --size)",
                      unknown, options_.bytes));
    }
  }

  const Recording& recording_;
  const timeline::Timeline& timeline_;
  const BuildOptions& options_;
  FoundExecutors found_;
  std::vector<std::string> names_;
  System system_;
  // Indices in system_, by index of the recording.
  std::vector<Index> process_of_;
  std::vector<Index> node_of_;
  std::vector<Index> executor_of_;
  std::vector<Index> group_of_;
  std::vector<Index> publisher_of_;
  std::vector<Index> client_of_;
  std::vector<Index> callback_of_;
  std::set<std::string> actions_;
};

}  // namespace

System build_twin(const Recording& recording, const BuildOptions& options) {
  return Builder(recording, options).build();
}

}  // namespace tracing::twin
