// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/subscription_base.hpp"

#include <rcl/network_flow_endpoints.h>
#include <rmw/rmw.h>
#include <tracetools/tracetools.h>

#include <chrono>
#include <utility>

#include "base/rcl_entity.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/detail/resolve_use_intra_process.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/experimental/intra_process_manager.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/topic_statistics/subscription_topic_statistics.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

std::vector<const char*> c_strings(const std::vector<std::string>& strings) {
  std::vector<const char*> pointers;
  for (const std::string& string : strings) {
    pointers.push_back(string.c_str());
  }
  return pointers;
}

void set_filter(const ContentFilterOptions& filter, rcl_subscription_options_t& options) {
  if (filter.filter_expression.empty()) {
    return;
  }
  const std::vector<const char*> parameters = c_strings(filter.expression_parameters);
  require_ok(rcl_subscription_options_set_content_filter_options(filter.filter_expression.c_str(), parameters.size(),
                                                                 parameters.data(), &options),
             "failed to set content_filter_options");
}

}  // namespace

rcl_subscription_options_t detail::to_rcl_subscription_options(const SubscriptionOptionsBase& options, const QoS& qos) {
  rcl_subscription_options_t result = rcl_subscription_get_default_options();
  result.qos = qos.get_rmw_qos_profile();
  result.rmw_subscription_options.ignore_local_publications = options.ignore_local_publications;
  result.rmw_subscription_options.require_unique_network_flow_endpoints = options.require_unique_network_flow_endpoints;
  set_filter(options.content_filter_options, result);
  return result;
}

SubscriptionBase::SubscriptionBase(node_interfaces::NodeBaseInterface* node_base,
                                   const rosidl_message_type_support_t& type_support, const std::string& topic,
                                   const QoS& qos, const SubscriptionOptionsBase& options)
    : type_support_(type_support) {
  const std::shared_ptr<rcl_node_t> node_handle = node_base->get_shared_rcl_node_handle();
  rcl_subscription_options_t rcl_options = detail::to_rcl_subscription_options(options, qos);

  auto subscription = std::make_unique<rcl_subscription_t>(rcl_get_zero_initialized_subscription());
  const rcl_ret_t ret =
      rcl_subscription_init(subscription.get(), node_handle.get(), &type_support, topic.c_str(), &rcl_options);
  (void)rcl_subscription_options_fini(&rcl_options);
  if (ret == RCL_RET_TOPIC_NAME_INVALID) {
    detail::throw_invalid_topic_name(topic);
  }
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "could not create subscription on '" + topic + "'");
  }
  subscription_handle_ = detail::shared_entity(std::move(subscription), node_handle, rcl_subscription_fini,
                                               "failed to finalize a subscription");
  can_loan_messages_ = rcl_subscription_can_loan_messages(subscription_handle_.get());
  bind_event_callbacks(options.event_callbacks, options.use_default_callbacks,
                       rcl_node_get_logger_name(node_handle.get()));
}

SubscriptionBase::~SubscriptionBase() {
  if (intra_process_) {
    intra_process_manager_->remove_subscription(intra_process_subscription_id_);
    intra_process_.reset();
  }
  clear_on_new_message_callback();
  event_handlers_.clear();  // an executor that collects entities must not find them any more
  if (traced_callback_) {
    TRACETOOLS_EXT_TRACEPOINT(rclcpp_callback_fini, traced_callback_);
    TRACETOOLS_EXT_TRACEPOINT(rclcpp_subscription_fini, static_cast<const void*>(this));
  }
  if (const CallbackGroup::SharedPtr group = callback_group_.lock()) {
    group->entity_removed();
  }
}

const char* SubscriptionBase::get_topic_name() const {
  return rcl_subscription_get_topic_name(subscription_handle_.get());
}

QoS SubscriptionBase::get_actual_qos() const {
  return detail::qos_of(rcl_subscription_get_actual_qos(subscription_handle_.get()), RCL_RET_SUBSCRIPTION_INVALID);
}

size_t SubscriptionBase::get_publisher_count() const {
  size_t count = 0;
  require_ok(rcl_subscription_get_publisher_count(subscription_handle_.get(), &count), "failed to get publisher count");
  return count;
}

[[gnu::hot]] bool SubscriptionBase::take_type_erased(void* message_out, MessageInfo& message_info_out) {
  const rcl_ret_t ret =
      rcl_take(subscription_handle_.get(), message_out, &message_info_out.get_rmw_message_info(), nullptr);
  TRACETOOLS_TRACEPOINT(rclcpp_take, static_cast<const void*>(message_out));
  return check_taken(ret);
}

bool SubscriptionBase::take_serialized(SerializedMessage& message_out, MessageInfo& message_info_out) {
  rcl_serialized_message_t* message = &message_out.get_rcl_serialized_message();
  const rcl_ret_t ret = rcl_take_serialized_message(subscription_handle_.get(), message,
                                                    &message_info_out.get_rmw_message_info(), nullptr);
  TRACETOOLS_TRACEPOINT(rclcpp_take, static_cast<const void*>(message));
  return check_taken(ret);
}

