// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/executors.hpp"

#include <utility>

#include "base/progress.hpp"

namespace rclcpp {

namespace {

ExecutorOptions options_for(node_interfaces::NodeBaseInterface& node) {
  ExecutorOptions options;
  options.context = node.get_context();
  return options;
}

}  // namespace

[[gnu::hot]] void executors::SingleThreadedExecutor::spin() {
  const SpinningScope scope(*this, "spin()");
  const progress::Spin spin(progress::Doing::kNothing);
  while (context_->is_valid() && spinning_) {
    AnyExecutable any_executable;
    if (get_next_executable(any_executable)) {
      execute_any_executable(any_executable);
    }
  }
}

void spin(node_interfaces::NodeBaseInterface::SharedPtr node) {
  executors::SingleThreadedExecutor executor(options_for(*node));
  executor.add_node(node);
  executor.spin();
}

void spin(Node::SharedPtr node) {
  spin(node->get_node_base_interface());
}

void spin_some(node_interfaces::NodeBaseInterface::SharedPtr node) {
  executors::SingleThreadedExecutor executor(options_for(*node));
  executor.spin_node_some(node);
}

void spin_some(Node::SharedPtr node) {
  spin_some(node->get_node_base_interface());
}

void spin_all(node_interfaces::NodeBaseInterface::SharedPtr node, std::chrono::nanoseconds max_duration) {
  executors::SingleThreadedExecutor executor(options_for(*node));
  executor.add_node(node);
  executor.spin_all(max_duration);
}

void spin_all(Node::SharedPtr node, std::chrono::nanoseconds max_duration) {
  spin_all(node->get_node_base_interface(), max_duration);
}

}  // namespace rclcpp
