// SPDX-License-Identifier: Apache-2.0
// The measured program for start-up and discovery.
//   latency_discovery listener    tells of the message that a `first` has published: the start of its main(), when it
//   has
//                                 published, and when the message has come
//   latency_discovery first       publishes as soon as it can, for late subscribers as well
//   latency_discovery one_of N    a node with a publisher and a subscription of a topic that N such nodes share; tells
//   when
//                                 both have found those of all N
// Nothing but rclcpp and latency_msgs, so that it can be built against another rclcpp as well.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <string_view>

#include "stack_worker.hpp"
#include "worker.hpp"

namespace {

using latency_msgs::msg::Bytes1k;

void listen() {
  const auto node = std::make_shared<rclcpp::Node>("listener");
  const auto subscription =
      node->create_subscription<Bytes1k>("/first", rclcpp::QoS(1).transient_local(), [](const Bytes1k& message) {
        latency::tell({message.sent, message.remaining, latency::monotonic_now()});
      });
  latency::tell_ready();
  rclcpp::spin(node);
}

void publish_first(std::int64_t main_begun) {
  const auto node = std::make_shared<rclcpp::Node>("first");
  const auto publisher = node->create_publisher<Bytes1k>("/first", rclcpp::QoS(1).transient_local());
  Bytes1k message;
  message.sent = main_begun;
  message.remaining = latency::monotonic_now();
  publisher->publish(message);
  latency::wait_for_end();
}

void find_all(std::size_t nodes) {
  const auto node = std::make_shared<rclcpp::Node>("node" + std::to_string(getpid()));
  const auto publisher = node->create_publisher<Bytes1k>("/all", latency::kDepth);
  const auto subscription = node->create_subscription<Bytes1k>("/all", latency::kDepth, [](const Bytes1k&) {});
  const rclcpp::Event::SharedPtr change = node->get_graph_event();
  while (true) {
    change->check_and_clear();
    if (publisher->get_subscription_count() >= nodes && subscription->get_publisher_count() >= nodes) {
      break;
    }
    node->wait_for_graph_change(change, latency::kLookAgain);
  }
  latency::tell({latency::monotonic_now()});
  latency::wait_for_end();
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t begun = latency::monotonic_now();
  rclcpp::init(argc, argv);
  const std::string_view role = argc >= 2 ? argv[1] : "";
  if (role == "listener") {
    listen();
  } else if (role == "first") {
    publish_first(begun);
  } else if (argc == 3) {
    find_all(std::strtoul(argv[2], nullptr, 10));
  }
  rclcpp::shutdown();
}
