// SPDX-License-Identifier: Apache-2.0
// Publishing and taking between contexts, which are different participants.
#include <chrono>
#include <thread>
#include <vector>

#include "rmw_test.hpp"
#include "std_msgs/msg/string.hpp"
#include "std_msgs/msg/u_int64.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rmw_test::Context;
using rmw_test::Node;
using rmw_test::Publisher;
using rmw_test::Subscription;
using rmw_test::take_error;
using std_msgs::msg::String;
using std_msgs::msg::UInt64;

constexpr rmw_time_t kNoWait{0, 0};

class Topic : public testing::Test {
 protected:
  test_support::Sandbox sandbox_;
  Context sending_context_;
  Context receiving_context_;
  Node sender_{sending_context_, "sender"};
  Node receiver_{receiving_context_, "receiver"};
};

// Returns when both ends know each other.
template <typename Message>
void wait_for_match(Publisher<Message>& publisher, Subscription<Message>& subscription, size_t publishers = 1) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(rmw_test::kPatience.sec);
  while (publisher.matched() == 0 || subscription.matched() < publishers) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the endpoints do not match";
    std::this_thread::yield();
  }
}

// The graph knows an endpoint before it is matched.
TEST_F(Topic, AMatchIsAChangeOfTheGraph) {
  for (int i = 0; i < 50; ++i) {
    const std::string topic = "/chatter_" + std::to_string(i);
    Publisher<String> publisher(sender_, topic.c_str());
    Subscription<String> subscription(receiver_, topic.c_str());
    sender_.wait_for_graph([&] { return publisher.matched() == 1; });
    receiver_.wait_for_graph([&] { return subscription.matched() == 1; });
  }
}

String text(const std::string& data) {
  String message;
  message.data = data;
  return message;
}

TEST_F(Topic, CarriesMessagesInOrderWithTheirInformation) {
  Publisher<String> publisher(sender_, "/chatter");
  Subscription<String> subscription(receiver_, "/chatter");
  wait_for_match(publisher, subscription);
  rmw_time_point_value_t before = 0;
  ASSERT_EQ(rcutils_system_time_now(&before), RCUTILS_RET_OK);
  for (int i = 1; i <= 3; ++i) {
    publisher.publish(text("message " + std::to_string(i)));
    rmw_message_info_t info;
    EXPECT_EQ(subscription.next(&info).data, "message " + std::to_string(i));
    EXPECT_GE(info.source_timestamp, before);
    EXPECT_GE(info.received_timestamp, info.source_timestamp);
    EXPECT_EQ(info.publication_sequence_number, static_cast<uint64_t>(i));
    EXPECT_EQ(info.reception_sequence_number, RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED);
    EXPECT_FALSE(info.from_intra_process);
    rmw_gid_t gid;
    ASSERT_EQ(rmw_get_gid_for_publisher(publisher.handle, &gid), RMW_RET_OK);
    bool same = false;
    ASSERT_EQ(rmw_compare_gids_equal(&gid, &info.publisher_gid, &same), RMW_RET_OK);
    EXPECT_TRUE(same);
  }
  String message;
  EXPECT_FALSE(subscription.take(message));
}

TEST_F(Topic, KeepsOnlyTheLastMessagesOfTheDepth) {
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.depth = 2;
  Publisher<UInt64> publisher(sender_, "/count", qos);
  Subscription<UInt64> subscription(receiver_, "/count", qos);
  wait_for_match(publisher, subscription);
  UInt64 message;
  for (message.data = 1; message.data <= 5; ++message.data) {
    publisher.publish(message);
  }
  ASSERT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
  EXPECT_EQ(subscription.next().data, 4u);
  EXPECT_EQ(subscription.next().data, 5u);
  EXPECT_FALSE(subscription.take(message));
}

TEST_F(Topic, GivesTransientLocalMessagesToLateJoiners) {
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  Publisher<String> publisher(sender_, "/latched", qos);
  publisher.publish(text("early"));
  Subscription<String> subscription(receiver_, "/latched", qos);
  EXPECT_EQ(subscription.next().data, "early");
}

