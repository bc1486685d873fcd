// SPDX-License-Identifier: Apache-2.0
// What every kind of node can do: Node and rclcpp_lifecycle::LifecycleNode derive from it. These two are no base of
// each other, as in ROS 2, so that functions can be overloaded for both.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/clock.hpp"
#include "rclcpp/create_client.hpp"
#include "rclcpp/create_generic_client.hpp"
#include "rclcpp/create_generic_publisher.hpp"
#include "rclcpp/create_generic_service.hpp"
#include "rclcpp/create_generic_subscription.hpp"
#include "rclcpp/create_publisher.hpp"
#include "rclcpp/create_service.hpp"
#include "rclcpp/create_subscription.hpp"
#include "rclcpp/create_timer.hpp"
#include "rclcpp/logger.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/node_interfaces/node_clock.hpp"
#include "rclcpp/node_interfaces/node_graph.hpp"
#include "rclcpp/node_interfaces/node_logging.hpp"
#include "rclcpp/node_interfaces/node_parameters.hpp"
#include "rclcpp/node_interfaces/node_services.hpp"
#include "rclcpp/node_interfaces/node_time_source_interface.hpp"
#include "rclcpp/node_interfaces/node_timers.hpp"
#include "rclcpp/node_interfaces/node_topics.hpp"
#include "rclcpp/node_interfaces/node_type_descriptions.hpp"
#include "rclcpp/node_interfaces/node_waitables.hpp"
#include "rclcpp/node_options.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/publisher.hpp"
#include "rclcpp/subscription.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp::detail {

class AnyNode {
 public:
  virtual ~AnyNode();
  RCLCPP_DISABLE_COPY(AnyNode)

  const char* get_name() const { return node_base_->get_name(); }
  const char* get_namespace() const { return node_base_->get_namespace(); }
  const char* get_fully_qualified_name() const { return node_base_->get_fully_qualified_name(); }
  const NodeOptions& get_node_options() const { return options_; }

  // Empty unless this is a sub-node: `a/b` for create_sub_node("a")->create_sub_node("b").
  const std::string& get_sub_namespace() const { return sub_namespace_; }
  // The node's namespace with the sub-namespace.
  const std::string& get_effective_namespace() const { return effective_namespace_; }

  // `ns.node`
  Logger get_logger() const { return node_logging_->get_logger(); }
  // System time, or simulated time if the parameter use_sim_time is true.
  Clock::SharedPtr get_clock() { return node_clock_->get_clock(); }
  Clock::ConstSharedPtr get_clock() const { return std::as_const(*node_clock_).get_clock(); }
  Time now() const { return get_clock()->now(); }

  // Keep the group: the node holds it weakly.
  CallbackGroup::SharedPtr create_callback_group(CallbackGroupType group_type,
                                                 bool automatically_add_to_executor_with_node = true);
  void for_each_callback_group(const std::function<void(CallbackGroup::SharedPtr)>& function);

  // Throw exceptions::InvalidTopicNameError or exceptions::RCLError. Publisher, subscription and timer live as long as
  // the pointer.
  template <typename MessageT, typename AllocatorT = std::allocator<void>,
            typename PublisherT = Publisher<MessageT, AllocatorT>>
  std::shared_ptr<PublisherT> create_publisher(
      const std::string& topic_name, const QoS& qos,
      const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>()) {
    return rclcpp::create_publisher<MessageT, AllocatorT, PublisherT>(*this, extend_name(topic_name), qos, options);
  }

  // For the forms of the callback see any_subscription_callback.hpp. Without a memory strategy, messages come from the
  // allocator of the options.
  template <typename MessageT, typename CallbackT, typename AllocatorT = std::allocator<void>,
            typename SubscriptionT = Subscription<MessageT, AllocatorT>,
            typename MessageMemoryStrategyT = typename SubscriptionT::MessageMemoryStrategyType>
  std::shared_ptr<SubscriptionT> create_subscription(
      const std::string& topic_name, const QoS& qos, CallbackT&& callback,
      const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>(),
      typename MessageMemoryStrategyT::SharedPtr msg_mem_strat = nullptr) {
    return rclcpp::create_subscription<MessageT, CallbackT, AllocatorT, SubscriptionT, MessageMemoryStrategyT>(
        *this, extend_name(topic_name), qos, std::forward<CallbackT>(callback), options, std::move(msg_mem_strat));
  }

