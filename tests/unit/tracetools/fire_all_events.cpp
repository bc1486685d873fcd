// SPDX-License-Identifier: Apache-2.0
// Fires every event once, with the arguments that event_payload_test.cpp expects in the trace, and prints how many
// threads the process has. With --stay no object ends, and the process waits for the end of its input, so that a
// session can start late. With --stay-empty all objects end first.
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <thread>

#include "tracetools/tracetools.h"

namespace {

const void* at(uintptr_t address) {
  return reinterpret_cast<const void*>(address);
}

void end_objects() {
  TRACETOOLS_EXT_TRACEPOINT(rcl_context_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rcl_node_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rmw_publisher_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rcl_publisher_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rmw_subscription_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rcl_subscription_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_subscription_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rmw_service_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rcl_service_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rmw_client_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rcl_client_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rcl_timer_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_callback_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rcl_lifecycle_state_machine_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_ipb_fini, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_ring_buffer_fini, at(0x1));
}

// The objects that end_objects() does not end, because another argument of their events has the address 0x1.
void end_remaining_objects() {
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_subscription_fini, at(0x2));
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_callback_fini, at(0x2));
  TRACETOOLS_EXT_TRACEPOINT(rcl_lifecycle_state_machine_fini, at(0x2));
  TRACETOOLS_EXT_TRACEPOINT(rcl_subscription_fini, at(0x52));
  TRACETOOLS_EXT_TRACEPOINT(rcl_subscription_fini, at(0x51));
}

void wait_for_end_of_input() {
  std::puts("ready");
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view option = argc > 1 ? argv[1] : "";
  const uint8_t gid[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 30, 255};
  const void* subs[] = {at(0x51), at(0x52)};
  const void* pubs[] = {at(0x61)};

  TRACETOOLS_TRACEPOINT(rcl_init, at(0x1));
  TRACETOOLS_TRACEPOINT(rcl_node_init, at(0x1), at(0x2), "ping", "/robot");
  TRACETOOLS_TRACEPOINT(rmw_publisher_init, at(0x1), gid);
  TRACETOOLS_TRACEPOINT(rcl_publisher_init, at(0x1), at(0x2), at(0x3), "/ping", 10);
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, at(0x2));
  TRACETOOLS_TRACEPOINT(rclcpp_intra_publish, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rcl_publish, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rmw_publish, at(0x1), at(0x2), 1767225600506920000);
  TRACETOOLS_TRACEPOINT(rmw_subscription_init, at(0x1), gid);
  TRACETOOLS_TRACEPOINT(rcl_subscription_init, at(0x1), at(0x2), at(0x3), "/pong", 5);
  TRACETOOLS_TRACEPOINT(rclcpp_subscription_init, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rclcpp_subscription_callback_added, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rmw_take, at(0x1), at(0xffffffffffffffff), -1, true);
  TRACETOOLS_TRACEPOINT(rcl_take, at(0x1));
  TRACETOOLS_TRACEPOINT(rclcpp_take, at(0x1));
  TRACETOOLS_TRACEPOINT(rcl_service_init, at(0x1), at(0x2), at(0x3), "/add");
  TRACETOOLS_TRACEPOINT(rclcpp_service_callback_added, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rmw_take_request, at(0x1), at(0x2), gid, 3, false);
  TRACETOOLS_TRACEPOINT(rmw_send_response, at(0x1), at(0x2), gid, 3, 4);
  TRACETOOLS_TRACEPOINT(rmw_client_init, at(0x1), gid);
  TRACETOOLS_TRACEPOINT(rcl_client_init, at(0x1), at(0x2), at(0x3), "/add");
  TRACETOOLS_TRACEPOINT(rmw_send_request, at(0x1), at(0x2), 3);
  TRACETOOLS_TRACEPOINT(rmw_take_response, at(0x1), at(0x2), 3, 4, true);
  TRACETOOLS_TRACEPOINT(rcl_timer_init, at(0x1), 500000000);
  TRACETOOLS_TRACEPOINT(rclcpp_timer_callback_added, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rclcpp_timer_link_node, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rclcpp_callback_register, at(0x1), nullptr);
  TRACETOOLS_TRACEPOINT(callback_start, at(0x1), true);
  TRACETOOLS_TRACEPOINT(callback_end, at(0x1));
  TRACETOOLS_TRACEPOINT(rcl_lifecycle_state_machine_init, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rcl_lifecycle_transition, at(0x1), "unconfigured", "configuring");
  TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready);
  TRACETOOLS_TRACEPOINT(rclcpp_executor_wait_for_work, -1);
  // The other way to fire: first ask, then record.
  if (TRACETOOLS_TRACEPOINT_ENABLED(rclcpp_executor_execute)) {
    TRACETOOLS_DO_TRACEPOINT(rclcpp_executor_execute, at(0x1));
  }
  TRACETOOLS_TRACEPOINT(rclcpp_ipb_to_subscription, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rclcpp_buffer_to_ipb, at(0x1), at(0x2));
  TRACETOOLS_TRACEPOINT(rclcpp_construct_ring_buffer, at(0x1), 18446744073709551615u);
  TRACETOOLS_TRACEPOINT(rclcpp_ring_buffer_enqueue, at(0x1), 2, 3, true);
  TRACETOOLS_TRACEPOINT(rclcpp_ring_buffer_dequeue, at(0x1), 2, 3);
  TRACETOOLS_TRACEPOINT(rclcpp_ring_buffer_clear, at(0x1));
  TRACETOOLS_TRACEPOINT(message_link_periodic_async, subs, 2, pubs, 1);
  TRACETOOLS_TRACEPOINT(message_link_partial_sync, subs, 1, pubs, 0);

  TRACETOOLS_EXT_TRACEPOINT(rmw_service_init, at(0x1), gid);
  TRACETOOLS_EXT_TRACEPOINT(rmw_publisher_qos, at(0x1), true, 10, false);
  TRACETOOLS_EXT_TRACEPOINT(rmw_subscription_qos, at(0x1), false, 0, true, true);
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_client_callback_start, at(0x1), 3);
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_client_callback_end, at(0x1), 3);
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_executor_execute_service, at(0x1));
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_executor_execute_client, at(0x1));
  if (TRACETOOLS_EXT_TRACEPOINT_ENABLED(rclcpp_executor_execute_waitable)) {
    TRACETOOLS_DO_EXT_TRACEPOINT(rclcpp_executor_execute_waitable, at(0x1));
  }
  if (option == "--stay") {
    wait_for_end_of_input();
    return 0;
  }
  end_objects();
  if (option == "--stay-empty") {
    end_remaining_objects();
    wait_for_end_of_input();
    return 0;
  }
  TRACETOOLS_EXT_TRACEPOINT(state_dump_begin, 2);
  TRACETOOLS_EXT_TRACEPOINT(state_dump_end, 2);
  TRACETOOLS_EXT_TRACEPOINT(rcl_lifecycle_state, at(0x1), "active");

  std::thread([] {}).join();  // so that a sanitizer starts its own thread, if lttng-ust has not caused that already
  const auto threads = std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
  std::printf("%d\n", static_cast<int>(threads));
}
