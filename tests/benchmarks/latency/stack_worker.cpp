// SPDX-License-Identifier: Apache-2.0
// The measured program: rclcpp publishers, or rclcpp subscriptions in a single-threaded executor.
//   latency_stack publisher|subscriber
#include <cstring>
#include <latency_msgs/msg/bytes1k.hpp>
#include <latency_msgs/msg/bytes256k.hpp>
#include <latency_msgs/msg/bytes32k.hpp>
#include <latency_msgs/msg/bytes64k.hpp>
#include <rclcpp/rclcpp.hpp>
#include <tuple>
#include <utility>

#include "worker.hpp"

namespace {

using namespace latency_msgs::msg;
using Messages = std::tuple<Bytes1k, Bytes32k, Bytes64k, Bytes256k>;
template <std::size_t I>
using Message = std::tuple_element_t<I, Messages>;

// Time between checks whether the other side is there.
constexpr std::chrono::milliseconds kLookAgain{20};

// Ends when `matched` is true.
template <typename Matched>
void wait_until(const rclcpp::Node::SharedPtr& node, Matched matched) {
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  const auto timer = node->create_wall_timer(kLookAgain, [] {});
  while (!matched()) {
    executor.spin_once();
  }
  latency::tell_ready();
}

template <std::size_t... I>
void publish(const rclcpp::Node::SharedPtr& node, std::index_sequence<I...>) {
  auto publishers = std::make_tuple(node->create_publisher<Message<I>>(latency::topic_of(I), latency::kDepth)...);
  auto messages = std::make_tuple(std::make_unique<Message<I>>()...);
  wait_until(node, [&] { return (... && (std::get<I>(publishers)->get_subscription_count() == 1)); });
  const auto publish_one = [](auto& publisher, auto& message, std::int64_t remaining) {
    message.remaining = remaining;
    message.sent = latency::monotonic_now();
    publisher.publish(message);
    return true;
  };
  latency::publish_batches([&](std::size_t size_index, std::int64_t remaining) {
    (void)(... || (I == size_index && publish_one(*std::get<I>(publishers), *std::get<I>(messages), remaining)));
  });
}

template <std::size_t... I>
void subscribe(const rclcpp::Node::SharedPtr& node, std::index_sequence<I...>) {
  latency::LatencyLog log;
  const auto subscriptions = std::make_tuple(node->create_subscription<Message<I>>(
      latency::topic_of(I), latency::kDepth,
      [&log](const Message<I>& message) { log.received(message.sent, message.remaining); })...);
  wait_until(node, [&] { return (... && (std::get<I>(subscriptions)->get_publisher_count() == 1)); });
  rclcpp::spin(node);
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("latency");
  constexpr auto kIndices = std::make_index_sequence<latency::kSizes.size()>();
  if (argc == 2 && std::strcmp(argv[1], "publisher") == 0) {
    publish(node, kIndices);
  } else {
    subscribe(node, kIndices);
  }
}
