// SPDX-License-Identifier: Apache-2.0
// Reads and changes the parameters of another node through its services.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <rcl_interfaces/msg/list_parameters_result.hpp>
#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rcl_interfaces/msg/parameter_event.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <rcl_interfaces/srv/describe_parameters.hpp>
#include <rcl_interfaces/srv/get_parameter_types.hpp>
#include <rcl_interfaces/srv/get_parameters.hpp>
#include <rcl_interfaces/srv/list_parameters.hpp>
#include <rcl_interfaces/srv/set_parameters.hpp>
#include <rcl_interfaces/srv/set_parameters_atomically.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "rclcpp/client.hpp"
#include "rclcpp/create_subscription.hpp"
#include "rclcpp/executors.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/parameter_map.hpp"

namespace rclcpp {

// Functions return futures, and call the callback, if any, when the answer has come; an executor must spin the node. If
// the remote node has not declared the parameters, the answer is empty, or its result says so.
class AsyncParametersClient {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(AsyncParametersClient)

  template <typename ResultT>
  using Callback = std::function<void(std::shared_future<ResultT>)>;
  using SetResult = rcl_interfaces::msg::SetParametersResult;
  using Descriptor = rcl_interfaces::msg::ParameterDescriptor;
  using ListResult = rcl_interfaces::msg::ListParametersResult;

  // An empty remote name means the node itself.
  AsyncParametersClient(node_interfaces::NodeBaseInterface::SharedPtr node_base,
                        node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                        node_interfaces::NodeServicesInterface::SharedPtr node_services,
                        const std::string& remote_node_name = "", const QoS& qos = ParametersQoS(),
                        CallbackGroup::SharedPtr group = nullptr);
  AsyncParametersClient(node_interfaces::NodeBaseInterface::SharedPtr node_base,
                        node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                        const node_interfaces::NodeGraphInterface::SharedPtr& /*node_graph*/,
                        node_interfaces::NodeServicesInterface::SharedPtr node_services,
                        const std::string& remote_node_name = "", const QoS& qos = ParametersQoS(),
                        CallbackGroup::SharedPtr group = nullptr)
      : AsyncParametersClient(std::move(node_base), std::move(node_topics), std::move(node_services), remote_node_name,
                              qos, std::move(group)) {}
  template <typename NodeT>
  explicit AsyncParametersClient(const std::shared_ptr<NodeT>& node, const std::string& remote_node_name = "",
                                 const QoS& qos = ParametersQoS(), CallbackGroup::SharedPtr group = nullptr)
      : AsyncParametersClient(node.get(), remote_node_name, qos, std::move(group)) {}
  template <typename NodeT>
  explicit AsyncParametersClient(NodeT* node, const std::string& remote_node_name = "",
                                 const QoS& qos = ParametersQoS(), CallbackGroup::SharedPtr group = nullptr)
      : AsyncParametersClient(node->get_node_base_interface(), node->get_node_topics_interface(),
                              node->get_node_services_interface(), remote_node_name, qos, std::move(group)) {}
  RCLCPP_DISABLE_COPY(AsyncParametersClient)

  std::shared_future<std::vector<Parameter>> get_parameters(const std::vector<std::string>& names,
                                                            Callback<std::vector<Parameter>> callback = nullptr);
  std::shared_future<std::vector<Descriptor>> describe_parameters(const std::vector<std::string>& names,
                                                                  Callback<std::vector<Descriptor>> callback = nullptr);
  std::shared_future<std::vector<ParameterType>> get_parameter_types(
      const std::vector<std::string>& names, Callback<std::vector<ParameterType>> callback = nullptr);
  std::shared_future<std::vector<SetResult>> set_parameters(const std::vector<Parameter>& parameters,
                                                            Callback<std::vector<SetResult>> callback = nullptr);
  // Sets all parameters or none.
  std::shared_future<SetResult> set_parameters_atomically(const std::vector<Parameter>& parameters,
                                                          Callback<SetResult> callback = nullptr);
  std::shared_future<std::vector<SetResult>> delete_parameters(const std::vector<std::string>& names);
  // Sets the parameters that the file, or the map, has for the remote node. Throw
  // exceptions::InvalidParametersException if it has none, and what parameter_map_from_yaml_file() throws.
  std::shared_future<std::vector<SetResult>> load_parameters(const std::string& yaml_filename);
  std::shared_future<std::vector<SetResult>> load_parameters(const ParameterMap& parameter_map);
  std::shared_future<ListResult> list_parameters(const std::vector<std::string>& prefixes, uint64_t depth,
                                                 Callback<ListResult> callback = nullptr);

