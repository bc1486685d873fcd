// SPDX-License-Identifier: Apache-2.0
// Publishes to itself in each of the ways that intra_process_trace_test.cpp looks for in the trace.
#include <memory>
#include <rclcpp/experimental/create_intra_process_buffer.hpp>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

using std_msgs::msg::String;

namespace {

template <typename ConditionT>
void spin_until(rclcpp::Executor& executor, ConditionT condition) {
  while (rclcpp::ok() && !condition()) {
    executor.spin_once(std::chrono::milliseconds(5));
  }
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("worker", rclcpp::NodeOptions().use_intra_process_comms(true));
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);

  const auto publisher = node->create_publisher<String>("topic", 10);
  publisher->publish(std::make_unique<String>());  // there is no subscription

  int near = 0;
  const auto subscription = node->create_subscription<String>("topic", 2, [&near](String::UniquePtr) { ++near; });
  for (int i = 0; i < 3; ++i) {
    publisher->publish(std::make_unique<String>());  // the third takes the place of the first
  }
  spin_until(executor, [&] { return near == 2; });

  int far = 0;
  rclcpp::SubscriptionOptions through_the_middleware;
  through_the_middleware.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
  const auto other = node->create_subscription<String>(
      "topic", 10, [&far](const String&) { ++far; }, through_the_middleware);
  spin_until(executor, [&] { return publisher->get_subscription_count() == 2; });
  publisher->publish(std::make_unique<String>());
  spin_until(executor, [&] { return near == 3 && far == 1; });

  const auto latched = node->create_publisher<String>("latched", rclcpp::QoS(1).transient_local());
  latched->publish(std::make_unique<String>());

  rclcpp::experimental::create_intra_process_buffer<String>(rclcpp::IntraProcessBufferType::SharedPtr, 7,
                                                            std::allocator<void>())
      ->clear();
  rclcpp::shutdown();
}
