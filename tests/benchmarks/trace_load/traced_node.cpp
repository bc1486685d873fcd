// SPDX-License-Identifier: Apache-2.0
// Usage: bench_traced_node EVENTS_PER_SECOND SECONDS
// Fires the tracepoints of a node: first those of its creation at once, then those of messages in cycles of ten
// milliseconds. At the end it prints how many it fired.
#include <time.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "tracetools/tracetools.h"

namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kCycle = 10'000'000;  // ns
constexpr int kServices = 7;                 // of a node's parameters and type description
constexpr int kEndpoints = 10;               // publishers and subscriptions each

const void* handle(std::uintptr_t number) {
  return reinterpret_cast<const void*>(number);
}

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kNanosecondsPerSecond + time.tv_nsec;
}

long create_node() {
  const std::uint8_t gid[16] = {};
  const char* const symbol = "std::_Bind<void (Node::*(Node*, std::_Placeholder<1>))(std::shared_ptr<Message>)>";
  long fired = 2;
  TRACETOOLS_TRACEPOINT(rcl_init, handle(1));
  TRACETOOLS_TRACEPOINT(rcl_node_init, handle(2), handle(3), "bench_node", "/bench");
  for (int i = 0; i < kServices; ++i, fired += 3) {
    TRACETOOLS_TRACEPOINT(rcl_service_init, handle(4), handle(2), handle(5), "/bench/bench_node/get_parameters");
    TRACETOOLS_TRACEPOINT(rclcpp_service_callback_added, handle(4), handle(6));
    TRACETOOLS_TRACEPOINT(rclcpp_callback_register, handle(6), symbol);
  }
  for (int i = 0; i < kEndpoints; ++i, fired += 7) {
    TRACETOOLS_TRACEPOINT(rmw_publisher_init, handle(7), gid);
    TRACETOOLS_TRACEPOINT(rcl_publisher_init, handle(8), handle(2), handle(7), "/bench/a_topic_name", 10);
    TRACETOOLS_TRACEPOINT(rmw_subscription_init, handle(9), gid);
    TRACETOOLS_TRACEPOINT(rcl_subscription_init, handle(10), handle(2), handle(9), "/bench/a_topic_name", 10);
    TRACETOOLS_TRACEPOINT(rclcpp_subscription_init, handle(10), handle(11));
    TRACETOOLS_TRACEPOINT(rclcpp_subscription_callback_added, handle(11), handle(12));
    TRACETOOLS_TRACEPOINT(rclcpp_callback_register, handle(12), symbol);
  }
  return fired;
}

// A received message that is answered: ten events.
long pass_message_on() {
  TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready);
  TRACETOOLS_TRACEPOINT(rclcpp_executor_execute, handle(10));
  TRACETOOLS_TRACEPOINT(rmw_take, handle(9), handle(20), std::int64_t{1}, true);
  TRACETOOLS_TRACEPOINT(rcl_take, handle(20));
  TRACETOOLS_TRACEPOINT(rclcpp_take, handle(20));
  TRACETOOLS_TRACEPOINT(callback_start, handle(12), false);
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, handle(21));
  TRACETOOLS_TRACEPOINT(rcl_publish, handle(8), handle(21));
  TRACETOOLS_TRACEPOINT(rmw_publish, handle(7), handle(21), std::int64_t{1});
  TRACETOOLS_TRACEPOINT(callback_end, handle(12));
  return 10;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    return 2;
  }
  const std::int64_t rate = std::atoll(argv[1]);
  const std::int64_t duration = std::atoll(argv[2]) * kNanosecondsPerSecond;
  long fired = create_node();
  const std::int64_t begin = now();
  for (std::int64_t cycle = begin; cycle < begin + duration; cycle += kCycle) {
    const timespec until{cycle / kNanosecondsPerSecond, cycle % kNanosecondsPerSecond};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    for (const long due = fired + rate * kCycle / kNanosecondsPerSecond; fired < due;) {
      fired += pass_message_on();
    }
  }
  std::printf("%ld\n", fired);
}