  // Subscribes to the parameter changes of all nodes.
  template <typename CallbackT, typename AllocatorT = std::allocator<void>>
  Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr on_parameter_event(
      CallbackT&& callback, const QoS& qos = ParameterEventsQoS(),
      const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>()) {
    return on_parameter_event(node_topics_, std::forward<CallbackT>(callback), qos, options);
  }
  // The same without a client. `node` is a Node, a pointer to one, a similar class, or only its topics interface.
  template <typename CallbackT, typename NodeT, typename AllocatorT = std::allocator<void>,
            typename = std::enable_if_t<!std::is_convertible_v<CallbackT, QoS>>>
  static Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr on_parameter_event(
      NodeT&& node, CallbackT&& callback, const QoS& qos = ParameterEventsQoS(),
      const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>()) {
    return create_subscription<rcl_interfaces::msg::ParameterEvent>(node, "/parameter_events", qos,
                                                                    std::forward<CallbackT>(callback), options);
  }

  // Whether all six services are available.
  bool service_is_ready() const;
  // Returns false after `timeout` (negative: never) or when the context ends.
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_service(std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return wait_for_service_nanoseconds(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }

  node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() const { return node_base_; }

 private:
  bool wait_for_service_nanoseconds(std::chrono::nanoseconds timeout);
  std::vector<ClientBase::SharedPtr> clients() const;

  std::string remote_node_name_;  // fully qualified
  node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  node_interfaces::NodeTopicsInterface::SharedPtr node_topics_;
  Client<rcl_interfaces::srv::GetParameters>::SharedPtr get_;
  Client<rcl_interfaces::srv::GetParameterTypes>::SharedPtr get_types_;
  Client<rcl_interfaces::srv::SetParameters>::SharedPtr set_;
  Client<rcl_interfaces::srv::SetParametersAtomically>::SharedPtr set_atomically_;
  Client<rcl_interfaces::srv::DescribeParameters>::SharedPtr describe_;
  Client<rcl_interfaces::srv::ListParameters>::SharedPtr list_;
};

// Spins the node until the answer has come. The node must not be in an executor other than the one given here. An
// answer that does not come in time (negative timeout: no limit) is empty.
class SyncParametersClient {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(SyncParametersClient)

  using SetResult = AsyncParametersClient::SetResult;
  using Descriptor = AsyncParametersClient::Descriptor;
  using ListResult = AsyncParametersClient::ListResult;

  template <typename NodeT>
  explicit SyncParametersClient(const std::shared_ptr<NodeT>& node, const std::string& remote_node_name = "",
                                const QoS& qos = ParametersQoS())
      : SyncParametersClient(own_executor(*node), node, remote_node_name, qos) {}
  // For use in constructors of nodes.
  template <typename NodeT>
  explicit SyncParametersClient(NodeT* node, const std::string& remote_node_name = "", const QoS& qos = ParametersQoS())
      : executor_(own_executor(*node)), client_(node, remote_node_name, qos) {}
  template <typename NodeT>
  SyncParametersClient(Executor::SharedPtr executor, const std::shared_ptr<NodeT>& node,
                       const std::string& remote_node_name = "", const QoS& qos = ParametersQoS())
      : executor_(std::move(executor)), client_(node, remote_node_name, qos) {}
  template <typename NodeT>
  SyncParametersClient(Executor::SharedPtr executor, NodeT* node, const std::string& remote_node_name = "",
                       const QoS& qos = ParametersQoS())
      : executor_(std::move(executor)), client_(node, remote_node_name, qos) {}
  SyncParametersClient(Executor::SharedPtr executor, node_interfaces::NodeBaseInterface::SharedPtr node_base,
                       node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                       const node_interfaces::NodeGraphInterface::SharedPtr& node_graph,
                       node_interfaces::NodeServicesInterface::SharedPtr node_services,
                       const std::string& remote_node_name = "", const QoS& qos = ParametersQoS())
      : executor_(std::move(executor)),
        client_(std::move(node_base), std::move(node_topics), node_graph, std::move(node_services), remote_node_name,
                qos) {}

