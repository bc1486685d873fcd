// SPDX-License-Identifier: Apache-2.0
// Creates timers for any object that has node interfaces.
#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "rclcpp/clock.hpp"
#include "rclcpp/node_interfaces/get_node_base_interface.hpp"
#include "rclcpp/node_interfaces/get_node_clock_interface.hpp"
#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/get_node_timers_interface.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {

namespace detail {

inline void require_node_interfaces(const node_interfaces::NodeBaseInterface* node_base,
                                    const node_interfaces::NodeTimersInterface* node_timers) {
  if (node_base == nullptr) {
    throw std::invalid_argument("input node_base cannot be null");
  }
  if (node_timers == nullptr) {
    throw std::invalid_argument("input node_timers cannot be null");
  }
}

}  // namespace detail

// Uses the steady clock. A null `group` means the default group. Throws std::invalid_argument for a null interface and
// for a period that is negative or too long.
template <typename RepT, typename RatioT, typename CallbackT>
typename WallTimer<std::decay_t<CallbackT>>::SharedPtr create_wall_timer(
    std::chrono::duration<RepT, RatioT> period, CallbackT&& callback, CallbackGroup::SharedPtr group,
    node_interfaces::NodeBaseInterface* node_base, node_interfaces::NodeTimersInterface* node_timers,
    bool autostart = true) {
  detail::require_node_interfaces(node_base, node_timers);
  auto timer = std::make_shared<WallTimer<std::decay_t<CallbackT>>>(
      detail::timer_period(period), std::forward<CallbackT>(callback), node_base->get_context(), autostart);
  node_timers->add_timer(timer, group);
  return timer;
}

// Uses the given clock, which must not be null either.
template <typename RepT, typename RatioT, typename CallbackT>
typename GenericTimer<std::decay_t<CallbackT>>::SharedPtr create_timer(
    Clock::SharedPtr clock, std::chrono::duration<RepT, RatioT> period, CallbackT&& callback,
    CallbackGroup::SharedPtr group, node_interfaces::NodeBaseInterface* node_base,
    node_interfaces::NodeTimersInterface* node_timers, bool autostart = true) {
  if (clock == nullptr) {
    throw std::invalid_argument("clock cannot be null");
  }
  detail::require_node_interfaces(node_base, node_timers);
  auto timer = std::make_shared<GenericTimer<std::decay_t<CallbackT>>>(std::move(clock), detail::timer_period(period),
                                                                       std::forward<CallbackT>(callback),
                                                                       node_base->get_context(), autostart);
  node_timers->add_timer(timer, group);
  return timer;
}

template <typename CallbackT>
TimerBase::SharedPtr create_timer(std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
                                  std::shared_ptr<node_interfaces::NodeTimersInterface> node_timers,
                                  Clock::SharedPtr clock, Duration period, CallbackT&& callback,
                                  CallbackGroup::SharedPtr group = nullptr, bool autostart = true) {
  return create_timer(std::move(clock), period.to_chrono<std::chrono::nanoseconds>(), std::forward<CallbackT>(callback),
                      std::move(group), node_base.get(), node_timers.get(), autostart);
}

// `node` is a Node, a pointer to one, or a similar class.
template <typename NodeT, typename CallbackT>
TimerBase::SharedPtr create_timer(NodeT node, Clock::SharedPtr clock, Duration period, CallbackT&& callback,
                                  CallbackGroup::SharedPtr group = nullptr, bool autostart = true) {
  auto& actual_node = node_interfaces::dereferenced(node);
  return create_timer(actual_node.get_node_base_interface(), actual_node.get_node_timers_interface(), std::move(clock),
                      period, std::forward<CallbackT>(callback), std::move(group), autostart);
}

}  // namespace rclcpp
