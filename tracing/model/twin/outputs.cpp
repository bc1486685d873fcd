// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/outputs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace tracing::twin {

namespace {

// A rule holds if it tells this part of the runs right.
constexpr double kHolds = 0.95;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// The runs of some callbacks, in the order of their starts, and whether they have sent.
struct Step {
  timeline::Index callback = timeline::kNone;
  bool sent = false;
};

bool is_join(const std::vector<Step>& steps, const std::set<timeline::Index>& inputs) {
  if (inputs.size() < 2) {
    return false;
  }
  std::set<timeline::Index> seen;
  std::size_t right = 0;
  std::size_t sent = 0;
  for (const Step& step : steps) {
    seen.insert(step.callback);
    const bool is_complete = seen.size() == inputs.size();
    right += is_complete == step.sent ? 1 : 0;
    sent += step.sent ? 1 : 0;
    // What is sent too early or too late begins anew, so one lost message spoils one run and not the rest.
    if (is_complete || step.sent) {
      seen.clear();
    }
  }
  return sent >= 2 && static_cast<double>(right) >= kHolds * static_cast<double>(steps.size());
}

struct Senders {
  std::map<timeline::Index, std::vector<const Sending*>> by_callback;
  std::map<timeline::Index, std::size_t> by_instance;  // how many
};

Senders senders_of(const Recording& recording, const std::vector<Sending>& sendings) {
  Senders senders;
  for (const Sending& sending : sendings) {
    if (sending.instance != timeline::kNone) {
      senders.by_callback[recording.timeline.instances[sending.instance].callback].push_back(&sending);
      ++senders.by_instance[sending.instance];
    }
  }
  return senders;
}

std::vector<Step> steps_of(const Recording& recording, const Senders& senders,
                           const std::set<timeline::Index>& callbacks) {
  std::vector<Step> steps;
  for (timeline::Index index = 0; index < recording.timeline.instances.size(); ++index) {
    const timeline::Instance& instance = recording.timeline.instances[index];
    if (callbacks.contains(instance.callback)) {
      steps.push_back({instance.callback, senders.by_instance.contains(index)});
    }
  }
  return steps;
}

// The callbacks whose messages a sender waits for: those that send, or all subscriptions of their node.
std::set<timeline::Index> join_of(const Recording& recording, const Senders& senders) {
  std::set<timeline::Index> sending;
  for (const auto& [callback, list] : senders.by_callback) {
    if (recording.timeline.callbacks[callback].owner != CallbackResult::Owner::kSubscription) {
      return {};
    }
    sending.insert(callback);
  }
  if (sending.empty()) {
    return {};
  }
  if (is_join(steps_of(recording, senders, sending), sending)) {
    return sending;
  }
  std::set<timeline::Index> all;
  const timeline::Index node = recording.timeline.callbacks[*sending.begin()].node;
  for (timeline::Index index = 0; index < recording.timeline.callbacks.size(); ++index) {
    const timeline::Callback& callback = recording.timeline.callbacks[index];
    if (callback.node == node && callback.owner == CallbackResult::Owner::kSubscription) {
      all.insert(index);
    }
  }
  const std::vector<Step> steps = steps_of(recording, senders, all);
  std::set<timeline::Index> ran;
  for (const Step& step : steps) {
    ran.insert(step.callback);
  }
  return is_join(steps, ran) ? ran : std::set<timeline::Index>();
}

// How far the run was, at the median of the sendings.
void set_places(const Recording& recording, const std::vector<const Sending*>& sendings, Output& output) {
  std::vector<double> called;
  std::vector<double> sent;
  for (const Sending* sending : sendings) {
    const timeline::Instance& instance = recording.timeline.instances[sending->instance];
    if (const auto length = static_cast<double>(instance.end_ns - instance.start_ns); length > 0) {
      called.push_back(static_cast<double>(sending->called_ns - instance.start_ns) / length);
      sent.push_back(static_cast<double>(sending->sent_ns - instance.start_ns) / length);
    }
  }
  if (!called.empty()) {
    output.called = std::clamp(median(std::move(called)), 0.0, 1.0);
    output.sent = std::clamp(median(std::move(sent)), 0.0, 1.0);
  }
}

void set_rule(const std::vector<Step>& runs, std::size_t messages, Output& output) {
  const auto sent =
      static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const Step& run) { return run.sent; }));
  if (sent == 0) {
    output.rule = Output::Rule::kChance;
    output.chance = 0;
    return;
  }
  output.times = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(static_cast<double>(messages) / static_cast<double>(sent))));
  if (static_cast<double>(sent) >= 0.98 * static_cast<double>(runs.size())) {
    return;
  }
  const auto every =
      static_cast<std::size_t>(std::lround(static_cast<double>(runs.size()) / static_cast<double>(sent)));
  std::size_t regular = 0;
  std::size_t gap = 0;
  for (const Step& run : runs) {
    ++gap;
    if (run.sent) {
      regular += gap == every ? 1 : 0;
      gap = 0;
    }
  }
  if (every >= 2 && static_cast<double>(regular) >= kHolds * static_cast<double>(sent)) {
    output.rule = Output::Rule::kEvery;
    output.every = every;
    return;
  }
  output.rule = Output::Rule::kChance;
  output.chance = static_cast<double>(sent) / static_cast<double>(runs.size());
}

}  // namespace