TEST_F(Topic, DoesNotMatchABestEffortPublisherWithAReliableSubscription) {
  rmw_qos_profile_t best_effort = rmw_qos_profile_default;
  best_effort.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  Publisher<String> publisher(sender_, "/chatter", best_effort);
  Subscription<String> reliable(receiver_, "/chatter");
  Subscription<String> matching(receiver_, "/chatter", best_effort);
  wait_for_match(publisher, matching);
  // Discovery has found both subscriptions, in this order.
  receiver_.wait_for_graph([&] { return receiver_.count_publishers("/chatter") == 1; });
  EXPECT_EQ(publisher.matched(), 1u);
  EXPECT_EQ(reliable.matched(), 0u);
}

TEST_F(Topic, CanIgnorePublishersOfTheSameContext) {
  Publisher<String> local(receiver_, "/chatter");
  Publisher<String> remote(sender_, "/chatter");
  Subscription<String> subscription(receiver_, "/chatter", rmw_qos_profile_default, true);
  wait_for_match(local, subscription, 2);
  wait_for_match(remote, subscription, 2);
  local.publish(text("local"));
  ASSERT_EQ(rmw_publisher_wait_for_all_acked(local.handle, rmw_test::kPatience), RMW_RET_OK);
  String message;
  EXPECT_FALSE(subscription.take(message));
  remote.publish(text("remote"));
  EXPECT_EQ(subscription.next().data, "remote");
}

TEST_F(Topic, CarriesSerializedMessages) {
  Publisher<String> publisher(sender_, "/chatter");
  Subscription<String> subscription(receiver_, "/chatter");
  wait_for_match(publisher, subscription);
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  rmw_serialized_message_t bytes = rmw_get_zero_initialized_serialized_message();
  ASSERT_EQ(rmw_serialized_message_init(&bytes, 0, &allocator), RCUTILS_RET_OK);
  const auto* type_support = rosidl_typesupport_cpp::get_message_type_support_handle<String>();
  const String message = text("abc");
  ASSERT_EQ(rmw_serialize(&message, type_support, &bytes), RMW_RET_OK) << take_error();
  // Encapsulation of little-endian CDR, the length with the terminating null, the characters.
  const std::vector<uint8_t> expected{0, 1, 0, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0};
  EXPECT_EQ(std::vector<uint8_t>(bytes.buffer, bytes.buffer + bytes.buffer_length), expected);

  ASSERT_EQ(rmw_publish_serialized_message(publisher.handle, &bytes, nullptr), RMW_RET_OK);
  EXPECT_EQ(subscription.next().data, "abc");

  publisher.publish(text("defg"));
  ASSERT_EQ(subscription.wait(rmw_test::kPatience), RMW_RET_OK);
  bool taken = false;
  ASSERT_EQ(rmw_take_serialized_message(subscription.handle, &bytes, &taken, nullptr), RMW_RET_OK);
  EXPECT_TRUE(taken);
  String received;
  ASSERT_EQ(rmw_deserialize(&bytes, type_support, &received), RMW_RET_OK) << take_error();
  EXPECT_EQ(received.data, "defg");

  bytes.buffer_length = 6;
  EXPECT_EQ(rmw_deserialize(&bytes, type_support, &received), RMW_RET_ERROR);
  EXPECT_EQ(take_error(), "the bytes are no serialized message of this type");
  EXPECT_EQ(rmw_serialized_message_fini(&bytes), RCUTILS_RET_OK);
}

TEST_F(Topic, CarriesMessagesThatGrowBeyondAnyInitialBuffer) {
  Publisher<String> publisher(sender_, "/chatter");
  Subscription<String> subscription(receiver_, "/chatter");
  wait_for_match(publisher, subscription);
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, std::size_t{3'000'000}, std::size_t{10}}) {
    const String message = text(std::string(size, 'x'));
    publisher.publish(message);
    EXPECT_EQ(subscription.next(), message);
  }
}

TEST_F(Topic, WakesAWaitFromAnotherThread) {
  Publisher<UInt64> ping(sender_, "/ping");
  Subscription<UInt64> ping_subscription(receiver_, "/ping");
  Publisher<UInt64> pong(receiver_, "/pong");
  Subscription<UInt64> pong_subscription(sender_, "/pong");
  wait_for_match(ping, ping_subscription);
  wait_for_match(pong, pong_subscription);
  constexpr uint64_t kRounds = 1000;
  std::thread echo([&] {
    for (uint64_t i = 0; i < kRounds; ++i) {
      pong.publish(ping_subscription.next());
    }
  });
  UInt64 message;
  for (message.data = 0; message.data < kRounds; ++message.data) {
    ping.publish(message);
    ASSERT_EQ(pong_subscription.next().data, message.data);
  }
  echo.join();
}

