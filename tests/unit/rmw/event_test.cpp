// SPDX-License-Identifier: Apache-2.0
// Events of publishers and subscriptions, and callbacks instead of waiting.
#include <atomic>
#include <vector>

#include "rmw_test.hpp"
#include "std_msgs/msg/int32.hpp"
#include "std_msgs/msg/string.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rmw_test::Context;
using rmw_test::Node;
using rmw_test::Publisher;
using rmw_test::Subscription;
using rmw_test::take_error;
using std_msgs::msg::String;

constexpr rmw_time_t kNoWait{0, 0};

class EventTest : public testing::Test {
 protected:
  EventTest() : wait_set_(rmw_create_wait_set(&context_.handle, 1)) {}
  ~EventTest() override { EXPECT_EQ(rmw_destroy_wait_set(wait_set_), RMW_RET_OK); }

  template <typename Endpoint>
  rmw_event_t event_of(const Endpoint& endpoint, rmw_event_type_t type) {
    rmw_event_t event = rmw_get_zero_initialized_event();
    if constexpr (std::is_same_v<Endpoint, Publisher<String>>) {
      EXPECT_EQ(rmw_publisher_event_init(&event, endpoint.handle, type), RMW_RET_OK) << take_error();
    } else {
      EXPECT_EQ(rmw_subscription_event_init(&event, endpoint.handle, type), RMW_RET_OK) << take_error();
    }
    return event;
  }

  rmw_ret_t wait(const rmw_event_t& event, const rmw_time_t& timeout = rmw_test::kPatience) {
    void* data = event.data;
    rmw_events_t events{1, &data};
    return rmw_wait(nullptr, nullptr, nullptr, nullptr, &events, wait_set_, &timeout);
  }

  template <typename Status>
  static Status take(const rmw_event_t& event) {
    Status status{};
    bool taken = false;
    EXPECT_EQ(rmw_take_event(&event, &status, &taken), RMW_RET_OK);
    EXPECT_TRUE(taken);
    return status;
  }

  test_support::Sandbox sandbox_;
  Context context_;
  Node node_{context_};
  rmw_wait_set_t* wait_set_;
};

rmw_qos_profile_t with_deadline(uint64_t ms) {
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.deadline = {0, ms * 1000000};
  return qos;
}

TEST_F(EventTest, MatchesAreCountedAndTakenOnce) {
  Publisher<String> publisher(node_, "/chatter");
  const rmw_event_t matched = event_of(publisher, RMW_EVENT_PUBLICATION_MATCHED);
  EXPECT_EQ(wait(matched, kNoWait), RMW_RET_TIMEOUT);
  {
    Subscription<String> subscription(node_, "/chatter");
    const rmw_event_t other_side = event_of(subscription, RMW_EVENT_SUBSCRIPTION_MATCHED);
    ASSERT_EQ(wait(matched), RMW_RET_OK);
    const auto status = take<rmw_matched_status_t>(matched);
    EXPECT_EQ(status.total_count, 1u);
    EXPECT_EQ(status.total_count_change, 1u);
    EXPECT_EQ(status.current_count, 1u);
    EXPECT_EQ(status.current_count_change, 1);
    EXPECT_EQ(wait(matched, kNoWait), RMW_RET_TIMEOUT);
    ASSERT_EQ(wait(other_side), RMW_RET_OK);
    EXPECT_EQ(take<rmw_matched_status_t>(other_side).current_count, 1u);
  }
  ASSERT_EQ(wait(matched), RMW_RET_OK);
  const auto status = take<rmw_matched_status_t>(matched);
  EXPECT_EQ(status.total_count, 1u);
  EXPECT_EQ(status.total_count_change, 0u);
  EXPECT_EQ(status.current_count, 0u);
  EXPECT_EQ(status.current_count_change, -1);
}

TEST_F(EventTest, NoPolicyIsIncompatibleBeforeOneIs) {
  Publisher<String> publisher(node_, "/chatter");
  const rmw_event_t offered = event_of(publisher, RMW_EVENT_OFFERED_QOS_INCOMPATIBLE);
  EXPECT_EQ(take<rmw_offered_qos_incompatible_event_status_t>(offered).last_policy_kind, RMW_QOS_POLICY_INVALID);
}