[[gnu::hot]] bool SubscriptionBase::check_taken(rcl_ret_t ret) const {
  if (ret == RCL_RET_SUBSCRIPTION_TAKE_FAILED) {
    rcl_reset_error();
    return false;
  }
  require_ok(ret, "failed to take a message");
  return true;
}

void SubscriptionBase::set_content_filter(const std::string& filter_expression,
                                          const std::vector<std::string>& expression_parameters) {
  if (intra_process_) {
    rcl_reset_error();
    RCL_SET_ERROR_MSG("messages of intra-process communication cannot be filtered by content");
    exceptions::throw_from_rcl_error(RCL_RET_UNSUPPORTED, "failed to set the content filter");
  }
  const std::vector<const char*> parameters = c_strings(expression_parameters);
  auto options = rcl_get_zero_initialized_subscription_content_filter_options();
  rcl_ret_t ret = rcl_subscription_content_filter_options_init(subscription_handle_.get(), filter_expression.c_str(),
                                                               parameters.size(), parameters.data(), &options);
  if (ret == RCL_RET_OK) {
    ret = rcl_subscription_set_content_filter(subscription_handle_.get(), &options);
    (void)rcl_subscription_content_filter_options_fini(subscription_handle_.get(), &options);
  }
  require_ok(ret, "failed to set the content filter");
}

ContentFilterOptions SubscriptionBase::get_content_filter() const {
  auto options = rcl_get_zero_initialized_subscription_content_filter_options();
  require_ok(rcl_subscription_get_content_filter(subscription_handle_.get(), &options),
             "failed to get the content filter");
  const auto& filter = options.rmw_subscription_content_filter_options;
  ContentFilterOptions result;
  result.filter_expression = filter.filter_expression;
  result.expression_parameters.assign(filter.expression_parameters.data,
                                      filter.expression_parameters.data + filter.expression_parameters.size);
  (void)rcl_subscription_content_filter_options_fini(subscription_handle_.get(), &options);
  return result;
}

std::vector<NetworkFlowEndpoint> SubscriptionBase::get_network_flow_endpoints() const {
  return detail::network_flow_endpoints(
      [this](rcutils_allocator_t* allocator, rmw_network_flow_endpoint_array_t* array) {
        return rcl_subscription_get_network_flow_endpoints(subscription_handle_.get(), allocator, array);
      });
}

void SubscriptionBase::execute_loaned() {
  void* loan = nullptr;
  MessageInfo message_info;
  const rcl_ret_t ret =
      rcl_take_loaned_message(subscription_handle_.get(), &loan, &message_info.get_rmw_message_info(), nullptr);
  TRACETOOLS_TRACEPOINT(rclcpp_take, static_cast<const void*>(loan));
  if (ret == RCL_RET_SUBSCRIPTION_TAKE_FAILED) {
    rcl_reset_error();
    return;
  }
  if (ret != RCL_RET_OK) {
    RCLCPP_ERROR(get_logger("rclcpp"), "executor failed to take a loaned message from topic '%s': %s", get_topic_name(),
                 rcl_get_error_string().str);
    rcl_reset_error();
    return;
  }
  const std::shared_ptr<void> message(loan, [handle = subscription_handle_](void* borrowed) {
    detail::log_error(rcl_return_loaned_message_from_subscription(handle.get(), borrowed),
                      "failed to return a loaned message");
  });
  if (!is_delivered_twice(message_info)) {
    dispatch(message, message_info);
  }
}

[[gnu::hot]] void SubscriptionBase::execute() {
  AnySubscriptionCallbackBase& any_callback = callback();
  if (any_callback.takes_reference() && !any_callback.is_serialized_message_callback() && can_loan_messages()) {
    execute_loaned();
    return;
  }
  MessageInfo message_info;
  std::shared_ptr<void> message = borrow_message();
  bool taken = false;
  // If a message cannot be read, it is lost, but the program goes on.
  try {
    taken = any_callback.is_serialized_message_callback()
                ? take_serialized(*static_cast<SerializedMessage*>(message.get()), message_info)
                : take_type_erased(message.get(), message_info);
  } catch (const exceptions::RCLError& error) {
    RCLCPP_ERROR(get_logger("rclcpp"), "executor failed to take a message from topic '%s': %s", get_topic_name(),
                 error.what());
    if (has_memory_strategy_) {
      return_to_strategy(std::move(message));
    }
    return;
  }
  if (taken && !is_delivered_twice(message_info)) {
    dispatch(message, message_info);
  }
  keep_message(std::move(message));
}

void SubscriptionBase::handle_message(const std::shared_ptr<void>& message, const MessageInfo& message_info) {
  if (!is_delivered_twice(message_info)) {
    dispatch(message, message_info);
  }
}

