// SPDX-License-Identifier: Apache-2.0
#include "transmission.hpp"

#include <algorithm>
#include <chrono>

namespace reference_system {

namespace {

using reference_interfaces::msg::TransmissionStats;

std::string name_of(const TransmissionStats& stats) {
  const auto end = std::find(stats.node_name.begin(), stats.node_name.end(), 0);
  return {stats.node_name.begin(), end};
}

bool has(const Message& message, const TransmissionStats& stats) {
  const auto end = message.stats.begin() + static_cast<std::ptrdiff_t>(message.size);
  return std::any_of(message.stats.begin(), end,
                     [&stats](const TransmissionStats& other) { return other.node_name == stats.node_name; });
}

}  // namespace

int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void merge_history(const Message& from, Message& to) {
  for (size_t i = 0; i < number_of_nodes(from) && to.size < to.stats.size(); ++i) {
    if (!has(to, from.stats[i])) {
      to.stats[to.size++] = from.stats[i];
    }
  }
}

void sign(const std::string& node_name, uint32_t sequence_number, uint32_t dropped_samples, Message& message) {
  if (message.size == message.stats.size()) {
    return;
  }
  TransmissionStats& stats = message.stats[message.size++];
  stats.node_name = {};
  std::copy_n(node_name.begin(), std::min(node_name.size(), stats.node_name.size()), stats.node_name.begin());
  stats.sequence_number = sequence_number;
  stats.dropped_samples = dropped_samples;
  stats.timestamp = static_cast<uint64_t>(now());
}

size_t number_of_nodes(const Message& message) {
  return std::min<uint64_t>(message.size, message.stats.size());
}

void TravelTimes::add(const Message& message) {
  const int64_t arrival = now();
  for (size_t i = 0; i < number_of_nodes(message); ++i) {
    const TransmissionStats& stats = message.stats[i];
    const int64_t travelled = arrival - static_cast<int64_t>(stats.timestamp);
    Time& time = times_[name_of(stats)];
    time.min_ns = time.count == 0 ? travelled : std::min(time.min_ns, travelled);
    time.max_ns = std::max(time.max_ns, travelled);
    time.sum_ns += static_cast<double>(travelled);
    time.dropped = stats.dropped_samples;
    ++time.count;
  }
}

}  // namespace reference_system
