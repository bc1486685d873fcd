// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <memory>
#include <numeric>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <rclcpp/experimental/intra_process_manager.hpp>
#include <std_msgs/msg/string.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::IntraProcessBufferType;
using rclcpp::IntraProcessSetting;
using rclcpp::MessageInfo;
using std_msgs::msg::String;
using testing::ElementsAre;
using testing::Ne;

namespace {

String message_with(const std::string& text) {
  String message;
  message.data = text;
  return message;
}

std::unique_ptr<String> owned(const std::string& text) {
  return std::make_unique<String>(message_with(text));
}

// Subscriptions note the addresses of the messages that they get.
class IntraProcessTest : public RosTest {
 protected:
  using Addresses = std::vector<const void*>;

  IntraProcessTest() { executor_.add_node(node_); }

  rclcpp::Subscription<String>::SharedPtr read_only(Addresses& addresses) {
    return node_->create_subscription<String>(
        "topic", 10, [&addresses](String::ConstSharedPtr message) { addresses.push_back(message.get()); });
  }
  rclcpp::Subscription<String>::SharedPtr owning(Addresses& addresses) {
    return node_->create_subscription<String>(
        "topic", 10, [&addresses](String::UniquePtr message) { addresses.push_back(message.get()); });
  }

  void spin_until_got(std::initializer_list<const Addresses*> all) {
    ASSERT_TRUE(spin_until(executor_, [&] {
      return std::all_of(all.begin(), all.end(), [](const Addresses* addresses) { return !addresses->empty(); });
    }));
  }

  rclcpp::Node::SharedPtr node_ =
      std::make_shared<rclcpp::Node>("node", rclcpp::NodeOptions().use_intra_process_comms(true));
  rclcpp::executors::SingleThreadedExecutor executor_;
  // Subscriptions may keep messages, so that no address occurs twice.
  std::vector<String::ConstSharedPtr> kept_;
};

TEST_F(IntraProcessTest, AUniqueMessageReachesOneOwnerUncopied) {
  Addresses got;
  const auto subscription = owning(got);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 1U);
  auto message = owned("hello");
  const void* const address = message.get();
  publisher->publish(std::move(message));
  spin_until_got({&got});
  EXPECT_THAT(got, ElementsAre(address));
}

TEST_F(IntraProcessTest, AllReadersShareOneMessage) {
  Addresses first;
  Addresses second;
  Addresses by_reference;
  [[maybe_unused]] const auto subscriptions = {read_only(first), read_only(second)};
  const auto referring = node_->create_subscription<String>(
      "topic", 10, [&by_reference](const String& message) { by_reference.push_back(&message); });
  const auto publisher = node_->create_publisher<String>("topic", 10);
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 3U);
  auto message = owned("hello");
  const void* const address = message.get();
  publisher->publish(std::move(message));
  spin_until_got({&first, &second, &by_reference});
  EXPECT_THAT(first, ElementsAre(address));
  EXPECT_THAT(second, ElementsAre(address));
  EXPECT_THAT(by_reference, ElementsAre(address));
}

TEST_F(IntraProcessTest, OwnersGetCopiesAndOneOfThemTheMessage) {
  std::vector<String::UniquePtr> got;
  const auto keep = [&got](String::UniquePtr message) { got.push_back(std::move(message)); };
  const auto one = node_->create_subscription<String>("topic", 10, keep);
  const auto two = node_->create_subscription<String>("topic", 10, keep);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  auto message = owned("hello");
  const void* const address = message.get();
  publisher->publish(std::move(message));
  ASSERT_TRUE(spin_until(executor_, [&] { return got.size() == 2; }));
  EXPECT_THAT(got, testing::Contains(testing::Truly([&](const auto& own) { return own.get() == address; })));
  EXPECT_NE(got[0], got[1]);
  EXPECT_EQ(got[0]->data, "hello");
  EXPECT_EQ(got[1]->data, "hello");
}