  // For types that are known only by name: "std_msgs/msg/String". They also throw std::runtime_error if the type cannot
  // be found.
  template <typename AllocatorT = std::allocator<void>>
  std::shared_ptr<GenericPublisher> create_generic_publisher(
      const std::string& topic_name, const std::string& topic_type, const QoS& qos,
      const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>()) {
    return rclcpp::create_generic_publisher(node_topics_, extend_name(topic_name), topic_type, qos, options);
  }
  template <typename CallbackT, typename AllocatorT = std::allocator<void>>
  std::shared_ptr<GenericSubscription> create_generic_subscription(
      const std::string& topic_name, const std::string& topic_type, const QoS& qos, CallbackT&& callback,
      const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>()) {
    return rclcpp::create_generic_subscription(node_topics_, extend_name(topic_name), topic_type, qos,
                                               std::forward<CallbackT>(callback), options);
  }

  // Throw exceptions::InvalidServiceNameError or exceptions::RCLError. For the forms of the callback see
  // any_service_callback.hpp.
  template <typename ServiceT, typename CallbackT>
  typename Service<ServiceT>::SharedPtr create_service(const std::string& service_name, CallbackT&& callback,
                                                       const QoS& qos = ServicesQoS(),
                                                       CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_service<ServiceT>(node_base_, node_services_, extend_name(service_name),
                                            std::forward<CallbackT>(callback), qos, std::move(group));
  }
  // The older forms, which take a profile of the middleware.
  template <typename ServiceT, typename CallbackT>
  [[deprecated("use rclcpp::QoS instead of rmw_qos_profile_t")]] typename Service<ServiceT>::SharedPtr create_service(
      const std::string& service_name, CallbackT&& callback, const rmw_qos_profile_t& qos_profile,
      CallbackGroup::SharedPtr group = nullptr) {
    return create_service<ServiceT>(service_name, std::forward<CallbackT>(callback),
                                    QoS(QoSInitialization::from_rmw(qos_profile), qos_profile), std::move(group));
  }
  template <typename ServiceT>
  [[deprecated("use rclcpp::QoS instead of rmw_qos_profile_t")]] typename Client<ServiceT>::SharedPtr create_client(
      const std::string& service_name, const rmw_qos_profile_t& qos_profile, CallbackGroup::SharedPtr group = nullptr) {
    return create_client<ServiceT>(service_name, QoS(QoSInitialization::from_rmw(qos_profile), qos_profile),
                                   std::move(group));
  }
  template <typename ServiceT>
  typename Client<ServiceT>::SharedPtr create_client(const std::string& service_name, const QoS& qos = ServicesQoS(),
                                                     CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_client<ServiceT>(node_base_, node_services_, extend_name(service_name), qos,
                                           std::move(group));
  }

  // For types that are known only by name: "std_srvs/srv/SetBool". They also throw std::runtime_error if the type
  // cannot be found.
  GenericClient::SharedPtr create_generic_client(const std::string& service_name, const std::string& service_type,
                                                 const QoS& qos = ServicesQoS(),
                                                 CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_generic_client(node_base_, node_graph_, node_services_, extend_name(service_name),
                                         service_type, qos, std::move(group));
  }
  template <typename CallbackT>
  GenericService::SharedPtr create_generic_service(const std::string& service_name, const std::string& service_type,
                                                   CallbackT&& callback, const QoS& qos = ServicesQoS(),
                                                   CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_generic_service(node_base_, node_services_, extend_name(service_name), service_type,
                                          std::forward<CallbackT>(callback), qos, std::move(group));
  }

