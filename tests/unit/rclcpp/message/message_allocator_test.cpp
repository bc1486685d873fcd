// SPDX-License-Identifier: Apache-2.0
// Messages in memory of a user's allocator.
#include <cstddef>
#include <memory>
#include <std_msgs/msg/u_int64.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using std_msgs::msg::UInt64;

struct Counts {
  int allocations = 0;
  int deallocations = 0;
};

template <typename T = void>
struct CountingAllocator {
  using value_type = T;

  explicit CountingAllocator(Counts* counts_ = nullptr) : counts(counts_) {}
  template <typename U>
  CountingAllocator(const CountingAllocator<U>& other) : counts(other.counts) {}  // NOLINT: allocators convert

  T* allocate(std::size_t count) {
    if (counts) {
      ++counts->allocations;
    }
    return static_cast<T*>(::operator new(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t) {
    if (counts) {
      ++counts->deallocations;
    }
    ::operator delete(memory);
  }

  Counts* counts;
};

template <typename T, typename U>
bool operator==(const CountingAllocator<T>& one, const CountingAllocator<U>& other) {
  return one.counts == other.counts;
}
template <typename T, typename U>
bool operator!=(const CountingAllocator<T>& one, const CountingAllocator<U>& other) {
  return !(one == other);
}

class MessageAllocator : public RosTest {
 protected:
  Counts sent_;
  Counts received_;
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(MessageAllocator, GivesTheMessagesThatASubscriptionHandsOut) {
  const auto node = std::make_shared<rclcpp::Node>("node");
  executor_.add_node(node);
  rclcpp::SubscriptionOptionsWithAllocator<CountingAllocator<>> options;
  options.allocator = std::make_shared<CountingAllocator<>>(&received_);
  std::vector<std::shared_ptr<const UInt64>> messages;
  auto subscription = node->create_subscription<UInt64>(
      "topic", 10, [&](const std::shared_ptr<const UInt64> message) { messages.push_back(message); }, options);
  const auto publisher = node->create_publisher<UInt64>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  publisher->publish(UInt64());
  publisher->publish(UInt64());
  ASSERT_TRUE(spin_until(executor_, [&] { return messages.size() == 2; }));
  EXPECT_GE(received_.allocations, 2);
  messages.clear();
  subscription.reset();
  EXPECT_EQ(received_.allocations, received_.deallocations);
}

TEST_F(MessageAllocator, GivesTheMessagesThatAPublisherMakes) {
  const auto node = std::make_shared<rclcpp::Node>("node", rclcpp::NodeOptions().use_intra_process_comms(true));
  executor_.add_node(node);
  rclcpp::PublisherOptionsWithAllocator<CountingAllocator<>> publisher_options;
  publisher_options.allocator = std::make_shared<CountingAllocator<>>(&sent_);
  rclcpp::SubscriptionOptionsWithAllocator<CountingAllocator<>> subscription_options;
  subscription_options.allocator = std::make_shared<CountingAllocator<>>(&received_);
  const auto publisher = node->create_publisher<UInt64>("topic", 10, publisher_options);
  std::vector<uint64_t> received;
  const auto subscription = node->create_subscription<UInt64>(
      "topic", 10, [&](const std::shared_ptr<const UInt64> message) { received.push_back(message->data); },
      subscription_options);
  UInt64 message;
  message.data = 5;
  publisher->publish(message);  // within the process a copy must be made
  EXPECT_GE(sent_.allocations, 1);
  ASSERT_TRUE(spin_until(executor_, [&] { return !received.empty(); }));
  EXPECT_EQ(received, std::vector<uint64_t>{5});
  EXPECT_EQ(sent_.allocations + received_.allocations, sent_.deallocations + received_.deallocations);
}

}  // namespace
