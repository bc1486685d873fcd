// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing::twin {

namespace {

Recording::Endpoint endpoint_of(const EndpointObject& object) {
  if (!object.qos) {
    return {object.queue_depth, true, false};
  }
  return {object.qos->history_depth, object.qos->reliable, object.qos->is_filtered};
}

std::string name_of(const timeline::Timeline& timeline, const timeline::Callback& callback) {
  const std::string node = callback.node == timeline::kNone ? "" : timeline.nodes[callback.node].name;
  switch (callback.owner) {
    case CallbackResult::Owner::kTimer:
      return timer_name(node, callback.period_ns);
    case CallbackResult::Owner::kSubscription:
      return node + ", subscription " + (callback.topic == timeline::kNone ? "" : timeline.topics[callback.topic]);
    case CallbackResult::Owner::kService:
      return node + ", service " + callback.service;
    case CallbackResult::Owner::kClient:
      return node + ", client " + callback.service;
    case CallbackResult::Owner::kUnknown:
      break;
  }
  return node + ", callback";
}

}  // namespace

std::string timer_name(const std::string& node, std::int64_t period_ns) {
  return fmt::format("{}, timer {:g} ms", node, static_cast<double>(period_ns) / 1e6);
}

std::vector<std::string> callback_names(const timeline::Timeline& timeline) {
  std::vector<std::string> names;
  std::map<std::string, int> uses;
  for (const timeline::Callback& callback : timeline.callbacks) {
    std::string name = name_of(timeline, callback);
    if (const int use = ++uses[name]; use > 1) {
      name += fmt::format(" #{}", use);
    }
    names.push_back(std::move(name));
  }
  return names;
}

void join_callbacks_of_subscriptions(timeline::Timeline& timeline) {
  std::map<timeline::Index, timeline::Index> first;  // by subscription
  std::vector<timeline::Index> joined(timeline.callbacks.size());
  for (timeline::Index index = 0; index < timeline.callbacks.size(); ++index) {
    timeline::Callback& callback = timeline.callbacks[index];
    joined[index] = index;
    if (callback.owner != CallbackResult::Owner::kSubscription || callback.owner_id == timeline::kNone) {
      continue;
    }
    if (const auto [known, is_new] = first.try_emplace(callback.owner_id, index); !is_new) {
      joined[index] = known->second;
      callback.owner = CallbackResult::Owner::kUnknown;
      callback.node = timeline::kNone;
    }
  }
  for (timeline::Instance& instance : timeline.instances) {
    instance.callback = joined[instance.callback];
  }
}

void Recorder::on_executor_wait(const ExecutorWait& wait) {
  recording_.waits.push_back({wait.thread, wait.begin_ns, wait.end_ns});
}

void Recorder::on_executor_look(const ExecutorLook& look) {
  const auto [found, is_new] = looks_.try_emplace(look.thread, recording_.looks.size());
  if (is_new) {
    recording_.looks.push_back({look.thread, 0});
  }
  ++recording_.looks[found->second].looks;
}

Recording Recorder::finish(const TraceAnalysis& analysis, const TraceOverview& overview) {
  recording_.timeline = timeline_.finish(analysis, overview);
  join_callbacks_of_subscriptions(recording_.timeline);
  const ObjectModel& objects = analysis.objects();
  for (const EndpointObject& end : objects.publishers()) {
    recording_.has_ext_events = recording_.has_ext_events || end.qos.has_value();
    recording_.publishers.push_back(endpoint_of(end));
  }
  for (const EndpointObject& end : objects.subscriptions()) {
    recording_.subscriptions.push_back(endpoint_of(end));
  }
  for (const ServiceObject& service : objects.services()) {
    recording_.services.push_back({service.node, service.name});
  }
  for (const ClientObject& client : objects.clients()) {
    recording_.clients.push_back({client.node, client.name});
  }
  std::sort(recording_.waits.begin(), recording_.waits.end(),
            [](const auto& left, const auto& right) { return left.begin_ns < right.begin_ns; });
  std::sort(recording_.calls.begin(), recording_.calls.end(),
            [](const ServiceCall& left, const ServiceCall& right) { return left.sent_ns < right.sent_ns; });
  return std::move(recording_);
}

Recording read_recording(const std::filesystem::path& directory) {
  Recorder recorder;
  TraceAnalysis analysis(&recorder);
  TraceReader(directory).read(analysis);
  const TraceResults results = analysis.finish();
  return recorder.finish(analysis, results.overview);
}

std::size_t processors_of(const std::filesystem::path& directory) {
  std::size_t processors = 0;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    const std::size_t bar = name.rfind('_');
    if (!entry.is_regular_file(ignored) || bar == std::string::npos || bar + 1 == name.size() ||
        name.size() > bar + 5 ||
        !std::all_of(name.begin() + static_cast<std::ptrdiff_t>(bar) + 1, name.end(),
                     [](unsigned char digit) { return std::isdigit(digit) != 0; })) {
      continue;
    }
    processors = std::max<std::size_t>(processors, std::stoul(name.substr(bar + 1)) + 1);
  }
  return processors;
}

}  // namespace tracing::twin
