// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/figures.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace tracing::twin {

std::string hop_name(const std::string& publisher, const std::string& callback) {
  return publisher + " to " + callback;
}

std::string call_name(const std::string& client, const std::string& service) {
  return client + " calls " + service;
}

std::int64_t begin_of_figures(const timeline::Timeline& timeline) {
  std::vector<std::vector<std::int64_t>> starts(timeline.callbacks.size());
  std::int64_t begin_ns = timeline.end_ns;
  std::int64_t end_ns = timeline.begin_ns;
  for (const timeline::Instance& instance : timeline.instances) {
    starts[instance.callback].push_back(instance.start_ns);
    begin_ns = std::min(begin_ns, instance.start_ns);
    end_ns = std::max(end_ns, instance.start_ns);
  }
  std::erase_if(starts, [](const auto& of) { return of.size() < kEnoughRuns; });
  std::int64_t up_ns = begin_ns;
  for (const std::vector<std::int64_t>& of : starts) {
    if (const std::int64_t first_ns = *std::min_element(of.begin(), of.end());
        first_ns < begin_ns + (end_ns - begin_ns) / 2) {
      up_ns = std::max(up_ns, first_ns);
    }
  }
  const auto has_enough = [&](const std::vector<std::int64_t>& of) {
    return std::count_if(of.begin(), of.end(), [&](std::int64_t start_ns) { return start_ns >= up_ns; }) >=
           static_cast<std::ptrdiff_t>(kEnoughRuns);
  };
  return std::all_of(starts.begin(), starts.end(), has_enough) ? up_ns : begin_ns;
}

Figures figures_of(const Recording& recording, const System& twin) {
  const timeline::Timeline& timeline = recording.timeline;
  std::set<std::string> known;
  for (const Callback& callback : twin.callbacks) {
    known.insert(callback.name);
  }
  std::set<std::string> services;
  for (const Client& client : twin.clients) {
    services.insert(client.service);
  }
  const std::vector<std::string> names = callback_names(timeline);
  const std::int64_t up_ns = begin_of_figures(timeline);
  Figures figures;
  for (const timeline::Instance& instance : timeline.instances) {
    if (instance.start_ns >= up_ns && instance.finished && known.contains(names[instance.callback])) {
      figures[{FigureKind::kCallback, names[instance.callback]}].push_back(instance.end_ns - instance.start_ns);
    }
  }
  for (const timeline::Message& message : timeline.messages) {
    if (message.published_ns < up_ns || message.receiving_instance == timeline::kNone ||
        message.publisher == timeline::kNone) {
      continue;
    }
    const timeline::Instance& instance = timeline.instances[message.receiving_instance];
    const timeline::Index node = timeline.publishers[message.publisher].node;
    const std::int64_t way = instance.start_ns - message.published_ns;
    if (node != timeline::kNone && way >= 0 && known.contains(names[instance.callback])) {
      figures[{FigureKind::kHop, hop_name(timeline.nodes[node].name, names[instance.callback])}].push_back(way);
    }
  }
  for (const ServiceCall& call : recording.calls) {
    if (call.sent_ns < up_ns || call.client == kNoObject || call.received_ns < call.sent_ns) {
      continue;
    }
    const Recording::Named& client = recording.clients[call.client];
    if (client.node != timeline::kNone && services.contains(client.name)) {
      figures[{FigureKind::kCall, call_name(timeline.nodes[client.node].name, client.name)}].push_back(
          call.received_ns - call.sent_ns);
    }
  }
  return figures;
}

FigureSummary summary_of(const std::vector<std::int64_t>& values) {
  if (values.empty()) {
    return {};
  }
  std::vector<std::int64_t> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto rank = [&](double part) {
    const auto at = static_cast<std::size_t>(std::ceil(part * static_cast<double>(sorted.size())));
    return sorted[std::clamp<std::size_t>(at, 1, sorted.size()) - 1];
  };
  return {sorted.size(), rank(0.5), rank(0.99)};
}

}  // namespace tracing::twin
