// SPDX-License-Identifier: Apache-2.0
// The measured program for what stays within a process: how late a timer's callback runs, and messages that rclcpp
// hands over itself (intra-process communication), as unique_ptr.
//   latency_local timer|intra_process
// Nothing but rclcpp and latency_msgs, so that it can be built against another rclcpp as well.
#include <chrono>
#include <cstdint>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string_view>
#include <tuple>
#include <utility>

#include "stack_worker.hpp"
#include "worker.hpp"

namespace {

using latency::Message;

// A timer for each batch; its period is that of the batch.
void run_timers() {
  const auto node = std::make_shared<rclcpp::Node>("timer");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  latency::LatencyLog log;
  latency::tell_ready();
  latency::for_each_batch([&](const latency::Batch& batch) {
    auto remaining = static_cast<std::int64_t>(batch.messages);
    rclcpp::TimerBase::SharedPtr timer;
    timer = node->create_wall_timer(std::chrono::nanoseconds(batch.period), [&] {
      if (remaining > 0) {
        // The next call is one period after the time at which this one was due.
        --remaining;
        log.add(batch.period - timer->time_until_trigger().count(), remaining);
      }
    });
    while (remaining > 0) {
      executor.spin_once();
    }
  });
}

// From publish() to the callback, both in this thread.
template <std::size_t... I>
void hand_over(std::index_sequence<I...>) {
  const auto node = std::make_shared<rclcpp::Node>("local", rclcpp::NodeOptions().use_intra_process_comms(true));
  latency::LatencyLog log;
  std::uint64_t count = 0;
  const auto subscriptions = std::make_tuple(node->create_subscription<Message<I>>(
      latency::topic_of(I), latency::kDepth, [&](std::unique_ptr<Message<I>> message) {
        log.received(message->sent, message->remaining);
        ++count;
      })...);
  const auto publishers = std::make_tuple(node->create_publisher<Message<I>>(latency::topic_of(I), latency::kDepth)...);
  const auto matched = [](const auto& publisher) {
    return publisher->get_subscription_count() == 1 && publisher->get_intra_process_subscription_count() == 1;
  };
  latency::wait_until(node, [&] { return (... && matched(std::get<I>(publishers))); });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  const auto publish = [](auto& publisher, auto message, std::int64_t remaining) {
    message->remaining = remaining;
    message->sent = latency::monotonic_now();
    publisher.publish(std::move(message));
    return true;
  };
  latency::publish_batches([&](std::size_t size_index, std::int64_t remaining) {
    const std::uint64_t before = count;
    (void)(... || (I == size_index && publish(*std::get<I>(publishers), std::make_unique<Message<I>>(), remaining)));
    while (count == before) {
      executor.spin_once();
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::string_view role = argc == 2 ? argv[1] : "";
  if (role == "timer") {
    run_timers();
  } else {
    hand_over(std::make_index_sequence<latency::kSizes.size()>());
  }
}