TEST_F(Topic, ReportsItsActualQos) {
  rmw_qos_profile_t qos = rmw_qos_profile_sensor_data;
  qos.deadline = {1, 500000000};
  qos.lifespan = {2, 0};
  Publisher<String> publisher(sender_, "/chatter", qos);
  rmw_qos_profile_t actual;
  ASSERT_EQ(rmw_publisher_get_actual_qos(publisher.handle, &actual), RMW_RET_OK);
  EXPECT_EQ(actual.history, RMW_QOS_POLICY_HISTORY_KEEP_LAST);
  EXPECT_EQ(actual.depth, 5u);
  EXPECT_EQ(actual.reliability, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT);
  EXPECT_EQ(actual.durability, RMW_QOS_POLICY_DURABILITY_VOLATILE);
  EXPECT_EQ(actual.liveliness, RMW_QOS_POLICY_LIVELINESS_AUTOMATIC);
  EXPECT_TRUE(rmw_time_equal(actual.deadline, qos.deadline));
  EXPECT_TRUE(rmw_time_equal(actual.lifespan, qos.lifespan));
  EXPECT_TRUE(rmw_time_equal(actual.liveliness_lease_duration, RMW_DURATION_INFINITE));
}

TEST_F(Topic, TakesTheBestAvailableQos) {
  Publisher<String> publisher(sender_, "/chatter", rmw_qos_profile_sensor_data);
  receiver_.wait_for_graph([this] { return receiver_.count_publishers("/chatter") == 1; });
  Subscription<String> subscription(receiver_, "/chatter", rmw_qos_profile_best_available);
  rmw_qos_profile_t actual;
  ASSERT_EQ(rmw_subscription_get_actual_qos(subscription.handle, &actual), RMW_RET_OK);
  EXPECT_EQ(actual.reliability, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT);
  EXPECT_EQ(actual.durability, RMW_QOS_POLICY_DURABILITY_VOLATILE);
  EXPECT_EQ(actual.liveliness, RMW_QOS_POLICY_LIVELINESS_AUTOMATIC);
  EXPECT_TRUE(rmw_time_equal(actual.deadline, RMW_DURATION_INFINITE));
  wait_for_match(publisher, subscription);

  Publisher<String> best(sender_, "/best", rmw_qos_profile_best_available);
  ASSERT_EQ(rmw_publisher_get_actual_qos(best.handle, &actual), RMW_RET_OK);
  EXPECT_EQ(actual.reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE);
  EXPECT_EQ(actual.durability, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
}

// Participants of one process write into each other's memory in Fast DDS: none must end before the other knows about
// it.
TEST(Contexts, EndOneAfterAnotherInOneProcess) {
  test_support::Sandbox sandbox;
  for (int i = 0; i < 100; ++i) {
    Context first_context;
    Context second_context;
    Node first(first_context, "first");
    Node second(second_context, "second");
  }
}

TEST_F(Topic, RefusesAnotherTypeInTheSameContext) {
  Publisher<String> publisher(sender_, "/chatter");
  const rmw_publisher_options_t options = rmw_get_default_publisher_options();
  EXPECT_EQ(rmw_create_publisher(sender_.handle, rosidl_typesupport_cpp::get_message_type_support_handle<UInt64>(),
                                 "/chatter", &rmw_qos_profile_default, &options),
            nullptr);
  EXPECT_EQ(take_error(),
            "topic 'rt/chatter' is in use with type 'std_msgs::msg::dds_::String_' and cannot have type "
            "'std_msgs::msg::dds_::UInt64_' as well");
}

TEST_F(Topic, RefusesAWrongNameAndAnUnknownPolicy) {
  const rmw_publisher_options_t options = rmw_get_default_publisher_options();
  const auto* type_support = rosidl_typesupport_cpp::get_message_type_support_handle<String>();
  EXPECT_EQ(rmw_create_publisher(sender_.handle, type_support, "chatter", &rmw_qos_profile_default, &options), nullptr);
  EXPECT_EQ(take_error(), "invalid topic name 'chatter': topic name must be absolute: it must begin with a '/'");
  EXPECT_EQ(rmw_create_publisher(sender_.handle, type_support, "/chatter", &rmw_qos_profile_unknown, &options),
            nullptr);
  EXPECT_EQ(take_error(), "history 'unknown' cannot be asked for");
}

TEST_F(Topic, CountsEndpointsOfTheWholeSystem) {
  Publisher<String> publisher(sender_, "/chatter");
  Publisher<String> second(sender_, "/chatter");
  {
    Subscription<String> subscription(receiver_, "/chatter");
    receiver_.wait_for_graph([&] { return receiver_.count_publishers("/chatter") == 2; });
    sender_.wait_for_graph([&] { return sender_.count_subscribers("/chatter") == 1; });
    EXPECT_EQ(receiver_.count_subscribers("/chatter"), 1u);
  }
  sender_.wait_for_graph([&] { return sender_.count_subscribers("/chatter") == 0; });
}

TEST_F(Topic, IsGoneWithTheLastNodeAndBackWithTheNext) {
  Context context;
  {
    Node node(context, "first");
    Publisher<String> publisher(node, "/chatter");
    receiver_.wait_for_graph([&] { return receiver_.count_publishers("/chatter") == 1; });
  }
  receiver_.wait_for_graph([&] { return receiver_.count_publishers("/chatter") == 0; });
  Node node(context, "second");
  Publisher<String> publisher(node, "/chatter");
  receiver_.wait_for_graph([&] { return receiver_.count_publishers("/chatter") == 1; });
}

TEST_F(Topic, WaitsNoLongerThanItsTimeout) {
  Subscription<String> subscription(receiver_, "/chatter");
  EXPECT_EQ(subscription.wait(kNoWait), RMW_RET_TIMEOUT);
  EXPECT_EQ(subscription.wait({0, 1000000}), RMW_RET_TIMEOUT);
}

TEST_F(Topic, IsNoLongerReadyWhenAllIsTaken) {
  Publisher<String> publisher(sender_, "/chatter");
  Subscription<String> subscription(receiver_, "/chatter");
  wait_for_match(publisher, subscription);
  for (int i = 0; i < 3; ++i) {
    publisher.publish(text("one"));
    publisher.publish(text("two"));
    EXPECT_EQ(subscription.next().data, "one");
    EXPECT_EQ(subscription.next().data, "two");
    EXPECT_EQ(subscription.wait(kNoWait), RMW_RET_TIMEOUT);
  }
}

TEST_F(Topic, GuardConditionsWakeOnceAndAreReset) {
  rmw_guard_condition_t* condition = rmw_create_guard_condition(&sending_context_.handle);
  rmw_wait_set_t* wait_set = rmw_create_wait_set(&sending_context_.handle, 1);
  ASSERT_EQ(rmw_trigger_guard_condition(condition), RMW_RET_OK);
  ASSERT_EQ(rmw_trigger_guard_condition(condition), RMW_RET_OK);
  void* entity = condition->data;
  rmw_guard_conditions_t guard_conditions{1, &entity};
  EXPECT_EQ(rmw_wait(nullptr, &guard_conditions, nullptr, nullptr, nullptr, wait_set, &rmw_test::kPatience),
            RMW_RET_OK);
  EXPECT_EQ(entity, condition->data);
  EXPECT_EQ(rmw_wait(nullptr, &guard_conditions, nullptr, nullptr, nullptr, wait_set, &kNoWait), RMW_RET_TIMEOUT);
  EXPECT_EQ(entity, nullptr);
  std::thread other([&] { EXPECT_EQ(rmw_trigger_guard_condition(condition), RMW_RET_OK); });
  entity = condition->data;
  EXPECT_EQ(rmw_wait(nullptr, &guard_conditions, nullptr, nullptr, nullptr, wait_set, nullptr), RMW_RET_OK);
  other.join();
  EXPECT_EQ(rmw_destroy_wait_set(wait_set), RMW_RET_OK);
  EXPECT_EQ(rmw_destroy_guard_condition(condition), RMW_RET_OK);
}

}  // namespace
