// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/buffer_estimate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

namespace tracing {
namespace {

// Bytes that gather for a processor while the consumer does not read.
std::uint64_t gathering(const TraceConfig& config, std::size_t nodes, std::size_t processors) {
  const double seconds = config.ust.read_timer / 1e6 + kConsumerDelay;
  const double rate = static_cast<double>(nodes * kEventsPerNode * kBytesPerEvent) /
                      static_cast<double>(std::max<std::size_t>(processors, 1));
  return static_cast<std::uint64_t>(rate * seconds);
}

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

}  // namespace tracing