TEST_F(EventTest, BothSidesTellOfIncompatibleQos) {
  Publisher<String> publisher(node_, "/chatter", rmw_qos_profile_sensor_data);
  Subscription<String> subscription(node_, "/chatter");
  const rmw_event_t offered = event_of(publisher, RMW_EVENT_OFFERED_QOS_INCOMPATIBLE);
  const rmw_event_t requested = event_of(subscription, RMW_EVENT_REQUESTED_QOS_INCOMPATIBLE);
  ASSERT_EQ(wait(offered), RMW_RET_OK);
  ASSERT_EQ(wait(requested), RMW_RET_OK);
  const auto offered_status = take<rmw_offered_qos_incompatible_event_status_t>(offered);
  EXPECT_EQ(offered_status.total_count, 1);
  EXPECT_EQ(offered_status.total_count_change, 1);
  EXPECT_EQ(offered_status.last_policy_kind, RMW_QOS_POLICY_RELIABILITY);
  EXPECT_EQ(take<rmw_requested_qos_incompatible_event_status_t>(requested).last_policy_kind,
            RMW_QOS_POLICY_RELIABILITY);
}

TEST_F(EventTest, BothSidesTellOfMissedDeadlines) {
  Publisher<String> publisher(node_, "/chatter", with_deadline(20));
  Subscription<String> subscription(node_, "/chatter", with_deadline(20));
  const rmw_event_t offered = event_of(publisher, RMW_EVENT_OFFERED_DEADLINE_MISSED);
  const rmw_event_t requested = event_of(subscription, RMW_EVENT_REQUESTED_DEADLINE_MISSED);
  publisher.publish(String());
  ASSERT_EQ(wait(offered), RMW_RET_OK);
  EXPECT_GE(take<rmw_offered_deadline_missed_status_t>(offered).total_count, 1);
  ASSERT_EQ(wait(requested), RMW_RET_OK);
  const auto status = take<rmw_requested_deadline_missed_status_t>(requested);
  EXPECT_GE(status.total_count, 1);
  EXPECT_EQ(status.total_count, status.total_count_change);
}

TEST_F(EventTest, BothSidesTellOfLostLiveliness) {
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.liveliness = RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC;
  qos.liveliness_lease_duration = {0, 50000000};
  Publisher<String> publisher(node_, "/chatter", qos);
  Subscription<String> subscription(node_, "/chatter", qos);
  const rmw_event_t lost = event_of(publisher, RMW_EVENT_LIVELINESS_LOST);
  const rmw_event_t changed = event_of(subscription, RMW_EVENT_LIVELINESS_CHANGED);
  ASSERT_EQ(rmw_publisher_assert_liveliness(publisher.handle), RMW_RET_OK);
  ASSERT_EQ(wait(lost), RMW_RET_OK);
  EXPECT_GE(take<rmw_liveliness_lost_status_t>(lost).total_count, 1);
  // It comes alive and then ends: that is one event or two.
  rmw_liveliness_changed_status_t status{};
  while (status.not_alive_count == 0) {
    ASSERT_EQ(wait(changed), RMW_RET_OK);
    status = take<rmw_liveliness_changed_status_t>(changed);
  }
  EXPECT_EQ(status.alive_count, 0);
  EXPECT_EQ(status.not_alive_count, 1);
}

TEST_F(EventTest, UnknownTypesAreRefused) {
  Publisher<String> publisher(node_, "/chatter");
  Subscription<String> subscription(node_, "/chatter");
  rmw_event_t event = rmw_get_zero_initialized_event();
  EXPECT_EQ(rmw_publisher_event_init(&event, publisher.handle, RMW_EVENT_SUBSCRIPTION_INCOMPATIBLE_TYPE),
            RMW_RET_UNSUPPORTED);
  EXPECT_EQ(take_error(), "provided event_type is not supported for a publisher");
  EXPECT_EQ(rmw_subscription_event_init(&event, subscription.handle, RMW_EVENT_LIVELINESS_LOST), RMW_RET_UNSUPPORTED);
  EXPECT_EQ(take_error(), "provided event_type is not supported for a subscription");
  EXPECT_FALSE(rmw_event_type_is_supported(RMW_EVENT_INVALID));
  EXPECT_TRUE(rmw_event_type_is_supported(RMW_EVENT_MESSAGE_LOST));
}

