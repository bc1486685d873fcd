// SPDX-License-Identifier: Apache-2.0
// Spins one node with a single-threaded executor, in one line. Includes every executor.
#pragma once

#include <chrono>
#include <future>
#include <memory>

#include "rclcpp/executors/events_cbg_executor/events_cbg_executor.hpp"
#include "rclcpp/executors/multi_threaded_executor.hpp"
#include "rclcpp/executors/single_threaded_executor.hpp"
#include "rclcpp/executors/static_single_threaded_executor.hpp"
#include "rclcpp/experimental/executors/events_executor/events_executor.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/utilities.hpp"
#include "rclcpp/wait_set.hpp"

namespace rclcpp {

// Runs the node's callbacks until shutdown.
void spin(node_interfaces::NodeBaseInterface::SharedPtr node);
void spin(Node::SharedPtr node);

// Runs the callbacks that are ready now.
void spin_some(node_interfaces::NodeBaseInterface::SharedPtr node);
void spin_some(Node::SharedPtr node);
void spin_all(node_interfaces::NodeBaseInterface::SharedPtr node, std::chrono::nanoseconds max_duration);
void spin_all(Node::SharedPtr node, std::chrono::nanoseconds max_duration);

namespace executors {

template <typename FutureT, typename RepT = int64_t, typename RatioT = std::milli>
FutureReturnCode spin_node_until_future_complete(
    Executor& executor, node_interfaces::NodeBaseInterface::SharedPtr node, const FutureT& future,
    std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
  struct Membership {
    Executor& executor;
    node_interfaces::NodeBaseInterface::SharedPtr node;
    ~Membership() { executor.remove_node(node); }
  };
  executor.add_node(node);
  const Membership membership{executor, node};
  return executor.spin_until_future_complete(future, timeout);
}

// `node` points to a Node or a similar class.
template <typename NodeT = Node, typename FutureT, typename RepT = int64_t, typename RatioT = std::milli>
FutureReturnCode spin_node_until_future_complete(
    Executor& executor, std::shared_ptr<NodeT> node, const FutureT& future,
    std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
  return spin_node_until_future_complete(executor, node->get_node_base_interface(), future, timeout);
}

}  // namespace executors

// Runs the node's callbacks until the future has its value; a negative timeout waits for ever.
template <typename FutureT, typename RepT = int64_t, typename RatioT = std::milli>
FutureReturnCode spin_until_future_complete(
    node_interfaces::NodeBaseInterface::SharedPtr node, const FutureT& future,
    std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
  ExecutorOptions options;
  options.context = node->get_context();
  executors::SingleThreadedExecutor executor(options);
  return executors::spin_node_until_future_complete(executor, std::move(node), future, timeout);
}

template <typename NodeT = Node, typename FutureT, typename RepT = int64_t, typename RatioT = std::milli>
FutureReturnCode spin_until_future_complete(
    std::shared_ptr<NodeT> node, const FutureT& future,
    std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
  return rclcpp::spin_until_future_complete(node->get_node_base_interface(), future, timeout);
}

}  // namespace rclcpp
