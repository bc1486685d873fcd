// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "launcher/testing/checks/trace_judges.hpp"

namespace launch {

namespace {

// The callbacks of the node that ask for memory, most often first.
std::vector<std::string> callbacks_of(const std::string& node, const tracing::Ros2Results& ros2) {
  constexpr std::size_t kRows = 8;
  std::vector<const tracing::CallbackResult*> callbacks;
  for (const tracing::CallbackResult& callback : ros2.callbacks) {
    if (callback.node == node && callback.allocations.value_or(0) > 0) {
      callbacks.push_back(&callback);
    }
  }
  std::stable_sort(callbacks.begin(), callbacks.end(),
                   [](const auto* a, const auto* b) { return *a->allocations > *b->allocations; });
  callbacks.resize(std::min(callbacks.size(), kRows));
  std::vector<std::string> rows;
  for (const tracing::CallbackResult* const callback : callbacks) {
    rows.push_back(fmt::format("{}{}: {} calls, {} bytes, in {} runs", callback->symbol,
                               callback->owner_name.empty() ? "" : fmt::format(" of {}", callback->owner_name),
                               *callback->allocations, callback->allocated_bytes, callback->durations.count));
  }
  return rows;
}

}  // namespace

std::optional<Failure> judge_allocations(const ExpectedAllocations& expected, const tracing::TraceResults& results,
                                         const SourceRange& where) {
  const std::string when = expected.state.empty() ? "" : fmt::format(" while it is {}", expected.state);
  const std::string text =
      fmt::format("the callbacks of '{}' ask for memory at most {} times{}", expected.node, expected.most, when);
  bool was_there = false;
  bool was_counted = false;
  std::uint64_t calls = 0;
  const auto add = [&](const std::optional<std::uint64_t>& allocations) {
    was_there = true;
    was_counted = was_counted || allocations.has_value();
    calls += allocations.value_or(0);
  };
  if (expected.state.empty()) {
    for (const tracing::CallbackResult& callback : results.ros2.callbacks) {
      if (callback.node == expected.node) {
        add(callback.allocations);
      }
    }
  } else {
    for (const tracing::LifecycleResult& stay : results.ros2.lifecycle) {
      if (stay.node == expected.node && stay.state == expected.state) {
        add(stay.allocations);
      }
    }
  }
  if (!was_there) {
    return Failure{expected.state.empty() ? fmt::format("no callback of '{}' has run", expected.node)
                                          : fmt::format("'{}' was never {}", expected.node, expected.state),
                   where, text};
  }
  if (!was_counted) {
    Failure failure{"the trace does not tell who asks for memory", where, text, "no event of lttng_ust_libc"};
    failure.help = "liblttng-ust-libc-wrapper.so must be installed, and the nodes must load it";
    return failure;
  }
  if (calls <= expected.most) {
    return std::nullopt;
  }
  return Failure{fmt::format("'{}' asks for memory{}", expected.node, when),
                 where,
                 text,
                 fmt::format("{} times", calls),
                 callbacks_of(expected.node, results.ros2),
                 "its callbacks, in all states"};
}

}  // namespace launch
