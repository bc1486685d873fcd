// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/allocation_decoder.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace tracing {

AllocationDecoder::Plan AllocationDecoder::plan_of(const EventClass& event_class) {
  static constexpr std::array<std::string_view, 5> kNames{"lttng_ust_libc:malloc", "lttng_ust_libc:calloc",
                                                          "lttng_ust_libc:realloc", "lttng_ust_libc:memalign",
                                                          "lttng_ust_libc:posix_memalign"};
  Plan plan;
  if (std::find(kNames.begin(), kNames.end(), event_class.name) == kNames.end()) {
    return plan;
  }
  plan.size = event_class.index_of("size");
  plan.count = event_class.index_of("nmemb");
  plan.is_allocation = plan.size.has_value();
  return plan;
}

std::optional<std::uint64_t> AllocationDecoder::decode(const Event& event) {
  const std::size_t id = event.event_class->id;
  if (id >= plans_.size()) {
    plans_.resize(id + 1);
  }
  if (!plans_[id]) {
    plans_[id] = plan_of(*event.event_class);
  }
  const Plan& plan = *plans_[id];
  if (!plan.is_allocation) {
    return std::nullopt;
  }
  const std::uint64_t size = event.field(*plan.size).unsigned_integer().value_or(0);
  const std::uint64_t count = plan.count ? event.field(*plan.count).unsigned_integer().value_or(1) : 1;
  return size * count;
}

}  // namespace tracing
