// Timers for anything that has node interfaces.
#pragma once

#include <chrono>
#include <memory>
#include <type_traits>
#include <utility>

#include "rclcpp/clock.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/node_interfaces/node_timers.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {

// On the steady clock. `group` may be null: the default group. Throws std::invalid_argument for a negative period.
template <typename RepT, typename RatioT, typename CallbackT>
typename WallTimer<std::decay_t<CallbackT>>::SharedPtr create_wall_timer(
    std::chrono::duration<RepT, RatioT> period, CallbackT&& callback, CallbackGroup::SharedPtr group,
    node_interfaces::NodeBaseInterface* node_base, node_interfaces::NodeTimersInterface* node_timers,
    bool autostart = true) {
  auto timer = std::make_shared<WallTimer<std::decay_t<CallbackT>>>(
      detail::timer_period(period), std::forward<CallbackT>(callback), node_base->get_context(), autostart);
  node_timers->add_timer(timer, group);
  return timer;
}

// On the given clock.
template <typename RepT, typename RatioT, typename CallbackT>
typename GenericTimer<std::decay_t<CallbackT>>::SharedPtr create_timer(
    Clock::SharedPtr clock, std::chrono::duration<RepT, RatioT> period, CallbackT&& callback,
    CallbackGroup::SharedPtr group, node_interfaces::NodeBaseInterface* node_base,
    node_interfaces::NodeTimersInterface* node_timers, bool autostart = true) {
  auto timer = std::make_shared<GenericTimer<std::decay_t<CallbackT>>>(std::move(clock), detail::timer_period(period),
                                                                       std::forward<CallbackT>(callback),
                                                                       node_base->get_context(), autostart);
  node_timers->add_timer(timer, group);
  return timer;
}

template <typename NodeT, typename CallbackT>
TimerBase::SharedPtr create_timer(NodeT node, Clock::SharedPtr clock, Duration period, CallbackT&& callback,
                                  CallbackGroup::SharedPtr group = nullptr, bool autostart = true) {
  return create_timer(std::move(clock), period.to_chrono<std::chrono::nanoseconds>(), std::forward<CallbackT>(callback),
                      std::move(group), node->get_node_base_interface().get(), node->get_node_timers_interface().get(),
                      autostart);
}

}  // namespace rclcpp
