// SPDX-License-Identifier: Apache-2.0
// A process with as many nodes, publishers and subscriptions as a whole robot.
#include <atomic>
#include <chrono>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <vector>

#include "tests/support/emulated.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

using std::chrono::milliseconds;
using std_msgs::msg::UInt64;

namespace {

// Fast DDS compares each endpoint with all others of the process, which takes half an hour under QEMU.
const size_t kNodes = test_support::vfork_shares_memory() ? 100 : 21;
constexpr size_t kTopicsPerNode = 10;

// Counts the waits in which it takes part.
class WaitCounter : public rclcpp::Waitable {
 public:
  void add_to_wait_set(rcl_wait_set_t&) override { ++waits; }
  bool is_ready(const rcl_wait_set_t&) override { return false; }
  std::shared_ptr<void> take_data() override { return nullptr; }
  void execute(const std::shared_ptr<void>&) override {}

  int waits = 0;
};

// Nodes in a ring: each publishes five topics that the next one subscribes to.
class ManyEntitiesTest : public RosTest {
 protected:
  ManyEntitiesTest() {
    const auto start = std::chrono::steady_clock::now();
    for (size_t i = 0; i < kNodes; ++i) {
      nodes_.push_back(std::make_shared<rclcpp::Node>("node" + std::to_string(i)));
    }
    for (size_t i = 0; i < kNodes; ++i) {
      for (size_t j = 0; j < kTopicsPerNode; ++j) {
        const std::string topic = "topic" + std::to_string(i) + "_" + std::to_string(j);
        publishers_.push_back(nodes_[i]->create_publisher<UInt64>(topic, 10));
        subscriptions_.push_back(nodes_[(i + 1) % kNodes]->create_subscription<UInt64>(
            topic, 10, [this](const UInt64& message) { received_ += message.data; }));
      }
    }
    const auto took = std::chrono::steady_clock::now() - start;
    RecordProperty("start_ms", static_cast<int>(std::chrono::duration_cast<milliseconds>(took).count()));
  }

  void add_all(rclcpp::Executor& executor) {
    for (const auto& node : nodes_) {
      executor.add_node(node);
    }
  }

  // Each publisher sends one message, to the one subscription that it has.
  void publish_everywhere() {
    UInt64 message;
    message.data = 1;
    for (const auto& publisher : publishers_) {
      publisher->publish(message);
    }
  }

  std::vector<rclcpp::Node::SharedPtr> nodes_;
  std::vector<rclcpp::Publisher<UInt64>::SharedPtr> publishers_;
  std::vector<rclcpp::Subscription<UInt64>::SharedPtr> subscriptions_;
  std::atomic<size_t> received_{0};
};

TEST_F(ManyEntitiesTest, AreServedByOneExecutorOfEachKind) {
  {
    rclcpp::executors::SingleThreadedExecutor executor;
    add_all(executor);
    publish_everywhere();
    EXPECT_TRUE(spin_until(executor, [this] { return received_ == kNodes * kTopicsPerNode; }));
  }
  received_ = 0;
  {
    rclcpp::experimental::executors::EventsExecutor executor;
    add_all(executor);
    publish_everywhere();
    EXPECT_TRUE(spin_until(executor, [this] { return received_ == kNodes * kTopicsPerNode; }));
  }
  received_ = 0;
  {
    rclcpp::executors::EventsCBGExecutor executor;
    add_all(executor);
    publish_everywhere();
    EXPECT_TRUE(spin_until(executor, [this] { return received_ == kNodes * kTopicsPerNode; }));
  }
  for (const auto& subscription : subscriptions_) {
    EXPECT_EQ(subscription->get_publisher_count(), 1u);
  }
}

TEST_F(ManyEntitiesTest, TheIdleOnesDoNotWakeTheExecutor) {
  rclcpp::executors::SingleThreadedExecutor executor;
  add_all(executor);
  auto counter = std::make_shared<WaitCounter>();
  nodes_[0]->get_node_waitables_interface()->add_waitable(counter, nullptr);
  executor.spin_all(std::chrono::nanoseconds(0));
  const int before = counter->waits;
  constexpr size_t kMessages = 200;
  UInt64 message;
  message.data = 1;
  const auto start = std::chrono::steady_clock::now();
  for (size_t i = 1; i <= kMessages; ++i) {
    publishers_[i]->publish(message);
    while (received_ < i) {
      executor.spin_once(kPatience);
    }
  }
  const auto took = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
  RecordProperty("us_per_message", static_cast<int>(took.count() / kMessages));
  // One wait for each message, and from time to time one that finds nothing more.
  EXPECT_LE(counter->waits - before, static_cast<int>(3 * kMessages));
}

}  // namespace
