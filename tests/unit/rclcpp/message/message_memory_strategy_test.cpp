// SPDX-License-Identifier: Apache-2.0
// Memory strategies of subscriptions.
#include <memory>
#include <memory_resource>
#include <mutex>
#include <rclcpp/strategies/message_pool_memory_strategy.hpp>
#include <set>
#include <std_msgs/msg/string.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <utility>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rclcpp::message_memory_strategy::MessageMemoryStrategy;
using rclcpp::strategies::message_pool_memory_strategy::MessagePoolMemoryStrategy;
using std_msgs::msg::String;
using std_msgs::msg::UInt64;

// Counts what a subscription borrows and returns.
struct Counting : MessageMemoryStrategy<UInt64> {
  using MessageMemoryStrategy::borrow_serialized_message;
  std::shared_ptr<UInt64> borrow_message() override {
    ++borrowed;
    return MessageMemoryStrategy::borrow_message();
  }
  void return_message(std::shared_ptr<UInt64>& message) override {
    returned += message != nullptr;
    MessageMemoryStrategy::return_message(message);
  }
  std::shared_ptr<rclcpp::SerializedMessage> borrow_serialized_message(size_t capacity) override {
    ++borrowed;
    last_capacity = capacity;
    return MessageMemoryStrategy::borrow_serialized_message(capacity);
  }
  void return_serialized_message(std::shared_ptr<rclcpp::SerializedMessage>& message) override {
    returned += message != nullptr;
    MessageMemoryStrategy::return_serialized_message(message);
  }

  int borrowed = 0;
  int returned = 0;
  size_t last_capacity = 0;
};

class MessageMemory : public RosTest {
 protected:
  MessageMemory() { executor_.add_node(node_); }

  template <typename CallbackT, typename StrategyT>
  auto subscribe(CallbackT callback, const std::shared_ptr<StrategyT>& strategy) {
    auto subscription =
        node_->create_subscription<UInt64>("topic", 10, callback, rclcpp::SubscriptionOptions(), strategy);
    EXPECT_TRUE(spin_until(executor_, [&] { return publisher_->get_subscription_count() == 1; }));
    return subscription;
  }

  void publish(std::initializer_list<uint64_t> values) {
    for (const uint64_t value : values) {
      UInt64 message;
      message.data = value;
      publisher_->publish(message);
    }
  }

  // Publishes three messages, and waits until `count` is 3.
  void expect_three(const Counting& strategy, const size_t& count) {
    publish({1, 2, 3});
    ASSERT_TRUE(spin_until(executor_, [&] { return count == 3; }));
    // An executor may look for a message in vain.
    EXPECT_GE(strategy.borrowed, 3);
    EXPECT_EQ(strategy.returned, strategy.borrowed);
  }

  rclcpp::executors::SingleThreadedExecutor executor_;
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::Publisher<UInt64>::SharedPtr publisher_ = node_->create_publisher<UInt64>("topic", 10);
};

TEST_F(MessageMemory, GivesEachMessageAndGetsItBack) {
  const auto strategy = std::make_shared<Counting>();
  size_t count = 0;
  const auto subscription = subscribe([&](const UInt64& message) { EXPECT_EQ(message.data, ++count); }, strategy);
  expect_three(*strategy, count);
}

TEST_F(MessageMemory, GivesMessagesThatTheCallbackKeeps) {
  const auto strategy = std::make_shared<Counting>();
  std::vector<UInt64::ConstSharedPtr> kept;
  size_t count = 0;
  const auto subscription = subscribe(
      [&](const UInt64::ConstSharedPtr message) {
        kept.push_back(message);
        ++count;
      },
      strategy);
  expect_three(*strategy, count);
  for (size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i]->data, i + 1);
    EXPECT_EQ(kept[i].use_count(), 1);
  }
}

TEST_F(MessageMemory, GivesSerializedMessages) {
  const auto strategy = std::make_shared<Counting>();
  strategy->set_default_buffer_capacity(100);
  size_t count = 0;
  const auto subscription = subscribe(
      [&](const std::shared_ptr<const rclcpp::SerializedMessage> message) {
        EXPECT_EQ(message->size(), 12u);
        EXPECT_EQ(message->capacity(), 100u);
        ++count;
      },
      strategy);
  expect_three(*strategy, count);
  EXPECT_EQ(strategy->last_capacity, 100u);
}

TEST_F(MessageMemory, ServesExecutorsOfOthers) {
  const auto strategy = std::make_shared<Counting>();
  const auto subscription = subscribe([](const UInt64&) {}, strategy);
  auto message = subscription->create_message();
  subscription->return_message(message);
  auto bytes = subscription->create_serialized_message();
  subscription->return_serialized_message(bytes);
  EXPECT_EQ(message, nullptr);
  EXPECT_EQ(bytes, nullptr);
  EXPECT_EQ(strategy->borrowed, 2);
  EXPECT_EQ(strategy->returned, 2);
}

TEST_F(MessageMemory, WithoutAStrategyOrWithTheDefaultOneMessagesArrive) {
  size_t count = 0;
  const auto callback = [&](const UInt64& message) { EXPECT_EQ(message.data, ++count); };
  {
    const auto subscription = subscribe(callback, std::shared_ptr<MessageMemoryStrategy<UInt64>>());
    publish({1, 2, 3});
    ASSERT_TRUE(spin_until(executor_, [&] { return count == 3; }));
  }
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher_->get_subscription_count() == 0; }));
  using Strategy = rclcpp::Subscription<UInt64>::MessageMemoryStrategyType;
  const auto subscription = subscribe(callback, Strategy::create_default());
  publish({4});
  ASSERT_TRUE(spin_until(executor_, [&] { return count == 4; }));
}