TEST_F(EventTest, BothSidesHearOfAnotherTypeOnTheirTopic) {
  Context other_context;
  Node other_node(other_context, "other");
  Publisher<String> publisher(node_, "/chatter");
  Subscription<std_msgs::msg::Int32> other(other_node, "/chatter");
  const rmw_event_t of_publisher = event_of(publisher, RMW_EVENT_PUBLISHER_INCOMPATIBLE_TYPE);
  const rmw_event_t of_subscription = event_of(other, RMW_EVENT_SUBSCRIPTION_INCOMPATIBLE_TYPE);
  ASSERT_EQ(wait(of_publisher), RMW_RET_OK);
  EXPECT_EQ(take<rmw_incompatible_type_status_t>(of_publisher).total_count, 1);
  ASSERT_EQ(wait(of_subscription), RMW_RET_OK);
  EXPECT_EQ(take<rmw_incompatible_type_status_t>(of_subscription).total_count_change, 1);
  EXPECT_EQ(wait(of_subscription, kNoWait), RMW_RET_TIMEOUT);

  // A subscription that is made later gets the event for the earlier publisher.
  Subscription<std_msgs::msg::Int32> later(other_node, "/chatter");
  const rmw_event_t of_later = event_of(later, RMW_EVENT_SUBSCRIPTION_INCOMPATIBLE_TYPE);
  EXPECT_EQ(wait(of_later, kNoWait), RMW_RET_OK);
  ASSERT_EQ(wait(of_publisher), RMW_RET_OK);
  EXPECT_EQ(take<rmw_incompatible_type_status_t>(of_publisher).total_count, 2);
}

void count(const void* user_data, size_t number_of_events) {
  *static_cast<std::atomic<size_t>*>(const_cast<void*>(user_data)) += number_of_events;
}

TEST_F(EventTest, CallbacksAreToldOfWhatWaitsAndOfWhatComes) {
  Publisher<String> publisher(node_, "/chatter");
  Subscription<String> subscription(node_, "/chatter");
  const rmw_event_t matched = event_of(publisher, RMW_EVENT_PUBLICATION_MATCHED);
  ASSERT_EQ(wait(matched), RMW_RET_OK);
  for (int i = 0; i < 3; ++i) {
    publisher.publish(String());
  }
  ASSERT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
  std::atomic<size_t> told{0};
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, count, &told), RMW_RET_OK);
  EXPECT_EQ(told, 3u);
  String message;
  EXPECT_TRUE(subscription.take(message));
  publisher.publish(String());
  ASSERT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
  EXPECT_EQ(told, 4u);
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, nullptr, nullptr), RMW_RET_OK);
  publisher.publish(String());
  ASSERT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
  EXPECT_EQ(told, 4u);

  // A later callback hears of what no other was told of, and of all that waits if that was handed back.
  std::atomic<size_t> later{0};
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, count, &later), RMW_RET_OK);
  EXPECT_EQ(later, 1u);
  EXPECT_TRUE(subscription.take(message));
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, nullptr, nullptr), RMW_RET_OK);
  EXPECT_TRUE(subscription.take(message));
  publisher.publish(String());
  ASSERT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, count, &later), RMW_RET_OK);
  EXPECT_EQ(later, 2u);
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, nullptr, rmw_event_callback_hands_back),
            RMW_RET_OK);
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, count, &later), RMW_RET_OK);
  EXPECT_EQ(later, 5u);  // three wait
  EXPECT_EQ(told, 4u);

  // What comes later may push out what was told.
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, nullptr, nullptr), RMW_RET_OK);
  const size_t depth = rmw_qos_profile_default.depth;
  for (size_t i = 0; i < depth; ++i) {
    publisher.publish(String());
  }
  ASSERT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
  std::atomic<size_t> last{0};
  ASSERT_EQ(rmw_subscription_set_on_new_message_callback(subscription.handle, count, &last), RMW_RET_OK);
  EXPECT_EQ(last, depth);

  rmw_event_t event = matched;
  std::atomic<size_t> matches{0};
  ASSERT_EQ(rmw_event_set_callback(&event, count, &matches), RMW_RET_OK);
  EXPECT_EQ(matches, 1u);  // nobody has taken the event
  ASSERT_EQ(rmw_event_set_callback(&event, count, &matches), RMW_RET_OK);
  EXPECT_EQ(matches, 1u);
  ASSERT_EQ(rmw_event_set_callback(&event, nullptr, nullptr), RMW_RET_OK);
  take<rmw_matched_status_t>(event);
  Subscription<String> second(node_, "/chatter");
  ASSERT_EQ(wait(event), RMW_RET_OK);
  ASSERT_EQ(rmw_event_set_callback(&event, count, &matches), RMW_RET_OK);
  EXPECT_EQ(matches, 2u);
  ASSERT_EQ(rmw_event_set_callback(&event, nullptr, rmw_event_callback_hands_back), RMW_RET_OK);
  ASSERT_EQ(rmw_event_set_callback(&event, count, &matches), RMW_RET_OK);
  EXPECT_EQ(matches, 3u);
  ASSERT_EQ(rmw_event_fini(&event), RMW_RET_OK);
}

}  // namespace