  // Uses the steady clock. The callback takes nothing or a TimerBase &. Throws std::invalid_argument for a negative
  // period.
  template <typename RepT, typename RatioT, typename CallbackT>
  typename WallTimer<std::decay_t<CallbackT>>::SharedPtr create_wall_timer(std::chrono::duration<RepT, RatioT> period,
                                                                           CallbackT&& callback,
                                                                           CallbackGroup::SharedPtr group = nullptr,
                                                                           bool autostart = true) {
    return rclcpp::create_wall_timer(period, std::forward<CallbackT>(callback), std::move(group), node_base_.get(),
                                     node_timers_.get(), autostart);
  }

  // Uses the node's clock.
  template <typename RepT, typename RatioT, typename CallbackT>
  typename GenericTimer<std::decay_t<CallbackT>>::SharedPtr create_timer(std::chrono::duration<RepT, RatioT> period,
                                                                         CallbackT&& callback,
                                                                         CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_timer(get_clock(), period, std::forward<CallbackT>(callback), std::move(group),
                                node_base_.get(), node_timers_.get());
  }

  // A parameter exists from its declaration on. Its first value is the override from NodeOptions, command line or
  // parameter file if there is one, else the default. Its type stays that of the default unless the descriptor says
  // dynamic_typing. Throw exceptions::ParameterAlreadyDeclaredException, exceptions::InvalidParametersException (empty
  // name), exceptions::InvalidParameterTypeException (override of another type),
  // exceptions::InvalidParameterValueException (refused by range or callback).
  template <typename ParameterT>
  auto declare_parameter(
      const std::string& name, const ParameterT& default_value,
      const rcl_interfaces::msg::ParameterDescriptor& descriptor = rcl_interfaces::msg::ParameterDescriptor(),
      bool ignore_override = false);
  // Without a default: throws exceptions::UninitializedStaticallyTypedParameterException if there is no override.
  template <typename ParameterT>
  auto declare_parameter(
      const std::string& name,
      const rcl_interfaces::msg::ParameterDescriptor& descriptor = rcl_interfaces::msg::ParameterDescriptor(),
      bool ignore_override = false);
  const ParameterValue& declare_parameter(
      const std::string& name, const ParameterValue& default_value,
      const rcl_interfaces::msg::ParameterDescriptor& descriptor = rcl_interfaces::msg::ParameterDescriptor(),
      bool ignore_override = false);
  const ParameterValue& declare_parameter(
      const std::string& name, ParameterType type,
      const rcl_interfaces::msg::ParameterDescriptor& descriptor = rcl_interfaces::msg::ParameterDescriptor(),
      bool ignore_override = false);
  // Declares several parameters with a common prefix.
  template <typename ParameterT>
  std::vector<ParameterT> declare_parameters(const std::string& parameter_namespace,
                                             const std::map<std::string, ParameterT>& parameters,
                                             bool ignore_overrides = false);
  // The same with descriptors.
  template <typename ParameterT>
  std::vector<ParameterT> declare_parameters(
      const std::string& parameter_namespace,
      const std::map<std::string, std::pair<ParameterT, rcl_interfaces::msg::ParameterDescriptor>>& parameters,
      bool ignore_overrides = false);
  // Works only for dynamically typed parameters. Throws exceptions::ParameterNotDeclaredException,
  // exceptions::ParameterImmutableException or exceptions::InvalidParameterTypeException.
  void undeclare_parameter(const std::string& name);
  bool has_parameter(const std::string& name) const;

  // The result contains a refusal (type, range, read-only, callback). Throw exceptions::ParameterNotDeclaredException.
  rcl_interfaces::msg::SetParametersResult set_parameter(const Parameter& parameter);
  std::vector<rcl_interfaces::msg::SetParametersResult> set_parameters(const std::vector<Parameter>& parameters);
  // Sets all parameters or none.
  rcl_interfaces::msg::SetParametersResult set_parameters_atomically(const std::vector<Parameter>& parameters);