TEST_F(IntraProcessTest, AnOwnerGetsTheMessageAndReadersShareACopy) {
  Addresses owner;
  const auto owning_subscription = owning(owner);
  const auto keep = [this](String::ConstSharedPtr message) { kept_.push_back(std::move(message)); };
  const auto one = node_->create_subscription<String>("topic", 10, keep);
  const auto two = node_->create_subscription<String>("topic", 10, keep);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  auto message = owned("hello");
  const void* const address = message.get();
  publisher->publish(std::move(message));
  ASSERT_TRUE(spin_until(executor_, [&] { return kept_.size() == 2 && !owner.empty(); }));
  EXPECT_THAT(owner, ElementsAre(address));
  EXPECT_EQ(kept_[0], kept_[1]);
  EXPECT_THAT(kept_[0].get(), Ne(address));
  EXPECT_EQ(kept_[0]->data, "hello");
}

TEST_F(IntraProcessTest, AMessageThatThePublisherKeepsIsCopied) {
  Addresses got;
  const auto subscription = read_only(got);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  const String message = message_with("hello");
  publisher->publish(message);
  spin_until_got({&got});
  EXPECT_THAT(got, ElementsAre(Ne(&message)));
}

TEST_F(IntraProcessTest, MessagesSayWhereTheyCameFrom) {
  std::vector<bool> from_intra_process;
  const auto note = [&](const String&, const MessageInfo& info) {
    from_intra_process.push_back(info.get_rmw_message_info().from_intra_process);
  };
  const auto subscription = node_->create_subscription<String>("topic", 10, note);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  publisher->publish(owned("hello"));
  ASSERT_TRUE(spin_until(executor_, [&] { return !from_intra_process.empty(); }));
  EXPECT_THAT(from_intra_process, ElementsAre(true));
}

// The other node does not take part, so the middleware must write, and it delivers to all subscriptions.
TEST_F(IntraProcessTest, OthersAreReachedThroughTheMiddlewareAndNobodyTwice) {
  const auto other = std::make_shared<rclcpp::Node>("other");
  executor_.add_node(other);
  std::vector<std::string> near;
  std::vector<std::string> far;
  const auto near_subscription =
      node_->create_subscription<String>("topic", 10, [&near](const String& m) { near.push_back(m.data); });
  const auto far_subscription =
      other->create_subscription<String>("topic", 10, [&far](const String& m) { far.push_back(m.data); });
  const auto publisher = node_->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 2; }));
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 1U);
  publisher->publish(owned("a"));
  publisher->publish(message_with("b"));
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  ASSERT_TRUE(spin_until(executor_, [&] { return far.size() == 2; }));
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_THAT(near, ElementsAre("a", "b"));
  EXPECT_THAT(far, ElementsAre("a", "b"));
}

TEST_F(IntraProcessTest, ReceivesFromPublishersThatDoNotTakePart) {
  const auto other = std::make_shared<rclcpp::Node>("other");
  std::vector<std::string> got;
  const auto subscription =
      node_->create_subscription<String>("topic", 10, [&got](const String& m) { got.push_back(m.data); });
  const auto publisher = other->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 0U);
  publisher->publish(owned("a"));
  ASSERT_TRUE(spin_until(executor_, [&] { return !got.empty(); }));
  EXPECT_THAT(got, ElementsAre("a"));
}

TEST_F(IntraProcessTest, OptionsWinOverTheNode) {
  rclcpp::PublisherOptions never;
  never.use_intra_process_comm = IntraProcessSetting::Disable;
  Addresses got;
  const auto subscription = read_only(got);
  EXPECT_EQ(node_->create_publisher<String>("topic", 10, never)->get_intra_process_subscription_count(), 0U);

  const auto other = std::make_shared<rclcpp::Node>("other");
  rclcpp::PublisherOptions always;
  always.use_intra_process_comm = IntraProcessSetting::Enable;
  EXPECT_EQ(other->create_publisher<String>("topic", 10, always)->get_intra_process_subscription_count(), 1U);
  EXPECT_EQ(other->create_publisher<String>("topic", 10)->get_intra_process_subscription_count(), 0U);
}

