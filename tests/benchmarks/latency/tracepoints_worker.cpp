// What the tracepoints between publish() and the callback cost: answers each byte on stdin with the sum in
// microseconds, a double, of the mean costs of each in a loop of its own.
#include <tracetools/tracetools.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "worker.hpp"

namespace {

constexpr int kCalls = 2000;
constexpr int kRepetitions = 7;

template <typename Event>
double cost_of(Event event) {
  std::array<double, kRepetitions> costs;
  for (double& cost : costs) {
    const std::int64_t begin = latency::monotonic_now();
    for (int i = 0; i < kCalls; ++i) {
      event();
    }
    cost = static_cast<double>(latency::monotonic_now() - begin) / kCalls / 1e3;
  }
  std::sort(costs.begin(), costs.end());
  return costs[kRepetitions / 2];
}

double cost_of_path() {
  const void* const pointer = &kCalls;
  return cost_of([&] { TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, pointer); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(rcl_publish, pointer, pointer); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(rmw_publish, pointer, pointer, 1); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(rclcpp_executor_execute, pointer); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(rmw_take, pointer, pointer, 1, true); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(rcl_take, pointer); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(rclcpp_take, pointer); }) +
         cost_of([&] { TRACETOOLS_TRACEPOINT(callback_start, pointer, false); });
}

}  // namespace

int main() {
  char request;
  while (read(STDIN_FILENO, &request, 1) == 1) {
    const double cost = cost_of_path();
    if (write(STDOUT_FILENO, &cost, sizeof cost) != sizeof cost) {
      return 1;
    }
  }
}
