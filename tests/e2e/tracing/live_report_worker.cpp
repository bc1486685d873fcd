// SPDX-License-Identifier: Apache-2.0
// Fires the tracepoints of a node with a timer, a publisher and a subscription. For each number on standard input the
// timer publishes so many messages, the subscription gets them, and the worker answers "done".
#include <time.h>

#include <cstdint>
#include <cstdio>

#include "tracetools/tracetools.h"

namespace {

enum : std::uintptr_t {
  kContext = 1,
  kNode,
  kRmwNode,
  kPublisher,
  kRmwPublisher,
  kSubscription,
  kRmwSubscription,
  kObject,
  kTimer,
  kOnTimer,
  kOnMessage,
  kMessage
};

const void* handle(std::uintptr_t number) {
  return reinterpret_cast<const void*>(number);
}

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

void make_node() {
  const std::uint8_t publisher_gid[16] = {1};
  const std::uint8_t subscription_gid[16] = {2};
  TRACETOOLS_TRACEPOINT(rcl_init, handle(kContext));
  TRACETOOLS_TRACEPOINT(rcl_node_init, handle(kNode), handle(kRmwNode), "beat", "/");
  TRACETOOLS_TRACEPOINT(rmw_publisher_init, handle(kRmwPublisher), publisher_gid);
  TRACETOOLS_TRACEPOINT(rcl_publisher_init, handle(kPublisher), handle(kNode), handle(kRmwPublisher), "/beats", 10);
  TRACETOOLS_TRACEPOINT(rmw_subscription_init, handle(kRmwSubscription), subscription_gid);
  TRACETOOLS_TRACEPOINT(rcl_subscription_init, handle(kSubscription), handle(kNode), handle(kRmwSubscription), "/beats",
                        10);
  TRACETOOLS_TRACEPOINT(rclcpp_subscription_init, handle(kSubscription), handle(kObject));
  TRACETOOLS_TRACEPOINT(rclcpp_subscription_callback_added, handle(kObject), handle(kOnMessage));
  TRACETOOLS_TRACEPOINT(rclcpp_callback_register, handle(kOnMessage), "Beat::on_message()");
  TRACETOOLS_TRACEPOINT(rcl_timer_init, handle(kTimer), std::int64_t{1'000'000});
  TRACETOOLS_TRACEPOINT(rclcpp_timer_callback_added, handle(kTimer), handle(kOnTimer));
  TRACETOOLS_TRACEPOINT(rclcpp_callback_register, handle(kOnTimer), "Beat::on_timer()");
  TRACETOOLS_TRACEPOINT(rclcpp_timer_link_node, handle(kTimer), handle(kNode));
}

void beat() {
  TRACETOOLS_TRACEPOINT(callback_start, handle(kOnTimer), false);
  const std::int64_t published = now();
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, handle(kMessage));
  TRACETOOLS_TRACEPOINT(rcl_publish, handle(kPublisher), handle(kMessage));
  TRACETOOLS_TRACEPOINT(rmw_publish, handle(kRmwPublisher), handle(kMessage), published);
  TRACETOOLS_TRACEPOINT(callback_end, handle(kOnTimer));
  TRACETOOLS_TRACEPOINT(rmw_take, handle(kRmwSubscription), handle(kMessage), published, true);
  TRACETOOLS_TRACEPOINT(rcl_take, handle(kMessage));
  TRACETOOLS_TRACEPOINT(rclcpp_take, handle(kMessage));
  TRACETOOLS_TRACEPOINT(callback_start, handle(kOnMessage), false);
  TRACETOOLS_TRACEPOINT(callback_end, handle(kOnMessage));
}

}  // namespace

int main() {
  make_node();
  for (int beats = 0; std::scanf("%d", &beats) == 1;) {
    for (int i = 0; i < beats; ++i) {
      beat();
    }
    std::puts("done");
    std::fflush(stdout);
  }
}