TEST_F(IntraProcessTest, OnlyWhatMatchesByTopicAndQosIsConnected) {
  const auto nothing = [](const String&) {};
  const auto elsewhere = node_->create_subscription<String>("elsewhere", 10, nothing);
  const auto latched = node_->create_subscription<String>("topic", rclcpp::QoS(1).transient_local(), nothing);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 0U);
  auto late = node_->create_subscription<String>("topic", rclcpp::QoS(10).best_effort(), nothing);
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 1U);
  late.reset();
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 0U);
}

TEST_F(IntraProcessTest, ANewMessageTakesThePlaceOfTheOldestWhenTheQueueIsFull) {
  std::vector<std::string> got;
  const auto subscription =
      node_->create_subscription<String>("topic", 2, [&got](const String& m) { got.push_back(m.data); });
  const auto publisher = node_->create_publisher<String>("topic", 10);
  EXPECT_EQ(publisher->lowest_available_ipm_capacity(), 2U);
  publisher->publish(owned("a"));
  EXPECT_EQ(publisher->lowest_available_ipm_capacity(), 1U);
  publisher->publish(owned("b"));
  publisher->publish(owned("c"));
  ASSERT_TRUE(spin_until(executor_, [&] { return got.size() == 2; }));
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_THAT(got, ElementsAre("b", "c"));
}

TEST_F(IntraProcessTest, LateSubscribersGetTransientLocalMessagesOnce) {
  const auto qos = rclcpp::QoS(2).transient_local();
  const auto publisher = node_->create_publisher<String>("latched", qos);
  publisher->publish(owned("a"));
  publisher->publish(owned("b"));
  publisher->publish(message_with("c"));
  std::vector<std::string> got;
  std::vector<bool> from_intra_process;
  const auto note = [&](String::ConstSharedPtr message, const MessageInfo& info) {
    got.push_back(message->data);
    from_intra_process.push_back(info.get_rmw_message_info().from_intra_process);
  };
  const auto subscription = node_->create_subscription<String>("latched", qos, note);
  ASSERT_TRUE(spin_until(executor_, [&] { return got.size() == 2; }));
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));  // the middleware has delivered too
  publisher->publish(owned("d"));
  ASSERT_TRUE(spin_until(executor_, [&] { return got.size() == 3; }));
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_THAT(got, ElementsAre("b", "c", "d"));
  EXPECT_THAT(from_intra_process, ElementsAre(true, true, true));
}

TEST_F(IntraProcessTest, RefusesAQosThatItCannotKeep) {
  const auto message_of = [](auto create) {
    try {
      create();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("no exception");
  };
  EXPECT_EQ(message_of([this] { node_->create_publisher<String>("topic", rclcpp::QoS(rclcpp::KeepAll())); }),
            "intraprocess communication on topic '/topic' allowed only with keep last history qos policy");
  EXPECT_EQ(message_of([this] {
              node_->create_subscription<String>("topic", rclcpp::QoS(rclcpp::KeepAll()), [](const String&) {});
            }),
            "intraprocess communication on topic '/topic' allowed only with keep last history qos policy");
}

TEST_F(IntraProcessTest, TheBufferHoldsWhatTheOptionsSay) {
  Addresses got;
  rclcpp::SubscriptionOptions options;
  options.intra_process_buffer_type = IntraProcessBufferType::UniquePtr;
  const auto own = node_->create_subscription<String>(
      "topic", 10, [this](String::ConstSharedPtr message) { kept_.push_back(std::move(message)); }, options);
  const auto also_own = node_->create_subscription<String>(
      "topic", 10, [this](String::ConstSharedPtr message) { kept_.push_back(std::move(message)); }, options);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  publisher->publish(owned("hello"));
  ASSERT_TRUE(spin_until(executor_, [&] { return kept_.size() == 2; }));
  EXPECT_NE(kept_[0], kept_[1]);
}

TEST_F(IntraProcessTest, ACallbackForBytesIsServedByTheMiddleware) {
  std::vector<size_t> sizes;
  const auto subscription = node_->create_subscription<String>(
      "topic", 10, [&sizes](const rclcpp::SerializedMessage& bytes) { sizes.push_back(bytes.size()); });
  const auto publisher = node_->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  EXPECT_EQ(publisher->get_intra_process_subscription_count(), 0U);
  publisher->publish(owned("abc"));
  ASSERT_TRUE(spin_until(executor_, [&] { return !sizes.empty(); }));
  EXPECT_THAT(sizes, ElementsAre(12U));  // header, length, three characters and the end of the string
}

TEST_F(IntraProcessTest, BytesCannotBePublished) {
  const auto publisher = node_->create_publisher<String>("topic", 10);
  try {
    publisher->publish(rclcpp::SerializedMessage());
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "storing serialized messages in intra process is not supported yet");
  }
}

