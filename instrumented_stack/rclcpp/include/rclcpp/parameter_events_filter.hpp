// SPDX-License-Identifier: Apache-2.0
// The changes of a parameter event that concern some names and some kinds of change.
#pragma once

#include <algorithm>
#include <memory>
#include <rcl_interfaces/msg/parameter.hpp>
#include <rcl_interfaces/msg/parameter_event.hpp>
#include <rcl_interfaces/msg/parameter_type.hpp>
#include <rcl_interfaces/msg/parameter_value.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/macros.hpp"

namespace rclcpp {

class ParameterEventsFilter {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(ParameterEventsFilter)
  enum class EventType { NEW, DELETED, CHANGED };
  using EventPair = std::pair<EventType, const rcl_interfaces::msg::Parameter*>;

  // Throws std::invalid_argument without an event.
  ParameterEventsFilter(std::shared_ptr<const rcl_interfaces::msg::ParameterEvent> event,
                        const std::vector<std::string>& names, const std::vector<EventType>& types)
      : event_(std::move(event)) {
    if (!event_) {
      throw std::invalid_argument("event cannot be null");
    }
    const auto add = [&](EventType type, const std::vector<rcl_interfaces::msg::Parameter>& parameters) {
      if (std::find(types.begin(), types.end(), type) == types.end()) {
        return;
      }
      for (const rcl_interfaces::msg::Parameter& parameter : parameters) {
        if (std::find(names.begin(), names.end(), parameter.name) != names.end()) {
          result_.emplace_back(type, &parameter);
        }
      }
    };
    add(EventType::NEW, event_->new_parameters);
    add(EventType::CHANGED, event_->changed_parameters);
    add(EventType::DELETED, event_->deleted_parameters);
  }

  // New ones first, then changed ones, then deleted ones. They live as long as the filter.
  const std::vector<EventPair>& get_events() const { return result_; }

 private:
  std::vector<EventPair> result_;
  std::shared_ptr<const rcl_interfaces::msg::ParameterEvent> event_;
};

}  // namespace rclcpp
