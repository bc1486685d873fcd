// SPDX-License-Identifier: Apache-2.0
// librclcpp.so of another ROS 2: calls tracetools as rclcpp, rcl and rmw of that version do.
#include "their_rclcpp.hpp"

#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "their_interface.h"

namespace {

const void* handle(std::uintptr_t number) {
  return reinterpret_cast<const void*>(number);
}

std::int64_t nanoseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

// A gid of `number` bytes at the end of a page, behind which reading ends the process.
const std::uint8_t* make_gid(std::uint8_t first) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory = mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  auto* const pages = static_cast<std::uint8_t*>(memory);
  mprotect(pages + page, page, PROT_NONE);
  std::uint8_t* const gid = pages + page - THEIR_GID_SIZE;
  for (int i = 0; i < 16; ++i) {
    gid[i] = static_cast<std::uint8_t>(first + i);
  }
  return gid;
}

void register_callback(const void* callback, const char* mangled) {
#if THEIR_VERSION < 501
  ros_trace_rclcpp_callback_register(callback, tracetools::detail::demangle_symbol(mangled));
#else
  if (ros_trace_enabled_rclcpp_callback_register()) {
    char* const symbol = tracetools::detail::demangle_symbol(mangled);
    ros_trace_do_rclcpp_callback_register(callback, symbol);
    std::free(symbol);
  }
#endif
}

void publish(const void* rmw_publisher, const void* message) {
  ros_trace_rclcpp_publish(nullptr, message);
  ros_trace_rcl_publish(handle(0x20), message);
#if THEIR_VERSION >= 801
  ros_trace_rmw_publish(rmw_publisher, message, nanoseconds(CLOCK_REALTIME));
#else
  (void)rmw_publisher;
  ros_trace_rmw_publish(message);
#endif
}

void serve([[maybe_unused]] const std::uint8_t* client) {
#if THEIR_VERSION >= 805
  ros_trace_rmw_take_request(handle(0x80), handle(0x81), client, 7, true);
  ros_trace_rmw_send_response(handle(0x80), handle(0x82), client, 7, nanoseconds(CLOCK_REALTIME));
  ros_trace_rmw_send_request(handle(0x90), handle(0x91), 8);
  ros_trace_rmw_take_response(handle(0x90), handle(0x92), 8, 1, true);
#endif
}

void create_objects() {
  ros_trace_rcl_init(handle(0x1));
  ros_trace_rcl_node_init(handle(0x10), handle(0x11), "talker", "/");
  ros_trace_rmw_publisher_init(handle(0x21), make_gid(1));
  ros_trace_rcl_publisher_init(handle(0x20), handle(0x10), handle(0x21), "/chatter", 10);
  ros_trace_rmw_subscription_init(handle(0x31), make_gid(101));
  ros_trace_rcl_subscription_init(handle(0x30), handle(0x10), handle(0x31), "/orders", 10);
  ros_trace_rclcpp_subscription_init(handle(0x30), handle(0x32));
  ros_trace_rclcpp_subscription_callback_added(handle(0x32), handle(0x33));
  register_callback(handle(0x33), "_ZN6Talker5orderEv");
  ros_trace_rcl_timer_init(handle(0x40), 1'000'000);
  ros_trace_rclcpp_timer_callback_added(handle(0x40), handle(0x41));
  register_callback(handle(0x41), "_ZN6Talker4talkEv");
  ros_trace_rclcpp_timer_link_node(handle(0x40), handle(0x10));
  ros_trace_rcl_service_init(handle(0x50), handle(0x10), handle(0x80), "/reset");
  ros_trace_rclcpp_service_callback_added(handle(0x50), handle(0x51));
  register_callback(handle(0x51), nullptr);
#if THEIR_VERSION >= 805
  ros_trace_rmw_client_init(handle(0x90), make_gid(51));
#endif
  ros_trace_rcl_client_init(handle(0x60), handle(0x10), handle(0x90), "/add");
#if THEIR_VERSION >= 601
  ros_trace_rclcpp_construct_ring_buffer(handle(0x70), 10);
  ros_trace_rclcpp_buffer_to_ipb(handle(0x70), handle(0x71));
  ros_trace_rclcpp_ipb_to_subscription(handle(0x71), handle(0x32));
#endif
#if THEIR_VERSION >= 810
  const void* from[] = {handle(0x30)};
  const void* to[] = {handle(0x20)};
  ros_trace_message_link_periodic_async(from, 1, to, 1);
#endif
}

// A timer publishes, and an order that was published `age` nanoseconds before is taken and takes `duration` ns.
void cycle(const std::uint8_t* client, std::int64_t age, std::int64_t duration) {
  ros_trace_rclcpp_executor_get_next_ready();
  ros_trace_rclcpp_executor_wait_for_work(-1);
  ros_trace_rclcpp_executor_execute(handle(0x40));
  ros_trace_callback_start(handle(0x41), false);
  publish(handle(0x21), handle(0xa0));
  ros_trace_callback_end(handle(0x41));
  ros_trace_rclcpp_executor_execute(handle(0x30));
  ros_trace_rmw_take(handle(0x31), handle(0xb0), nanoseconds(CLOCK_REALTIME) - age, true);
  ros_trace_rcl_take(handle(0xb0));
  ros_trace_rclcpp_take(handle(0xb0));
  ros_trace_callback_start(handle(0x33), false);
  for (const std::int64_t end = nanoseconds(CLOCK_MONOTONIC) + duration; nanoseconds(CLOCK_MONOTONIC) < end;) {
  }
  ros_trace_callback_end(handle(0x33));
  serve(client);
}

// Only what their tracetools records here (their_recording.c).
void recorded_cycle() {
#if THEIR_VERSION >= 801
  ros_trace_rmw_publish(handle(0x21), handle(0xa0), 1);
#else
  ros_trace_rmw_publish(handle(0xa0));
#endif
  ros_trace_callback_end(handle(0x41));
}

}  // namespace

int spin_their_node(int argc, char** argv) {
  if (argc < 3) {
    return 2;
  }
  const long cycles = std::atol(argv[1]);
  const long pause_us = std::atol(argv[2]);
  const bool late = argc > 3 && std::strcmp(argv[3], "late") == 0;
  const bool only_recorded = argc > 3 && std::strcmp(argv[3], "recorded") == 0;
  create_objects();
  const char* const preload = std::getenv("LD_PRELOAD");
  std::printf("LD_PRELOAD: %s\n", preload == nullptr ? "none" : preload);
  std::puts("ready");
  std::fflush(stdout);
  const std::uint8_t* const client = make_gid(51);
  std::vector<std::int64_t> times;
  for (long i = 0; i < cycles; ++i) {
    const bool is_late = late && i == 20;
    const std::int64_t begin = nanoseconds(CLOCK_MONOTONIC);
    if (only_recorded) {
      recorded_cycle();
    } else {
      cycle(client, is_late ? std::int64_t{3600} * 1'000'000'000 : 1000, is_late ? 30'000'000 : 0);
    }
    times.push_back(nanoseconds(CLOCK_MONOTONIC) - begin);
    if (i % 100 == 99) {
      std::printf("cycle %ld.\n", i + 1);
      std::fflush(stdout);
    }
    usleep(static_cast<useconds_t>(pause_us));
  }
  std::nth_element(times.begin(), times.begin() + cycles / 2, times.end());
  std::printf("median %lld ns\n", cycles > 0 ? static_cast<long long>(times[cycles / 2]) : 0);
  return 0;
}