TEST_F(IntraProcessTest, NothingIsDeliveredAfterTheEndOfTheSubscription) {
  Addresses got;
  auto subscription = read_only(got);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  publisher->publish(owned("a"));
  executor_.spin_some();
  EXPECT_EQ(got.size(), 1U);
  publisher->publish(owned("b"));
  subscription.reset();
  publisher->publish(owned("c"));
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_EQ(got.size(), 1U);
}

template <typename ExecutorT>
class IntraProcessExecutorTest : public RosTest {};

using Executors = testing::Types<rclcpp::executors::SingleThreadedExecutor, rclcpp::executors::MultiThreadedExecutor,
                                 rclcpp::executors::StaticSingleThreadedExecutor, rclcpp::executors::EventsCBGExecutor,
                                 rclcpp::experimental::executors::EventsExecutor>;
TYPED_TEST_SUITE(IntraProcessExecutorTest, Executors);

TYPED_TEST(IntraProcessExecutorTest, DeliversEveryMessageInItsOrder) {
  const auto node = std::make_shared<rclcpp::Node>("node", rclcpp::NodeOptions().use_intra_process_comms(true));
  TypeParam executor;
  executor.add_node(node);
  std::vector<int> got;
  const auto subscription = node->create_subscription<String>(
      "topic", 100, [&got](String::UniquePtr message) { got.push_back(std::stoi(message->data)); });
  const auto publisher = node->create_publisher<String>("topic", 100);
  std::vector<int> expected(50);
  std::iota(expected.begin(), expected.end(), 0);
  for (const int i : expected) {
    publisher->publish(owned(std::to_string(i)));
  }
  EXPECT_TRUE(spin_until(executor, [&] { return got.size() == expected.size(); }));
  EXPECT_EQ(got, expected);
}

TEST_F(IntraProcessTest, TellsOthersThanExecutorsOfMessages) {
  Addresses got;
  const auto subscription = read_only(got);
  const auto publisher = node_->create_publisher<String>("topic", 10);
  publisher->publish(owned("a"));
  publisher->publish(owned("b"));
  size_t announced = 0;
  const auto waitable = subscription->get_intra_process_waitable();
  waitable->set_on_ready_callback([&announced](size_t count, int) { announced += count; });
  EXPECT_EQ(announced, 2U);
  publisher->publish(owned("c"));
  EXPECT_EQ(announced, 3U);
  for (size_t i = 0; i < announced; ++i) {
    waitable->execute(waitable->take_data_by_entity_id(0));
  }
  EXPECT_EQ(got.size(), 3U);
  EXPECT_EQ(waitable->take_data(), nullptr);
  waitable->clear_on_ready_callback();
  publisher->publish(owned("d"));
  EXPECT_EQ(announced, 3U);
}

}  // namespace