[[gnu::hot]] void SubscriptionBase::dispatch(const std::shared_ptr<void>& message, const MessageInfo& message_info) {
  if (!has_callbacks_) {
    return;
  }
  if (!statistics_) {
    callback().dispatch(message, message_info);
    return;
  }
  // Measured before the callback, so that its running time does not count.
  const auto now =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch());
  callback().dispatch(message, message_info);
  statistics_->handle_message(message_info.get_rmw_message_info(), Time(now.count(), RCL_SYSTEM_TIME));
}

void SubscriptionBase::disable_callbacks() {
  has_callbacks_ = false;
  if (intra_process_) {
    intra_process_->set_has_callbacks(false);
  }
}

void SubscriptionBase::enable_callbacks() {
  has_callbacks_ = true;
  if (intra_process_) {
    intra_process_->set_has_callbacks(true);
  }
}

void SubscriptionBase::set_topic_statistics(std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics) {
  if (intra_process_) {
    intra_process_->set_topic_statistics(statistics);
  }
  statistics_ = std::move(statistics);
}

[[gnu::hot]] std::shared_ptr<void> SubscriptionBase::borrow_message() {
  std::shared_ptr<void> message;
  if (!has_memory_strategy_ && callback().takes_reference() &&
      !is_spare_in_use_.test_and_set(std::memory_order_acquire)) {
    message.swap(spare_message_);
    is_spare_in_use_.clear(std::memory_order_release);
  }
  if (!message) {
    message = callback().is_serialized_message_callback() ? create_serialized_message() : create_message();
  }
  return message;
}

[[gnu::hot]] void SubscriptionBase::keep_message(std::shared_ptr<void> message) {
  if (has_memory_strategy_) {
    return_to_strategy(std::move(message));
    return;
  }
  if (callback().takes_reference() && !is_spare_in_use_.test_and_set(std::memory_order_acquire)) {
    message.swap(spare_message_);
    is_spare_in_use_.clear(std::memory_order_release);
  }
}

void SubscriptionBase::return_to_strategy(std::shared_ptr<void> message) {
  if (callback().is_serialized_message_callback()) {
    auto serialized_message = std::static_pointer_cast<SerializedMessage>(message);
    message.reset();
    return_serialized_message(serialized_message);
  } else {
    return_message(message);
  }
}

void SubscriptionBase::trace_creation(const AnySubscriptionCallbackBase& callback) {
  traced_callback_ = &callback;
  TRACETOOLS_TRACEPOINT(rclcpp_subscription_init, static_cast<const void*>(subscription_handle_.get()),
                        static_cast<const void*>(this));
  trace_callback(this, callback);
}

void SubscriptionBase::trace_callback([[maybe_unused]] const void* subscription,
                                      const AnySubscriptionCallbackBase& callback) const {
  TRACETOOLS_TRACEPOINT(rclcpp_subscription_callback_added, subscription, static_cast<const void*>(&callback));
  callback.trace_registration();
}

bool SubscriptionBase::uses_intra_process(const SubscriptionOptionsBase& options,
                                          const node_interfaces::NodeBaseInterface& node_base) const {
  if (!detail::resolve_use_intra_process(options, node_base) ||
      !options.content_filter_options.filter_expression.empty()) {
    return false;
  }
  detail::require_intra_process_qos(get_actual_qos(), get_topic_name());
  return true;
}

void SubscriptionBase::join_intra_process(node_interfaces::NodeBaseInterface& node_base,
                                          std::shared_ptr<experimental::SubscriptionIntraProcessBase> intra_process,
                                          const AnySubscriptionCallbackBase& callback) {
  trace_callback(intra_process.get(), callback);
  TRACETOOLS_TRACEPOINT(rclcpp_subscription_init, static_cast<const void*>(subscription_handle_.get()),
                        static_cast<const void*>(intra_process.get()));
  intra_process_manager_ = node_base.get_context()->get_sub_context<experimental::IntraProcessManager>();
  intra_process_subscription_id_ = intra_process_manager_->add_subscription(intra_process);
  intra_process_ = std::move(intra_process);
}

std::shared_ptr<Waitable> SubscriptionBase::get_intra_process_waitable() const {
  return intra_process_;
}

bool SubscriptionBase::is_delivered_twice(const MessageInfo& message_info) const {
  return intra_process_ &&
         intra_process_manager_->matches_any_publishers(message_info.get_rmw_message_info().publisher_gid);
}

void SubscriptionBase::set_on_new_message_callback(std::function<void(size_t)> callback) {
  on_ready_.set(std::move(callback), "set_on_new_message_callback", "subscription",
                [this](rcl_event_callback_t function, const void* user_data) {
                  require_ok(
                      rcl_subscription_set_on_new_message_callback(subscription_handle_.get(), function, user_data),
                      "failed to set the callback of a subscription");
                });
}

void SubscriptionBase::clear_on_new_message_callback() {
  on_ready_.clear([this](rcl_event_callback_t function, const void* user_data) {
    detail::ignore_error(rcl_subscription_set_on_new_message_callback(subscription_handle_.get(), function, user_data));
  });
}

}  // namespace rclcpp
