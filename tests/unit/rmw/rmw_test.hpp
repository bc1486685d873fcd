// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of rmw: owners for its handles, with failures as test failures.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "rosidl_typesupport_cpp/message_type_support.hpp"

namespace rmw_test {

// A longer wait than this for something that must come ends a broken test.
inline constexpr rmw_time_t kPatience{10, 0};

inline std::string take_error() {
  const rmw_error_state_t* state = rmw_get_error_state();
  const std::string message = state == nullptr ? "" : state->message;
  rmw_reset_error();
  return message;
}

class Context {
 public:
  explicit Context(size_t domain_id = RMW_DEFAULT_DOMAIN_ID) {
    rmw_init_options_t options = rmw_get_zero_initialized_init_options();
    EXPECT_EQ(rmw_init_options_init(&options, rcutils_get_default_allocator()), RMW_RET_OK);
    options.domain_id = domain_id;
    EXPECT_EQ(rmw_init(&options, &handle), RMW_RET_OK) << take_error();
    EXPECT_EQ(rmw_init_options_fini(&options), RMW_RET_OK);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    EXPECT_EQ(rmw_shutdown(&handle), RMW_RET_OK);
    EXPECT_EQ(rmw_context_fini(&handle), RMW_RET_OK) << take_error();
  }

  rmw_context_t handle = rmw_get_zero_initialized_context();
};

class Node {
 public:
  explicit Node(Context& context, const std::string& name = "node", const std::string& namespace_ = "/")
      : context_(context), handle(rmw_create_node(&context.handle, name.c_str(), namespace_.c_str())) {
    EXPECT_NE(handle, nullptr) << take_error();
    wait_set_ = rmw_create_wait_set(&context.handle, 1);
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node() {
    EXPECT_EQ(rmw_destroy_wait_set(wait_set_), RMW_RET_OK);
    EXPECT_EQ(rmw_destroy_node(handle), RMW_RET_OK) << take_error();
  }

  // Waits for changes of the graph until the condition holds.
  template <typename Condition>
  void wait_for_graph(Condition condition) {
    while (!condition()) {
      void* changed = rmw_node_get_graph_guard_condition(handle)->data;
      rmw_guard_conditions_t guard_conditions{1, &changed};
      ASSERT_EQ(rmw_wait(nullptr, &guard_conditions, nullptr, nullptr, nullptr, wait_set_, &kPatience), RMW_RET_OK)
          << "the graph stays as it is";
    }
  }

  size_t count_publishers(const char* topic) const {
    size_t count = 0;
    EXPECT_EQ(rmw_count_publishers(handle, topic, &count), RMW_RET_OK);
    return count;
  }
  size_t count_subscribers(const char* topic) const {
    size_t count = 0;
    EXPECT_EQ(rmw_count_subscribers(handle, topic, &count), RMW_RET_OK);
    return count;
  }

  Context& context_;
  rmw_node_t* handle;

 private:
  rmw_wait_set_t* wait_set_ = nullptr;
};

template <typename Message>
class Publisher {
 public:
  Publisher(Node& node, const char* topic, const rmw_qos_profile_t& qos = rmw_qos_profile_default) : node_(node) {
    const rmw_publisher_options_t options = rmw_get_default_publisher_options();
    handle = rmw_create_publisher(node.handle, rosidl_typesupport_cpp::get_message_type_support_handle<Message>(),
                                  topic, &qos, &options);
    EXPECT_NE(handle, nullptr) << take_error();
  }
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;
  ~Publisher() { EXPECT_EQ(rmw_destroy_publisher(node_.handle, handle), RMW_RET_OK); }

  void publish(const Message& message) {
    ASSERT_EQ(rmw_publish(handle, &message, nullptr), RMW_RET_OK) << take_error();
  }

  size_t matched() const {
    size_t count = 0;
    EXPECT_EQ(rmw_publisher_count_matched_subscriptions(handle, &count), RMW_RET_OK);
    return count;
  }

  rmw_publisher_t* handle;

 private:
  Node& node_;
};

template <typename Message>
class Subscription {
 public:
  Subscription(Node& node, const char* topic, const rmw_qos_profile_t& qos = rmw_qos_profile_default,
               bool ignore_local_publications = false)
      : node_(node) {
    rmw_subscription_options_t options = rmw_get_default_subscription_options();
    options.ignore_local_publications = ignore_local_publications;
    handle = rmw_create_subscription(node.handle, rosidl_typesupport_cpp::get_message_type_support_handle<Message>(),
                                     topic, &qos, &options);
    EXPECT_NE(handle, nullptr) << take_error();
    wait_set_ = rmw_create_wait_set(&node.context_.handle, 1);
  }
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
  ~Subscription() {
    EXPECT_EQ(rmw_destroy_wait_set(wait_set_), RMW_RET_OK);
    EXPECT_EQ(rmw_destroy_subscription(node_.handle, handle), RMW_RET_OK);
  }

  rmw_ret_t wait(const rmw_time_t& timeout) {
    void* entity = handle->data;
    rmw_subscriptions_t subscriptions{1, &entity};
    return rmw_wait(&subscriptions, nullptr, nullptr, nullptr, nullptr, wait_set_, &timeout);
  }

  bool take(Message& message, rmw_message_info_t* info = nullptr) {
    rmw_message_info_t ignored = rmw_get_zero_initialized_message_info();
    bool taken = false;
    EXPECT_EQ(rmw_take_with_info(handle, &message, &taken, info == nullptr ? &ignored : info, nullptr), RMW_RET_OK);
    return taken;
  }

  // Waits for the next message and takes it.
  Message next(rmw_message_info_t* info = nullptr) {
    // The reader of a message of many fragments is ready before the last fragment has arrived.
    Message message;
    bool taken = false;
    while (!taken) {
      if (const rmw_ret_t ready = wait(kPatience); ready != RMW_RET_OK) {
        ADD_FAILURE() << "no message comes";
        return message;
      }
      taken = take(message, info);
    }
    return message;
  }

  size_t matched() const {
    size_t count = 0;
    EXPECT_EQ(rmw_subscription_count_matched_publishers(handle, &count), RMW_RET_OK);
    return count;
  }

  rmw_subscription_t* handle;

 private:
  Node& node_;
  rmw_wait_set_t* wait_set_ = nullptr;
};

}  // namespace rmw_test
