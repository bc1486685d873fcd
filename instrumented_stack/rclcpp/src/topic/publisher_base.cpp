// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/publisher_base.hpp"

#include <rcl/network_flow_endpoints.h>
#include <rmw/rmw.h>
#include <tracetools/tracetools.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/rcl_entity.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/detail/resolve_use_intra_process.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/experimental/intra_process_manager.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

namespace {

rcl_publisher_options_t rcl_options_of(const QoS& qos, const PublisherOptionsBase& options) {
  rcl_publisher_options_t result = rcl_publisher_get_default_options();
  result.qos = qos.get_rmw_qos_profile();
  result.rmw_publisher_options.require_unique_network_flow_endpoints = options.require_unique_network_flow_endpoints;
  return result;
}

}  // namespace

PublisherBase::PublisherBase(node_interfaces::NodeBaseInterface* node_base, const std::string& topic,
                             const rosidl_message_type_support_t& type_support, const QoS& qos,
                             const PublisherOptionsBase& options)
    : PublisherBase(node_base, topic, type_support, rcl_options_of(qos, options), options.event_callbacks,
                    options.use_default_callbacks) {}

PublisherBase::PublisherBase(node_interfaces::NodeBaseInterface* node_base, const std::string& topic,
                             const rosidl_message_type_support_t& type_support,
                             const rcl_publisher_options_t& publisher_options,
                             const PublisherEventCallbacks& event_callbacks, bool use_default_callbacks) {
  const std::shared_ptr<rcl_node_t> node_handle = node_base->get_shared_rcl_node_handle();
  auto publisher = std::make_unique<rcl_publisher_t>(rcl_get_zero_initialized_publisher());
  rcl_ret_t ret =
      rcl_publisher_init(publisher.get(), node_handle.get(), &type_support, topic.c_str(), &publisher_options);
  if (ret == RCL_RET_TOPIC_NAME_INVALID) {
    detail::throw_invalid_topic_name(topic);
  }
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "could not create publisher on '" + topic + "'");
  }
  publisher_handle_ =
      detail::shared_entity(std::move(publisher), node_handle, rcl_publisher_fini, "failed to finalize a publisher");

  ret = rmw_get_gid_for_publisher(rcl_publisher_get_rmw_handle(publisher_handle_.get()), &gid_);
  if (ret != RMW_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "failed to get publisher gid");
  }
  bind_event_callbacks(event_callbacks, use_default_callbacks, rcl_node_get_logger_name(node_handle.get()));
}

PublisherBase::~PublisherBase() {
  if (intra_process_manager_) {
    intra_process_manager_->remove_publisher(intra_process_publisher_id_);
  }
  event_handlers_.clear();  // an executor that collects entities must not find them any more
  if (const CallbackGroup::SharedPtr group = callback_group_.lock()) {
    group->entity_removed();
  }
}

const char* PublisherBase::get_topic_name() const {
  return rcl_publisher_get_topic_name(publisher_handle_.get());
}

size_t PublisherBase::get_queue_size() const {
  const rcl_publisher_options_t* options = rcl_publisher_get_options(publisher_handle_.get());
  if (!options) {
    exceptions::throw_from_rcl_error(RCL_RET_PUBLISHER_INVALID, "failed to get publisher options");
  }
  return options->qos.depth;
}

QoS PublisherBase::get_actual_qos() const {
  return detail::qos_of(rcl_publisher_get_actual_qos(publisher_handle_.get()), RCL_RET_PUBLISHER_INVALID);
}

bool PublisherBase::is_durability_transient_local() const {
  return get_actual_qos().durability() == DurabilityPolicy::TransientLocal;
}

size_t PublisherBase::get_subscription_count() const {
  size_t count = 0;
  const rcl_ret_t ret = rcl_publisher_get_subscription_count(publisher_handle_.get(), &count);
  if (ret == RCL_RET_PUBLISHER_INVALID && !rcl_context_is_valid(rcl_publisher_get_context(publisher_handle_.get()))) {
    rcl_reset_error();
    return 0;  // after shutdown there are no subscriptions
  }
  detail::require_ok(ret, "failed to get subscription count");
  return count;
}

size_t PublisherBase::get_intra_process_subscription_count() const {
  return intra_process_manager_ ? intra_process_manager_->get_subscription_count(intra_process_publisher_id_) : 0;
}