  // Throw exceptions::ParameterNotDeclaredException or exceptions::ParameterUninitializedException.
  Parameter get_parameter(const std::string& name) const;
  std::vector<Parameter> get_parameters(const std::vector<std::string>& names) const;
  // Returns false and changes nothing if the parameter is not set. The typed ones throw
  // exceptions::InvalidParameterTypeException.
  bool get_parameter(const std::string& name, Parameter& parameter) const;
  template <typename ParameterT>
  bool get_parameter(const std::string& name, ParameterT& parameter) const;
  template <typename ParameterT>
  bool get_parameters(const std::string& prefix, std::map<std::string, ParameterT>& values) const;
  // If the parameter is not set, returns false and stores the alternative in `parameter`.
  template <typename ParameterT>
  bool get_parameter_or(const std::string& name, ParameterT& parameter, const ParameterT& alternative_value) const;
  template <typename ParameterT>
  ParameterT get_parameter_or(const std::string& name, const ParameterT& alternative_value) const;

  rcl_interfaces::msg::ParameterDescriptor describe_parameter(const std::string& name) const;
  std::vector<rcl_interfaces::msg::ParameterDescriptor> describe_parameters(
      const std::vector<std::string>& names) const;
  std::vector<uint8_t> get_parameter_types(const std::vector<std::string>& names) const;
  rcl_interfaces::msg::ListParametersResult list_parameters(const std::vector<std::string>& prefixes,
                                                            uint64_t depth) const;