TEST_F(MessageMemory, OfAPoolIsUsedAgain) {
  const auto pool = std::make_shared<MessagePoolMemoryStrategy<UInt64, 2>>();
  std::set<const UInt64*> addresses;
  size_t count = 0;
  const auto subscription = subscribe(
      [&](const UInt64::ConstSharedPtr message) {
        addresses.insert(message.get());
        EXPECT_EQ(message->data, ++count);
      },
      pool);
  publish({1, 2, 3, 4, 5});
  ASSERT_TRUE(spin_until(executor_, [&] { return count == 5; }));
  EXPECT_LE(addresses.size(), 2u);
}

TEST_F(MessageMemory, OfAPoolIsLimitedToWhatTheCallbackDoesNotKeep) {
  std::vector<UInt64::ConstSharedPtr> kept;
  {
    const auto subscription = subscribe([&](const UInt64::ConstSharedPtr message) { kept.push_back(message); },
                                        std::make_shared<MessagePoolMemoryStrategy<UInt64, 2>>());
    publish({7, 8, 9});
    try {
      spin_until(executor_, [&] { return kept.size() == 3; });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "No more free slots in the pool");
    }
    kept.erase(kept.begin());
    ASSERT_TRUE(spin_until(executor_, [&] { return kept.size() == 2; }));
  }
  // The messages live longer than the strategy.
  EXPECT_EQ(kept[0]->data, 8u);
  EXPECT_EQ(kept[1]->data, 9u);
}

TEST(MessagePool, MakesEachMessageAnew) {
  MessagePoolMemoryStrategy<UInt64, 1> pool;
  auto message = pool.borrow_message();
  message->data = 5;
  pool.return_message(message);
  EXPECT_THROW(pool.borrow_message(), std::runtime_error);
  message.reset();
  EXPECT_EQ(pool.borrow_message()->data, 0u);
}

// Counts the bytes that are in use.
class Counter : public std::pmr::memory_resource {
 public:
  size_t in_use = 0;
  size_t allocations = 0;

 private:
  void* do_allocate(size_t bytes, size_t alignment) override {
    in_use += bytes;
    ++allocations;
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* memory, size_t bytes, size_t alignment) override {
    in_use -= bytes;
    std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

using Allocator = std::pmr::polymorphic_allocator<void>;

TEST_F(MessageMemory, OfAnAllocatorThatCannotBeAssigned) {
  Counter counter;
  const auto allocator = std::make_shared<Allocator>(&counter);
  rclcpp::SubscriptionOptionsWithAllocator<Allocator> options;
  options.allocator = allocator;
  size_t count = 0;
  auto subscription = node_->create_subscription<UInt64>(
      "topic", 10, [&](const UInt64::ConstSharedPtr) { ++count; }, options,
      std::make_shared<MessageMemoryStrategy<UInt64, Allocator>>(allocator));
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher_->get_subscription_count() == 1; }));
  publish({1, 2, 3});
  ASSERT_TRUE(spin_until(executor_, [&] { return count == 3; }));
  EXPECT_GE(counter.allocations, 3u);
  subscription.reset();
  EXPECT_EQ(counter.in_use, 0u);
}

TEST(AllocatorDeleter, TakesTheAllocatorThatItIsGiven) {
  Counter counter;
  std::pmr::polymorphic_allocator<String> allocator(&counter);
  using Deleter = rclcpp::allocator::Deleter<std::pmr::polymorphic_allocator<String>, String>;
  using Traits = rclcpp::allocator::AllocRebind<String, Allocator>;
  Deleter deleter;
  rclcpp::allocator::set_allocator_for_deleter(&deleter, &allocator);
  {
    String* message = Traits::allocate(allocator, 1);
    Traits::construct(allocator, message);
    std::unique_ptr<String, Deleter> owner(message, deleter);
    std::unique_ptr<String, Deleter> other(nullptr, Deleter());
    other = std::move(owner);
    EXPECT_EQ(counter.in_use, sizeof(String));
  }
  EXPECT_EQ(counter.in_use, 0u);
  EXPECT_THROW(rclcpp::allocator::set_allocator_for_deleter(&deleter, static_cast<Allocator*>(nullptr)),
               std::invalid_argument);
}

TEST(AllocatorOfC, TakesItsMemoryFromAnAllocatorOfCpp) {
  Counter counter;
  std::pmr::polymorphic_allocator<char> allocator(&counter);
  const rcutils_allocator_t in_c = rclcpp::allocator::get_rcl_allocator<char>(allocator);
  auto* text = static_cast<char*>(in_c.zero_allocate(3, 7, in_c.state));
  EXPECT_EQ(std::string(text, 21), std::string(21, '\0'));
  EXPECT_GE(counter.in_use, 21u);
  text[20] = 'x';
  text = static_cast<char*>(in_c.reallocate(text, 1000, in_c.state));
  EXPECT_EQ(text[20], 'x');
  EXPECT_GE(counter.in_use, 1000u);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(text) % alignof(std::max_align_t), 0u);
  EXPECT_EQ(in_c.zero_allocate(SIZE_MAX / 2, 4, in_c.state), nullptr);
  in_c.deallocate(text, in_c.state);
  in_c.deallocate(nullptr, in_c.state);
  EXPECT_EQ(counter.in_use, 0u);
  std::allocator<char> standard;
  EXPECT_EQ(rclcpp::allocator::get_rcl_allocator<char>(standard).allocate, rcutils_get_default_allocator().allocate);
}

}  // namespace
