// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_base.hpp"

#include <rmw/validate_namespace.h>
#include <rmw/validate_node_name.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp::node_interfaces {

namespace {

// Throws the error that shows where the name is wrong. A name may be right here and wrong after remapping. Then only
// rcl knows, and the caller reports rcl's error.
void throw_if_invalid_node_name(const std::string& name) {
  int result = RMW_NODE_NAME_VALID;
  size_t index = 0;
  if (rmw_validate_node_name(name.c_str(), &result, &index) == RMW_RET_OK && result != RMW_NODE_NAME_VALID) {
    rcl_reset_error();
    throw exceptions::InvalidNodeNameError(name.c_str(), rmw_node_name_validation_result_string(result), index);
  }
}

void throw_if_invalid_namespace(const std::string& node_namespace) {
  int result = RMW_NAMESPACE_VALID;
  size_t index = 0;
  // rcl adds the leading slash of a relative namespace before it checks the rest.
  const bool relative = !node_namespace.empty() && node_namespace.front() != '/';
  const std::string absolute = relative ? "/" + node_namespace : node_namespace;
  if (rmw_validate_namespace(absolute.c_str(), &result, &index) == RMW_RET_OK && result != RMW_NAMESPACE_VALID) {
    rcl_reset_error();
    throw exceptions::InvalidNamespaceError(absolute.c_str(), rmw_namespace_validation_result_string(result), index);
  }
}

}  // namespace

NodeBase::NodeBase(const std::string& node_name, const std::string& node_namespace, Context::SharedPtr context,
                   const rcl_node_options_t& rcl_node_options, bool use_intra_process_default,
                   bool enable_topic_statistics_default)
    : context_(std::move(context)),
      use_intra_process_default_(use_intra_process_default),
      enable_topic_statistics_default_(enable_topic_statistics_default) {
  const std::shared_ptr<rcl_context_t> rcl_context = context_->get_rcl_context();
  if (!rcl_context) {
    throw std::runtime_error("a node needs an initialized context: call rclcpp::init() first");
  }
  auto rcl_node = std::make_unique<rcl_node_t>(rcl_get_zero_initialized_node());
  const rcl_ret_t ret =
      rcl_node_init(rcl_node.get(), node_name.c_str(), node_namespace.c_str(), rcl_context.get(), &rcl_node_options);
  if (ret == RCL_RET_NODE_INVALID_NAME) {
    throw_if_invalid_node_name(node_name);
  }
  if (ret == RCL_RET_NODE_INVALID_NAMESPACE) {
    throw_if_invalid_namespace(node_namespace);
  }
  detail::require_ok(ret, "failed to initialize rcl node");
  node_handle_.reset(rcl_node.release(), [rcl_context](rcl_node_t* node) {
    detail::log_error(rcl_node_fini(node), "failed to finalize a node");
    delete node;
  });
  default_callback_group_ = create_callback_group(CallbackGroupType::MutuallyExclusive);
}

NodeBase::~NodeBase() {
  notify();
}

CallbackGroup::SharedPtr NodeBase::create_callback_group(CallbackGroupType group_type,
                                                         bool automatically_add_to_executor_with_node) {
  auto group = std::make_shared<CallbackGroup>(group_type, context_, automatically_add_to_executor_with_node);
  {
    const std::lock_guard lock(mutex_);
    callback_groups_.push_back(group);
  }
  notify();
  return group;
}

bool NodeBase::callback_group_in_node(CallbackGroup::SharedPtr group) {
  const std::vector<CallbackGroup::SharedPtr> groups = callback_groups();
  return std::find(groups.begin(), groups.end(), group) != groups.end();
}

std::vector<CallbackGroup::SharedPtr> NodeBase::callback_groups() const {
  const std::lock_guard lock(mutex_);
  std::vector<CallbackGroup::SharedPtr> groups;
  for (const CallbackGroup::WeakPtr& weak : callback_groups_) {
    if (auto group = weak.lock()) {
      groups.push_back(std::move(group));
    }
  }
  return groups;
}

void NodeBase::for_each_callback_group(const CallbackGroupFunction& function) {
  for (const CallbackGroup::SharedPtr& group : callback_groups()) {
    function(group);
  }
}

GuardCondition::SharedPtr NodeBase::get_shared_notify_guard_condition() {
  const std::lock_guard lock(mutex_);
  if (!notify_guard_condition_) {
    notify_guard_condition_ = std::make_shared<GuardCondition>(context_);
  }
  return notify_guard_condition_;
}

void NodeBase::set_on_change(std::function<void()> on_change) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(on_change);
}

void NodeBase::notify() const {
  std::function<void()> on_change;
  GuardCondition::SharedPtr guard_condition;
  {
    const std::lock_guard lock(mutex_);
    on_change = on_change_;
    guard_condition = notify_guard_condition_;
  }
  if (on_change) {
    on_change();
  }
  if (guard_condition && context_->is_valid()) {
    guard_condition->trigger();
  }
}

std::string NodeBase::resolve_topic_or_service_name(const std::string& name, bool is_service, bool only_expand) const {
  char* resolved = nullptr;
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  const rcl_ret_t ret =
      rcl_node_resolve_name(node_handle_.get(), name.c_str(), allocator, is_service, only_expand, &resolved);
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "failed to resolve name '" + name + "'");
  }
  const std::string result = resolved;
  allocator.deallocate(resolved, allocator.state);
  return result;
}

}  // namespace rclcpp::node_interfaces
