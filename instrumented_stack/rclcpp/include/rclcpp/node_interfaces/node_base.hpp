// SPDX-License-Identifier: Apache-2.0
// The core of a node: its rcl handle, names and callback groups.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "rclcpp/node_interfaces/node_base_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeBase : public NodeBaseInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeBase)

  // Throws exceptions::InvalidNodeNameError, exceptions::InvalidNamespaceError or exceptions::RCLError.
  NodeBase(const std::string& node_name, const std::string& node_namespace, Context::SharedPtr context,
           const rcl_node_options_t& rcl_node_options, bool use_intra_process_default = false,
           bool enable_topic_statistics_default = false);
  ~NodeBase() override;

  const char* get_name() const override { return rcl_node_get_name(node_handle_.get()); }
  const char* get_namespace() const override { return rcl_node_get_namespace(node_handle_.get()); }
  const char* get_fully_qualified_name() const override {
    return rcl_node_get_fully_qualified_name(node_handle_.get());
  }
  Context::SharedPtr get_context() override { return context_; }

  rcl_node_t* get_rcl_node_handle() override { return node_handle_.get(); }
  const rcl_node_t* get_rcl_node_handle() const override { return node_handle_.get(); }
  std::shared_ptr<rcl_node_t> get_shared_rcl_node_handle() override { return node_handle_; }
  std::shared_ptr<const rcl_node_t> get_shared_rcl_node_handle() const override { return node_handle_; }

  CallbackGroup::SharedPtr create_callback_group(CallbackGroupType group_type,
                                                 bool automatically_add_to_executor_with_node = true) override;
  CallbackGroup::SharedPtr get_default_callback_group() override { return default_callback_group_; }
  bool callback_group_in_node(CallbackGroup::SharedPtr group) override;
  void for_each_callback_group(const CallbackGroupFunction& function) override;

  std::atomic_bool& get_associated_with_executor_atomic() override { return associated_with_executor_; }
  // Made when it is first asked for: the executors of this stack need none. Throw what its constructor throws.
  GuardCondition& get_notify_guard_condition() override { return *get_shared_notify_guard_condition(); }
  GuardCondition::SharedPtr get_shared_notify_guard_condition() override;
  void trigger_notify_guard_condition() override { notify(); }

  bool get_use_intra_process_default() const override { return use_intra_process_default_; }
  bool get_enable_topic_statistics_default() const override { return enable_topic_statistics_default_; }

  std::string resolve_topic_or_service_name(const std::string& name, bool is_service,
                                            bool only_expand = false) const override;
  void set_on_change(std::function<void()> on_change) override;

 private:
  void notify() const;
  std::vector<CallbackGroup::SharedPtr> callback_groups() const;

  Context::SharedPtr context_;
  bool use_intra_process_default_;
  bool enable_topic_statistics_default_;
  std::shared_ptr<rcl_node_t> node_handle_;
  std::atomic_bool associated_with_executor_{false};

  CallbackGroup::SharedPtr default_callback_group_;
  mutable std::mutex mutex_;
  std::vector<CallbackGroup::WeakPtr> callback_groups_;
  std::function<void()> on_change_;
  GuardCondition::SharedPtr notify_guard_condition_;
};

}  // namespace rclcpp::node_interfaces