  // Callbacks live as long as the handle. The order of a change: pre-set (may alter the list), on-set (may refuse),
  // post-set. Callbacks must not change parameters themselves: exceptions::ParameterModifiedInCallbackException.
  using OnSetParametersCallbackHandle = node_interfaces::OnSetParametersCallbackHandle;
  using PreSetParametersCallbackHandle = node_interfaces::PreSetParametersCallbackHandle;
  using PostSetParametersCallbackHandle = node_interfaces::PostSetParametersCallbackHandle;
  using OnSetParametersCallbackType = OnSetParametersCallbackHandle::OnSetParametersCallbackType;
  using PreSetParametersCallbackType = PreSetParametersCallbackHandle::PreSetParametersCallbackType;
  using PostSetParametersCallbackType = PostSetParametersCallbackHandle::PostSetParametersCallbackType;
  [[nodiscard]] OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(
      OnSetParametersCallbackType callback);
  [[nodiscard]] PreSetParametersCallbackHandle::SharedPtr add_pre_set_parameters_callback(
      PreSetParametersCallbackType callback);
  [[nodiscard]] PostSetParametersCallbackHandle::SharedPtr add_post_set_parameters_callback(
      PostSetParametersCallbackType callback);
  void remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle);
  void remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle);
  void remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle);

  // The known graph of the whole system. Topic names are expanded and remapped as for a publisher.
  std::vector<std::string> get_node_names() const { return node_graph_->get_node_names(); }
  std::map<std::string, std::vector<std::string>> get_topic_names_and_types() const {
    return node_graph_->get_topic_names_and_types();
  }
  std::vector<TopicEndpointInfo> get_publishers_info_by_topic(const std::string& topic_name,
                                                              bool no_mangle = false) const {
    return node_graph_->get_publishers_info_by_topic(topic_name, no_mangle);
  }
  std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(const std::string& topic_name,
                                                                 bool no_mangle = false) const {
    return node_graph_->get_subscriptions_info_by_topic(topic_name, no_mangle);
  }
  std::vector<ServiceEndpointInfo> get_clients_info_by_service(const std::string& service_name,
                                                               bool no_mangle = false) const {
    return node_graph_->get_clients_info_by_service(service_name, no_mangle);
  }
  std::vector<ServiceEndpointInfo> get_servers_info_by_service(const std::string& service_name,
                                                               bool no_mangle = false) const {
    return node_graph_->get_servers_info_by_service(service_name, no_mangle);
  }
  size_t count_publishers(const std::string& topic_name) const { return node_graph_->count_publishers(topic_name); }
  size_t count_subscribers(const std::string& topic_name) const { return node_graph_->count_subscribers(topic_name); }
  std::map<std::string, std::vector<std::string>> get_service_names_and_types() const {
    return node_graph_->get_service_names_and_types();
  }
  // Throws exceptions::RCLError if no such node is known.
  std::map<std::string, std::vector<std::string>> get_service_names_and_types_by_node(
      const std::string& node_name, const std::string& namespace_) const {
    return node_graph_->get_service_names_and_types_by_node(node_name, namespace_);
  }
  size_t count_services(const std::string& service_name) const { return node_graph_->count_services(service_name); }
  size_t count_clients(const std::string& service_name) const { return node_graph_->count_clients(service_name); }

  // An event that every later change of the graph sets, and waiting for it. Any number of threads may wait.
  Event::SharedPtr get_graph_event() { return node_graph_->get_graph_event(); }
  // Throws exceptions::InvalidEventError for null. A negative timeout has no limit. Shutdown ends every wait.
  void wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) {
    node_graph_->wait_for_graph_change(event, timeout);
  }

  node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() { return node_base_; }
  node_interfaces::NodeClockInterface::SharedPtr get_node_clock_interface() { return node_clock_; }
  node_interfaces::NodeGraphInterface::SharedPtr get_node_graph_interface() { return node_graph_; }
  node_interfaces::NodeLoggingInterface::SharedPtr get_node_logging_interface() { return node_logging_; }
  node_interfaces::NodeTopicsInterface::SharedPtr get_node_topics_interface() { return node_topics_; }
  node_interfaces::NodeTimersInterface::SharedPtr get_node_timers_interface() { return node_timers_; }
  node_interfaces::NodeServicesInterface::SharedPtr get_node_services_interface() { return node_services_; }
  node_interfaces::NodeWaitablesInterface::SharedPtr get_node_waitables_interface() { return node_waitables_; }
  node_interfaces::NodeParametersInterface::SharedPtr get_node_parameters_interface() { return node_parameters_; }
  node_interfaces::NodeTimeSourceInterface::SharedPtr get_node_time_source_interface() { return node_time_source_; }
  node_interfaces::NodeTypeDescriptionsInterface::SharedPtr get_node_type_descriptions_interface() {
    return node_type_descriptions_;
  }

 protected:
  AnyNode(const std::string& node_name, const std::string& node_namespace, const NodeOptions& options);
  // Shares everything with the other node, which must outlive it.
  AnyNode(AnyNode& other, const std::string& sub_namespace);

 private:
  AnyNode(const std::string& node_name, const std::string& node_namespace, const NodeOptions& options,
          const rcl_node_options_t& rcl_options);

  // Absolute and private names do not change.
  std::string extend_name(const std::string& name) const;

  NodeOptions options_;
  node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  node_interfaces::NodeLoggingInterface::SharedPtr node_logging_;
  node_interfaces::NodeGraphInterface::SharedPtr node_graph_;
  node_interfaces::NodeTimersInterface::SharedPtr node_timers_;
  node_interfaces::NodeTopicsInterface::SharedPtr node_topics_;
  node_interfaces::NodeServicesInterface::SharedPtr node_services_;
  node_interfaces::NodeWaitablesInterface::SharedPtr node_waitables_;
  node_interfaces::NodeClockInterface::SharedPtr node_clock_;
  node_interfaces::NodeParametersInterface::SharedPtr node_parameters_;
  node_interfaces::NodeTypeDescriptionsInterface::SharedPtr node_type_descriptions_;
  node_interfaces::NodeTimeSourceInterface::SharedPtr node_time_source_;
  std::string sub_namespace_;
  std::string effective_namespace_;
};

}  // namespace rclcpp::detail

#include "rclcpp/detail/any_node_impl.hpp"
