// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/shared_memory_fit.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

constexpr std::uint64_t kSmallestFittedSubbuffer = 32768;  // bytes; smaller ones lose events at start-up

}  // namespace

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
