// SPDX-License-Identifier: Apache-2.0
// The measured program: rclcpp publishers, rclcpp subscriptions in a single-threaded executor, or both in one process.
//   latency_stack publisher|subscriber|both
// It uses nothing but rclcpp and latency_msgs, so that it can be built against another rclcpp as well.
#include "stack_worker.hpp"

#include <cstdint>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string_view>
#include <tuple>
#include <utility>

#include "worker.hpp"

namespace {

using latency::Message;
using latency::wait_until;

// A publisher for each size.
template <std::size_t... I>
class Publishers {
 public:
  explicit Publishers(rclcpp::Node& node)
      : publishers_(node.create_publisher<Message<I>>(latency::topic_of(I), latency::kDepth)...),
        messages_(std::make_unique<Message<I>>()...) {}

  bool matched() const { return (... && (std::get<I>(publishers_)->get_subscription_count() == 1)); }
  void publish(std::size_t size_index, std::int64_t remaining) const {
    (void)(... || (I == size_index && publish_one(*std::get<I>(publishers_), *std::get<I>(messages_), remaining)));
  }

 private:
  template <typename Publisher, typename OneMessage>
  static bool publish_one(Publisher& publisher, OneMessage& message, std::int64_t remaining) {
    message.remaining = remaining;
    message.sent = latency::monotonic_now();
    publisher.publish(message);
    return true;
  }

  std::tuple<std::shared_ptr<rclcpp::Publisher<Message<I>>>...> publishers_;
  std::tuple<std::unique_ptr<Message<I>>...> messages_;
};

// A subscription for each size; together they count what has come.
template <std::size_t... I>
class Subscriptions {
 public:
  explicit Subscriptions(rclcpp::Node& node)
      : subscriptions_(node.create_subscription<Message<I>>(
            latency::topic_of(I), latency::kDepth,
            [this](const Message<I>& message) { received(message.sent, message.remaining); })...) {}

  bool matched() const { return (... && (std::get<I>(subscriptions_)->get_publisher_count() == 1)); }
  std::uint64_t count() const { return count_; }

 private:
  void received(std::int64_t sent, std::int64_t remaining) {
    log_.received(sent, remaining);
    ++count_;
  }

  latency::LatencyLog log_;
  std::uint64_t count_ = 0;
  std::tuple<std::shared_ptr<rclcpp::Subscription<Message<I>>>...> subscriptions_;
};

template <std::size_t... I>
void publish(const rclcpp::Node::SharedPtr& node, std::index_sequence<I...>) {
  const Publishers<I...> publishers(*node);
  wait_until(node, [&] { return publishers.matched(); });
  latency::publish_batches(
      [&](std::size_t size_index, std::int64_t remaining) { publishers.publish(size_index, remaining); });
}

template <std::size_t... I>
void subscribe(const rclcpp::Node::SharedPtr& node, std::index_sequence<I...>) {
  const Subscriptions<I...> subscriptions(*node);
  wait_until(node, [&] { return subscriptions.matched(); });
  rclcpp::spin(node);
}

// In one thread, as a timer's callback would publish: after each message the executor spins until it has come.
template <std::size_t... I>
void publish_and_subscribe(const rclcpp::Node::SharedPtr& node, std::index_sequence<I...>) {
  const Publishers<I...> publishers(*node);
  const Subscriptions<I...> subscriptions(*node);
  wait_until(node, [&] { return publishers.matched() && subscriptions.matched(); });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  latency::publish_batches([&](std::size_t size_index, std::int64_t remaining) {
    const std::uint64_t before = subscriptions.count();
    publishers.publish(size_index, remaining);
    while (subscriptions.count() == before) {
      executor.spin_once();
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("latency");
  constexpr auto kIndices = std::make_index_sequence<latency::kSizes.size()>();
  const std::string_view role = argc == 2 ? argv[1] : "";
  if (role == "publisher") {
    publish(node, kIndices);
  } else if (role == "both") {
    publish_and_subscribe(node, kIndices);
  } else {
    subscribe(node, kIndices);
  }
}
