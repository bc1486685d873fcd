// SPDX-License-Identifier: Apache-2.0
// Receives one message, without a callback and without an executor.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "rclcpp/guard_condition.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/wait_set.hpp"

namespace rclcpp {

// Waits for the next message of the subscription; a negative timeout waits forever. No executor may serve the
// subscription meanwhile. Returns false when the time is over or the context ends.
template <typename MessageT, typename RepT = int64_t, typename PeriodT = std::milli>
bool wait_for_message(MessageT& out, std::shared_ptr<Subscription<MessageT>> subscription,
                      std::shared_ptr<Context> context,
                      std::chrono::duration<RepT, PeriodT> time_to_wait = std::chrono::duration<RepT, PeriodT>(-1)) {
  const auto ended = std::make_shared<GuardCondition>(context);
  struct EndCallback {
    Context& context;
    OnShutdownCallbackHandle handle;
    ~EndCallback() { context.remove_on_shutdown_callback(handle); }
  };
  const EndCallback end_callback{*context, context->add_on_shutdown_callback([weak = std::weak_ptr(ended)] {
                                   if (const auto condition = weak.lock()) {
                                     condition->trigger();
                                   }
                                 })};
  if (!context->is_valid()) {
    return false;
  }
  SubscriptionWaitSetMask messages_only;
  messages_only.include_events = false;
  messages_only.include_intra_process_waitable = false;
  WaitSet wait_set({}, {ended}, {}, {}, {}, {}, context);
  wait_set.add_subscription(subscription, messages_only);
  const auto result = wait_set.wait(time_to_wait);
  if (result.kind() != WaitResultKind::Ready || wait_set.get_rcl_wait_set().guard_conditions[0]) {
    return false;
  }
  MessageInfo info;
  return subscription->take(out, info);
}

// Creates a subscription for the wait.
template <typename MessageT, typename RepT = int64_t, typename PeriodT = std::milli>
bool wait_for_message(MessageT& out, std::shared_ptr<Node> node, const std::string& topic,
                      std::chrono::duration<RepT, PeriodT> time_to_wait = std::chrono::duration<RepT, PeriodT>(-1),
                      const QoS& qos = SystemDefaultsQoS()) {
  auto subscription = node->create_subscription<MessageT>(topic, qos, [](const std::shared_ptr<const MessageT>) {});
  return wait_for_message(out, subscription, node->get_node_base_interface()->get_context(), time_to_wait);
}

}  // namespace rclcpp
