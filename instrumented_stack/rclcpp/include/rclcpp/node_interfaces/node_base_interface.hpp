// SPDX-License-Identifier: Apache-2.0
// The core of a node, as others use it: its rcl handle, names and callback groups. A program may implement it.
#pragma once

#include <rcl/node.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::node_interfaces {

class NodeBaseInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeBaseInterface)
  using CallbackGroupFunction = std::function<void(CallbackGroup::SharedPtr)>;

  virtual ~NodeBaseInterface() = default;

  virtual const char* get_name() const = 0;
  virtual const char* get_namespace() const = 0;
  virtual const char* get_fully_qualified_name() const = 0;
  virtual Context::SharedPtr get_context() = 0;

  virtual rcl_node_t* get_rcl_node_handle() = 0;
  virtual const rcl_node_t* get_rcl_node_handle() const = 0;
  // Publishers, subscriptions and other entities hold it. The rcl node is destroyed with the last of them.
  virtual std::shared_ptr<rcl_node_t> get_shared_rcl_node_handle() = 0;
  virtual std::shared_ptr<const rcl_node_t> get_shared_rcl_node_handle() const = 0;

  // The node holds groups weakly, except the default one.
  virtual CallbackGroup::SharedPtr create_callback_group(CallbackGroupType group_type,
                                                         bool automatically_add_to_executor_with_node = true) = 0;
  virtual CallbackGroup::SharedPtr get_default_callback_group() = 0;
  virtual bool callback_group_in_node(CallbackGroup::SharedPtr group) = 0;
  virtual void for_each_callback_group(const CallbackGroupFunction& function) = 0;

  // True while an executor has the node. Executors set it.
  virtual std::atomic_bool& get_associated_with_executor_atomic() = 0;
  // Triggered when a callback group was created, and by trigger_notify_guard_condition().
  virtual GuardCondition& get_notify_guard_condition() = 0;
  virtual GuardCondition::SharedPtr get_shared_notify_guard_condition() = 0;
  virtual void trigger_notify_guard_condition() = 0;

  // Whether publishers and subscriptions use intra-process communication by default.
  virtual bool get_use_intra_process_default() const = 0;
  // Whether subscriptions publish statistics by default.
  virtual bool get_enable_topic_statistics_default() const = 0;

  virtual std::string resolve_topic_or_service_name(const std::string& name, bool is_service,
                                                    bool only_expand = false) const = 0;

  // Sets the function that is called after a callback group was created or the node was destroyed. Executors use it.
  // The classes of ROS 2 lack it; so this one is not abstract.
  virtual void set_on_change(std::function<void()> on_change) {
    if (on_change) {
      get_notify_guard_condition().set_on_trigger_callback([changed = std::move(on_change)](size_t) { changed(); });
    } else {
      get_notify_guard_condition().set_on_trigger_callback(nullptr);
    }
  }
};

}  // namespace rclcpp::node_interfaces
