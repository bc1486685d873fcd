// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/buffer_sizes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

#include "tracing/record/plan/trace_error.hpp"

namespace tracing {

namespace {

// Bytes that gather for a processor while the consumer does not read.
std::uint64_t gathering(const TraceConfig& config, std::size_t nodes, std::size_t processors) {
  const double seconds = config.ust.read_timer / 1e6 + kConsumerDelay;
  const double rate = static_cast<double>(nodes * kEventsPerNode * kBytesPerEvent) /
                      static_cast<double>(std::max<std::size_t>(processors, 1));
  return static_cast<std::uint64_t>(rate * seconds);
}

constexpr std::uint64_t kSmallestFittedSubbuffer = 32768;  // bytes; smaller ones lose events at start-up

}  // namespace

std::uint64_t sufficient_subbuffer_size(const TraceConfig& config, std::size_t nodes, std::size_t processors) {
  const std::uint64_t count = std::max<std::uint64_t>(config.ust.subbuffer_count, 1);
  const std::uint64_t needed = 2 * gathering(config, nodes, processors) / count;
  return std::bit_ceil(std::max(needed, TraceConfig().ust.subbuffer_size));
}

std::string buffer_warning(const TraceConfig& config, std::size_t nodes, std::size_t processors) {
  const std::uint64_t room = config.ust.subbuffer_size * config.ust.subbuffer_count;
  if (config.events_ust.empty() || config.records_snapshots() || gathering(config, nodes, processors) <= room) {
    return {};
  }
  return fmt::format(
      "{} process{} may fire {} events a second, more than {} sub-buffers of {} bytes for each of {} processors hold "
      "on a "
      "busy machine: events may be lost; subbuffers=\"auto\" sizes them",
      nodes, nodes == 1 ? "" : "es", nodes * kEventsPerNode, config.ust.subbuffer_count, config.ust.subbuffer_size,
      processors);
}

void fit_into_shared_memory(std::vector<ChannelPlan>& plans, std::uint64_t free, std::uint64_t processors,
                            std::vector<std::string>& warnings) {
  const auto needed = [&] {
    std::uint64_t bytes = 0;
    for (const ChannelPlan& plan : plans) {
      if (plan.domain == LTTNG_DOMAIN_UST) {
        bytes += plan.subbuffer_size * plan.subbuffer_count * processors;
      }
    }
    return bytes + bytes / 16;  // what describes them
  };
  const std::uint64_t wanted = needed();
  if (wanted <= free) {
    return;
  }
  while (needed() > free) {
    bool smaller = false;
    for (ChannelPlan& plan : plans) {
      if (plan.domain != LTTNG_DOMAIN_UST || plan.subbuffer_size <= kSmallestFittedSubbuffer) {
        continue;
      }
      plan.subbuffer_size /= 2;
      smaller = true;
    }
    if (smaller) {
      continue;
    }
    throw TraceError(
        fmt::format("the buffers need {} bytes of shared memory, and /dev/shm has {} left", needed(), free),
        "give it more (in a container with --shm-size), or leave channels out");
  }
  warnings.push_back(fmt::format(
      "/dev/shm has {} bytes left, and the buffers would need {}: sub-buffers are made smaller, {} bytes; more "
      "room is given to a container with --shm-size",
      free, wanted, std::find_if(plans.begin(), plans.end(), [](const ChannelPlan& plan) {
                      return plan.domain == LTTNG_DOMAIN_UST;
                    })->subbuffer_size));
}

}  // namespace tracing