std::map<timeline::Index, std::vector<Sending>> publications_of(const Recording& recording) {
  std::map<timeline::Index, std::vector<Sending>> publications;
  for (const timeline::Message& message : recording.timeline.messages) {
    if (!message.repeated && message.publisher != timeline::kNone) {
      publications[message.publisher].push_back({message.called_ns, message.published_ns, message.publishing_instance});
    }
  }
  return publications;
}

std::map<timeline::Index, std::vector<Sending>> requests_of(const Recording& recording) {
  // A request names no thread, so it is one of the callback of its node that ran at this time.
  std::map<timeline::Index, std::vector<timeline::Index>> by_node;
  for (timeline::Index index = 0; index < recording.timeline.instances.size(); ++index) {
    by_node[recording.timeline.callbacks[recording.timeline.instances[index].callback].node].push_back(index);
  }
  std::map<timeline::Index, std::vector<Sending>> requests;
  for (const ServiceCall& call : recording.calls) {
    if (call.client == kNoObject || call.client >= recording.clients.size() || call.sent_ns == 0) {
      continue;
    }
    Sending sending{call.sent_ns, call.sent_ns, timeline::kNone};
    const auto instances = by_node.find(recording.clients[call.client].node);
    if (instances != by_node.end()) {
      const auto behind = std::upper_bound(instances->second.begin(), instances->second.end(), call.sent_ns,
                                           [&](std::int64_t time, timeline::Index index) {
                                             return time < recording.timeline.instances[index].start_ns;
                                           });
      if (behind != instances->second.begin() && recording.timeline.instances[*(behind - 1)].end_ns >= call.sent_ns) {
        sending.instance = *(behind - 1);
      }
    }
    requests[call.client].push_back(sending);
  }
  return requests;
}

std::map<timeline::Index, Output> outputs_of(const Recording& recording, const std::vector<Sending>& sendings) {
  const Senders senders = senders_of(recording, sendings);
  std::map<timeline::Index, Output> outputs;
  bool needs_join = false;
  for (const auto& [callback, list] : senders.by_callback) {
    Output output;
    set_places(recording, list, output);
    set_rule(steps_of(recording, senders, {callback}), list.size(), output);
    needs_join = needs_join || output.rule != Output::Rule::kAlways;
    outputs[callback] = output;
  }
  const std::set<timeline::Index> join = needs_join ? join_of(recording, senders) : std::set<timeline::Index>();
  if (join.empty()) {
    return outputs;
  }
  const Output any = outputs.begin()->second;
  for (const timeline::Index callback : join) {
    Output& output = outputs.try_emplace(callback, any).first->second;
    output.rule = Output::Rule::kJoin;
    output.inputs.assign(join.begin(), join.end());
  }
  return outputs;
}

}  // namespace tracing::twin