  template <typename RepT = int64_t, typename RatioT = std::milli>
  std::vector<Parameter> get_parameters(
      const std::vector<std::string>& names,
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return result_of(client_.get_parameters(names), timeout);
  }
  bool has_parameter(const std::string& name);
  template <typename T>
  T get_parameter(const std::string& name, const T& default_value) {
    const std::vector<Parameter> found = get_parameters({name});
    return found.empty() || found.front().get_type() == PARAMETER_NOT_SET ? default_value
                                                                          : found.front().get_value<T>();
  }
  // Throws std::runtime_error if the parameter is not set.
  template <typename T>
  T get_parameter(const std::string& name) {
    const std::vector<Parameter> found = get_parameters({name});
    if (found.empty() || found.front().get_type() == PARAMETER_NOT_SET) {
      throw std::runtime_error("Parameter '" + name + "' is not set");
    }
    return found.front().get_value<T>();
  }
  template <typename RepT = int64_t, typename RatioT = std::milli>
  std::vector<Descriptor> describe_parameters(
      const std::vector<std::string>& names,
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return result_of(client_.describe_parameters(names), timeout);
  }
  template <typename RepT = int64_t, typename RatioT = std::milli>
  std::vector<ParameterType> get_parameter_types(
      const std::vector<std::string>& names,
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return result_of(client_.get_parameter_types(names), timeout);
  }
  template <typename RepT = int64_t, typename RatioT = std::milli>
  std::vector<SetResult> set_parameters(
      const std::vector<Parameter>& parameters,
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return result_of(client_.set_parameters(parameters), timeout);
  }
  // Throws std::runtime_error if there is no answer.
  template <typename RepT = int64_t, typename RatioT = std::milli>
  SetResult set_parameters_atomically(
      const std::vector<Parameter>& parameters,
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    const auto future = client_.set_parameters_atomically(parameters);
    if (!spin_until_complete(future, timeout)) {
      throw std::runtime_error("Unable to get result of set parameters service call.");
    }
    return future.get();
  }
  template <typename RepT = int64_t, typename RatioT = std::milli>
  std::vector<SetResult> delete_parameters(
      const std::vector<std::string>& names,
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return result_of(client_.delete_parameters(names), timeout);
  }
  template <typename RepT = int64_t, typename RatioT = std::milli>
  std::vector<SetResult> load_parameters(
      const std::string& yaml_filename,
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return result_of(client_.load_parameters(yaml_filename), timeout);
  }
  // Throws std::runtime_error if there is no answer.
  template <typename RepT = int64_t, typename RatioT = std::milli>
  ListResult list_parameters(const std::vector<std::string>& prefixes, uint64_t depth,
                             std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    const auto future = client_.list_parameters(prefixes, depth);
    if (!spin_until_complete(future, timeout)) {
      throw std::runtime_error("Unable to get result of list parameters service call.");
    }
    return future.get();
  }

  template <typename CallbackT>
  auto on_parameter_event(CallbackT&& callback) {
    return client_.on_parameter_event(std::forward<CallbackT>(callback));
  }
  template <typename CallbackT, typename NodeT>
  static auto on_parameter_event(NodeT&& node, CallbackT&& callback) {
    return AsyncParametersClient::on_parameter_event(node, std::forward<CallbackT>(callback));
  }
  bool service_is_ready() const { return client_.service_is_ready(); }
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_service(std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return client_.wait_for_service(timeout);
  }

 private:
  template <typename NodeT>
  static Executor::SharedPtr own_executor(NodeT& node) {
    ExecutorOptions options;
    options.context = node.get_node_base_interface()->get_context();
    return std::make_shared<executors::SingleThreadedExecutor>(options);
  }

  template <typename FutureT, typename DurationT>
  bool spin_until_complete(const FutureT& future, DurationT timeout) {
    return executors::spin_node_until_future_complete(*executor_, client_.get_node_base_interface(), future, timeout) ==
           FutureReturnCode::SUCCESS;
  }
  template <typename ResultT, typename DurationT>
  ResultT result_of(const std::shared_future<ResultT>& future, DurationT timeout) {
    return spin_until_complete(future, timeout) ? future.get() : ResultT();
  }

  Executor::SharedPtr executor_;
  AsyncParametersClient client_;
};

}  // namespace rclcpp
