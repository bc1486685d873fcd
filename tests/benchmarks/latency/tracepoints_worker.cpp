// SPDX-License-Identifier: Apache-2.0
// Measures the cost of the tracepoints between publish() and the callback. Answers each PathRequest on stdin with the
// PathCosts on stdout.
#include <tracetools/tracetools.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

#include "worker.hpp"

namespace {

constexpr int kCalls = 2000;
constexpr int kRepetitions = 7;
constexpr int kPacedRepetitions = 250;

const void* const kPointer = &kCalls;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// In microseconds.
double time_of(void (*events)(), int calls) {
  const std::int64_t begin = latency::monotonic_now();
  for (int i = 0; i < calls; ++i) {
    events();
  }
  return static_cast<double>(latency::monotonic_now() - begin) / calls / 1e3;
}

double cost_in_a_loop(void (*event)()) {
  std::vector<double> costs(kRepetitions);
  std::generate(costs.begin(), costs.end(), [event] { return time_of(event, kCalls); });
  return median(costs);
}

// The sender and the receiver of a message copy it, and the copy pushes as much out of the caches as it needs.
double cost_at_pace(void (*events)(), const latency::PathRequest& request) {
  const std::vector<char> message(request.bytes, 'm');
  std::vector<char> copy(request.bytes);
  std::vector<double> costs;
  latency::at_pace(kPacedRepetitions, request.period, [&](std::uint64_t) {
    std::copy(message.begin(), message.end(), copy.begin());
    costs.push_back(time_of(events, 1));
  });
  return median(costs);
}

constexpr std::array<void (*)(), 3> kOfPublisher = {
    [] { TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, kPointer); },
    [] { TRACETOOLS_TRACEPOINT(rcl_publish, kPointer, kPointer); },
    [] { TRACETOOLS_TRACEPOINT(rmw_publish, kPointer, kPointer, 1); },
};
constexpr std::array<void (*)(), 6> kOfSubscriber = {
    [] { TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready); },
    [] { TRACETOOLS_TRACEPOINT(rclcpp_executor_execute, kPointer); },
    [] { TRACETOOLS_TRACEPOINT(rmw_take, kPointer, kPointer, 1, true); },
    [] { TRACETOOLS_TRACEPOINT(rcl_take, kPointer); },
    [] { TRACETOOLS_TRACEPOINT(rclcpp_take, kPointer); },
    [] { TRACETOOLS_TRACEPOINT(callback_start, kPointer, false); },
};

template <const auto& kEvents>
void call_all() {
  for (void (*event)() : kEvents) {
    event();
  }
}

latency::PathCosts costs_of_path(const latency::PathRequest& request) {
  latency::PathCosts costs{};
  for (void (*event)() : kOfPublisher) {
    costs.in_a_loop += cost_in_a_loop(event);
  }
  for (void (*event)() : kOfSubscriber) {
    costs.in_a_loop += cost_in_a_loop(event);
  }
  costs.at_pace = cost_at_pace(call_all<kOfPublisher>, request) + cost_at_pace(call_all<kOfSubscriber>, request);
  return costs;
}

}  // namespace

int main() {
  latency::PathRequest request{};
  while (read(STDIN_FILENO, &request, sizeof request) == sizeof request) {
    const latency::PathCosts costs = costs_of_path(request);
    if (write(STDOUT_FILENO, &costs, sizeof costs) != sizeof costs) {
      return 1;
    }
  }
}
