// SPDX-License-Identifier: Apache-2.0
// Wait sets with subscriptions that get messages.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "rcl_test.hpp"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "std_msgs/msg/empty.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using std_msgs::msg::Empty;
using testing::ElementsAre;

constexpr std::nullptr_t kNull = nullptr;

const rosidl_message_type_support_t* empty_support() {
  return rosidl_typesupport_cpp::get_message_type_support_handle<Empty>();
}

// A publisher and a subscription on one topic.
class Topic {
 public:
  Topic(rcl_test::Node& node, const std::string& name) : node_(node) {
    const rcl_publisher_options_t publisher_options = rcl_publisher_get_default_options();
    EXPECT_EQ(rcl_publisher_init(&publisher_, &node.handle, empty_support(), name.c_str(), &publisher_options),
              RCL_RET_OK);
    const rcl_subscription_options_t options = rcl_subscription_get_default_options();
    EXPECT_EQ(rcl_subscription_init(&subscription, &node.handle, empty_support(), name.c_str(), &options), RCL_RET_OK);
  }
  Topic(const Topic&) = delete;
  Topic& operator=(const Topic&) = delete;
  ~Topic() {
    EXPECT_EQ(rcl_subscription_fini(&subscription, &node_.handle), RCL_RET_OK);
    EXPECT_EQ(rcl_publisher_fini(&publisher_, &node_.handle), RCL_RET_OK);
  }

  void publish() {
    const Empty message;
    EXPECT_EQ(rcl_publish(&publisher_, &message, nullptr), RCL_RET_OK);
  }
  rcl_ret_t take(rmw_message_info_t& info) {
    Empty message;
    return rcl_take(&subscription, &message, &info, nullptr);
  }

  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();

 private:
  rcl_test::Node& node_;
  rcl_publisher_t publisher_ = rcl_get_zero_initialized_publisher();
};

class WaitSetSubscriptions : public testing::Test {
 protected:
  WaitSetSubscriptions() {
    EXPECT_EQ(rcl_wait_set_init(&set_, 4, 0, 0, 0, 0, 0, &context_.handle, rcl_get_default_allocator()), RCL_RET_OK);
  }
  ~WaitSetSubscriptions() override { EXPECT_EQ(rcl_wait_set_fini(&set_), RCL_RET_OK); }

  void add(Topic& topic) { EXPECT_EQ(rcl_wait_set_add_subscription(&set_, &topic.subscription, nullptr), RCL_RET_OK); }
  // For a, b and `further`.
  void wait(std::vector<Topic*> further, rcl_ret_t expected, int64_t timeout) {
    EXPECT_EQ(rcl_wait_set_clear(&set_), RCL_RET_OK);
    add(a_);
    add(b_);
    for (Topic* topic : further) {
      add(*topic);
    }
    EXPECT_EQ(rcl_wait(&set_, timeout), expected);
    rcl_reset_error();
  }
  std::vector<const rcl_subscription_t*> entries() const {
    return {set_.subscriptions, set_.subscriptions + set_.size_of_subscriptions};
  }

  const test_support::Sandbox sandbox_;
  rcl_test::Context context_;
  rcl_test::Node node_{context_, "node"};
  Topic a_{node_, "a"};
  Topic b_{node_, "b"};
  Topic c_{node_, "c"};
  rcl_wait_set_t set_ = rcl_get_zero_initialized_wait_set();
};

TEST_F(WaitSetSubscriptions, WhatIsReadyIsLeft) {
  for (int i = 0; i < 3; ++i) {
    wait({}, RCL_RET_TIMEOUT, 0);
    EXPECT_THAT(entries(), ElementsAre(kNull, kNull, kNull, kNull));

    b_.publish();
    wait({}, RCL_RET_OK, -1);
    EXPECT_THAT(entries(), ElementsAre(kNull, &b_.subscription, kNull, kNull));

    // A message that is not taken stays ready.
    c_.publish();
    a_.publish();
    do {
      wait({&c_}, RCL_RET_OK, -1);
    } while (set_.subscriptions[0] == nullptr || set_.subscriptions[2] == nullptr);
    EXPECT_THAT(entries(), ElementsAre(&a_.subscription, &b_.subscription, &c_.subscription, kNull));

    rmw_message_info_t info;
    EXPECT_EQ(a_.take(info), RCL_RET_OK);
    EXPECT_EQ(b_.take(info), RCL_RET_OK);
    EXPECT_EQ(c_.take(info), RCL_RET_OK);
    EXPECT_GT(info.source_timestamp, 0);
    // There is no message, so the wait reports none.
    EXPECT_EQ(c_.take(info), RCL_RET_SUBSCRIPTION_TAKE_FAILED);
    EXPECT_EQ(info.source_timestamp, 0);
  }
}

TEST_F(WaitSetSubscriptions, NeedAWaitSet) {
  rcl_wait_set_t none = rcl_get_zero_initialized_wait_set();
  EXPECT_EQ(rcl_wait(&none, 0), RCL_RET_WAIT_SET_INVALID);
  EXPECT_EQ(rcl_test::take_error(), "the wait set is not initialized");
}

}  // namespace