size_t PublisherBase::lowest_available_ipm_capacity() const {
  return intra_process_manager_ ? intra_process_manager_->lowest_available_capacity(intra_process_publisher_id_) : 0;
}

std::vector<NetworkFlowEndpoint> PublisherBase::get_network_flow_endpoints() const {
  return detail::network_flow_endpoints(
      [this](rcutils_allocator_t* allocator, rmw_network_flow_endpoint_array_t* array) {
        return rcl_publisher_get_network_flow_endpoints(publisher_handle_.get(), allocator, array);
      });
}

bool PublisherBase::operator==(const rmw_gid_t& gid) const {
  return *this == &gid;
}
bool PublisherBase::operator==(const rmw_gid_t* gid) const {
  bool are_equal = false;
  detail::require_ok(rmw_compare_gids_equal(gid, &gid_, &are_equal), "failed to compare gids");
  return are_equal;
}

bool PublisherBase::assert_liveliness() const {
  if (rcl_publisher_assert_liveliness(publisher_handle_.get()) != RCL_RET_OK) {
    rcl_reset_error();
    return false;
  }
  return true;
}

bool PublisherBase::wait_for_all_acked_ns(std::chrono::nanoseconds timeout) const {
  const rcl_ret_t ret = rcl_publisher_wait_for_all_acked(publisher_handle_.get(), timeout.count());
  if (ret == RCL_RET_TIMEOUT) {
    rcl_reset_error();
    return false;
  }
  detail::require_ok(ret, "failed to wait for acknowledgements");
  return true;
}

[[gnu::hot]] void PublisherBase::publish_message(const void* message) {
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, message);
  check_published(rcl_publish(publisher_handle_.get(), message, nullptr), "failed to publish message");
}

void PublisherBase::publish_serialized(const rcl_serialized_message_t& serialized_message) {
  if (intra_process_is_enabled()) {
    throw std::runtime_error("storing serialized messages in intra process is not supported yet");
  }
  check_published(rcl_publish_serialized_message(publisher_handle_.get(), &serialized_message, nullptr),
                  "failed to publish serialized message");
}

void* PublisherBase::borrow_memory(const rosidl_message_type_support_t* type_support) const {
  void* memory = nullptr;
  const rcl_ret_t ret = rcl_borrow_loaned_message(publisher_handle_.get(), type_support, &memory);
  check_published(ret, "failed to borrow a message");
  return ret == RCL_RET_OK ? memory : nullptr;
}

void PublisherBase::publish_loaned(void* message) {
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, static_cast<const void*>(message));
  const rcl_ret_t ret = rcl_publish_loaned_message(publisher_handle_.get(), message, nullptr);
  if (ret != RCL_RET_OK && rcl_return_loaned_message_from_publisher(publisher_handle_.get(), message) != RCL_RET_OK) {
    RCLCPP_ERROR(get_logger("rclcpp"), "failed to return a loaned message: %s", rcl_get_error_string().str);
  }
  check_published(ret, "failed to publish loaned message");
}

bool PublisherBase::uses_intra_process(const PublisherOptionsBase& options,
                                       const node_interfaces::NodeBaseInterface& node_base) const {
  if (!detail::resolve_use_intra_process(options, node_base)) {
    return false;
  }
  detail::require_intra_process_qos(get_actual_qos(), get_topic_name());
  return true;
}

void PublisherBase::join_intra_process(std::shared_ptr<experimental::IntraProcessManager> manager,
                                       std::function<void(experimental::SubscriptionIntraProcessBase&)> replay) {
  intra_process_publisher_id_ = manager->add_publisher(*this, std::move(replay));
  intra_process_manager_ = std::move(manager);
}

void PublisherBase::trace_intra_publish([[maybe_unused]] const void* message) const {
  TRACETOOLS_TRACEPOINT(rclcpp_intra_publish, static_cast<const void*>(publisher_handle_.get()), message);
}

void PublisherBase::check_published(rcl_ret_t ret, const char* what) const {
  if (ret == RCL_RET_OK) {
    return;
  }
  // A callback may publish while another thread shuts down. That is not an error.
  if (ret == RCL_RET_PUBLISHER_INVALID) {
    rcl_context_t* context = rcl_publisher_get_context(publisher_handle_.get());
    if (context && !rcl_context_is_valid(context)) {
      rcl_reset_error();
      return;
    }
  }
  exceptions::throw_from_rcl_error(ret, what);
}

}  // namespace rclcpp
