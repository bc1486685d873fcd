// SPDX-License-Identifier: Apache-2.0
// The common part of all publishers, for any message type.
#pragma once

#include <rcl/publisher.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rclcpp/event_handler.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/network_flow_endpoint.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/publisher_options.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/serialized_message.hpp"

namespace rclcpp {

namespace experimental {
class IntraProcessManager;
class SubscriptionIntraProcessBase;
}  // namespace experimental

class PublisherBase : public std::enable_shared_from_this<PublisherBase> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(PublisherBase)

  // Throws exceptions::InvalidTopicNameError or exceptions::RCLError.
  PublisherBase(node_interfaces::NodeBaseInterface* node_base, const std::string& topic,
                const rosidl_message_type_support_t& type_support, const QoS& qos,
                const PublisherOptionsBase& options = PublisherOptionsBase());
  // With options of rcl.
  PublisherBase(node_interfaces::NodeBaseInterface* node_base, const std::string& topic,
                const rosidl_message_type_support_t& type_support, const rcl_publisher_options_t& publisher_options,
                const PublisherEventCallbacks& event_callbacks, bool use_default_callbacks);
  virtual ~PublisherBase();
  RCLCPP_DISABLE_COPY(PublisherBase)

  // The full, remapped name.
  const char* get_topic_name() const;
  // The requested depth.
  size_t get_queue_size() const;
  // The QoS that the middleware uses for the requested one.
  QoS get_actual_qos() const;
  const rmw_gid_t& get_gid() const { return gid_; }
  bool operator==(const rmw_gid_t& gid) const;
  // Throws exceptions::RCLError for null.
  bool operator==(const rmw_gid_t* gid) const;

  bool is_durability_transient_local() const;

  // Matched subscriptions, in this process and elsewhere.
  size_t get_subscription_count() const;
  // The number of subscriptions reached without the middleware: in this context, with intra-process communication.
  size_t get_intra_process_subscription_count() const;
  // The number of messages that each of these can take without losing one; 0 if there are none.
  size_t lowest_available_ipm_capacity() const;

  // Tells the subscriptions that the publisher is alive, for LivelinessPolicy::ManualByTopic. Returns false on failure.
  bool assert_liveliness() const;

  // Returns true when every reliable subscription has acknowledged every message, false after `timeout`. A negative
  // timeout waits forever.
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_all_acked(std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) const {
    return wait_for_all_acked_ns(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }

  // The addresses that the publisher may send from. Throws exceptions::RCLError.
  std::vector<NetworkFlowEndpoint> get_network_flow_endpoints() const;

  // Whether messages can be created in memory of the middleware.
  bool can_loan_messages() const { return rcl_publisher_can_loan_messages(publisher_handle_.get()); }
  // Memory for a message of this type, for LoanedMessage and GenericPublisher; null after shutdown. Throws
  // exceptions::RCLError.
  void* borrow_memory(const rosidl_message_type_support_t* type_support) const;

  // The handlers of the callbacks in the options, and the default one.
  using EventHandlers = std::unordered_map<rcl_publisher_event_type_t, std::shared_ptr<EventHandlerBase>>;
  const EventHandlers& get_event_handlers() const { return event_handlers_; }
  // Sets the function that is called when an event of the type happens, with the number of events. It must only take
  // note. Without a handler for the type, a warning is logged and nothing happens. Throws std::invalid_argument for an
  // empty function.
  void set_on_new_qos_event_callback(std::function<void(size_t)> callback, rcl_publisher_event_type_t event_type);
  void clear_on_new_qos_event_callback(rcl_publisher_event_type_t event_type);
  // The group that serves the event handlers.
  void set_callback_group(CallbackGroup::WeakPtr group) { callback_group_ = std::move(group); }

  std::shared_ptr<rcl_publisher_t> get_publisher_handle() { return publisher_handle_; }
  std::shared_ptr<const rcl_publisher_t> get_publisher_handle() const { return publisher_handle_; }

 protected:
  // Do nothing if the context has ended; throw exceptions::RCLError on other failures.
  void publish_message(const void* message);
  void publish_serialized(const rcl_serialized_message_t& serialized_message);
  // Needs can_loan_messages(). `message` is a borrowed message; it is returned in any case.
  void publish_loaned(void* message);

  // Throws std::invalid_argument if intra-process communication is enabled but the QoS does not allow it.
  bool uses_intra_process(const PublisherOptionsBase& options,
                          const node_interfaces::NodeBaseInterface& node_base) const;
  // `replay`: see IntraProcessManager::add_publisher().
  void join_intra_process(std::shared_ptr<experimental::IntraProcessManager> manager,
                          std::function<void(experimental::SubscriptionIntraProcessBase&)> replay);
  bool intra_process_is_enabled() const { return intra_process_manager_ != nullptr; }
  const std::shared_ptr<experimental::IntraProcessManager>& intra_process_manager() const {
    return intra_process_manager_;
  }
  uint64_t intra_process_publisher_id() const { return intra_process_publisher_id_; }
  void trace_intra_publish(const void* message) const;

  // Warns that a subscription asks for a QoS that this publisher does not offer.
  void default_incompatible_qos_callback(QOSOfferedIncompatibleQoSInfo& info) const;

 private:
  bool wait_for_all_acked_ns(std::chrono::nanoseconds timeout) const;
  void check_published(rcl_ret_t ret, const char* what) const;
  void bind_event_callbacks(const PublisherEventCallbacks& callbacks, bool use_default_callbacks,
                            const std::string& logger_name);

  std::shared_ptr<rcl_publisher_t> publisher_handle_;
  rmw_gid_t gid_;
  std::shared_ptr<experimental::IntraProcessManager> intra_process_manager_;  // null: not used
  uint64_t intra_process_publisher_id_ = 0;
  EventHandlers event_handlers_;
  CallbackGroup::WeakPtr callback_group_;
};

}  // namespace rclcpp
