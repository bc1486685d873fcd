// SPDX-License-Identifier: Apache-2.0
// The core of a node: its rcl handle, names and callback groups.
#pragma once

#include <rcl/node.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::node_interfaces {

class NodeBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeBase)

  // Throws exceptions::InvalidNodeNameError, exceptions::InvalidNamespaceError or exceptions::RCLError.
  NodeBase(const std::string& node_name, const std::string& node_namespace, Context::SharedPtr context,
           const rcl_node_options_t& rcl_node_options, bool use_intra_process_default = false,
           bool enable_topic_statistics_default = false);
  ~NodeBase();

  const char* get_name() const { return rcl_node_get_name(node_handle_.get()); }
  const char* get_namespace() const { return rcl_node_get_namespace(node_handle_.get()); }
  const char* get_fully_qualified_name() const { return rcl_node_get_fully_qualified_name(node_handle_.get()); }
  Context::SharedPtr get_context() const { return context_; }
  // Whether publishers and subscriptions use intra-process communication by default.
  bool get_use_intra_process_default() const { return use_intra_process_default_; }
  // Whether subscriptions publish statistics by default.
  bool get_enable_topic_statistics_default() const { return enable_topic_statistics_default_; }

  rcl_node_t* get_rcl_node_handle() { return node_handle_.get(); }
  const rcl_node_t* get_rcl_node_handle() const { return node_handle_.get(); }
  // Publishers, subscriptions and other entities hold it. The rcl node is destroyed with the last of them.
  std::shared_ptr<rcl_node_t> get_shared_rcl_node_handle() const { return node_handle_; }

  // The node holds groups weakly, except the default one.
  CallbackGroup::SharedPtr create_callback_group(CallbackGroupType group_type,
                                                 bool automatically_add_to_executor_with_node = true);
  CallbackGroup::SharedPtr get_default_callback_group() const { return default_callback_group_; }
  bool callback_group_in_node(const CallbackGroup::SharedPtr& group) const;
  std::vector<CallbackGroup::SharedPtr> callback_groups() const;
  void for_each_callback_group(const std::function<void(CallbackGroup::SharedPtr)>& function) const;

  // True while an executor has the node. Executors set it.
  std::atomic_bool& get_associated_with_executor_atomic() { return associated_with_executor_; }
  // Sets the function that is called after a callback group was created or the node was destroyed. Executors use it.
  void set_on_change(std::function<void()> on_change);

  std::string resolve_topic_or_service_name(const std::string& name, bool is_service, bool only_expand = false) const;

 private:
  void notify() const;

  Context::SharedPtr context_;
  bool use_intra_process_default_;
  bool enable_topic_statistics_default_;
  std::shared_ptr<rcl_node_t> node_handle_;
  std::atomic_bool associated_with_executor_{false};

  CallbackGroup::SharedPtr default_callback_group_;
  mutable std::mutex mutex_;
  std::vector<CallbackGroup::WeakPtr> callback_groups_;
  std::function<void()> on_change_;
};

// There is one implementation. The name comes from rclcpp's interface.
using NodeBaseInterface = NodeBase;

}  // namespace rclcpp::node_interfaces
