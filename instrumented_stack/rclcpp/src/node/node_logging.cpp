// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_logging.hpp"

#include <rcutils/error_handling.h>
#include <rcutils/logging.h>

#include <algorithm>
#include <rcl_interfaces/srv/get_logger_levels.hpp>
#include <rcl_interfaces/srv/set_logger_levels.hpp>

#include "rclcpp/create_service.hpp"

namespace rclcpp::node_interfaces {

namespace {

using rcl_interfaces::srv::GetLoggerLevels;
using rcl_interfaces::srv::SetLoggerLevels;

// The level is Unset for a logger without its own level.
void get_levels(const std::shared_ptr<GetLoggerLevels::Request> request,
                std::shared_ptr<GetLoggerLevels::Response> response) {
  for (const std::string& name : request->names) {
    rcl_interfaces::msg::LoggerLevel level;
    level.name = name;
    level.level = static_cast<uint8_t>(std::max(rcutils_logging_get_logger_level(name.c_str()), 0));
    response->levels.push_back(level);
  }
}

void set_levels(const std::shared_ptr<SetLoggerLevels::Request> request,
                std::shared_ptr<SetLoggerLevels::Response> response) {
  for (const rcl_interfaces::msg::LoggerLevel& level : request->levels) {
    rcl_interfaces::msg::SetLoggerLevelsResult result;
    result.successful =
        rcutils_logging_set_logger_level(level.name.c_str(), static_cast<int>(level.level)) == RCUTILS_RET_OK;
    if (!result.successful) {
      result.reason = rcutils_get_error_string().str;
      rcutils_reset_error();
    }
    response->results.push_back(result);
  }
}

}  // namespace

NodeLogging::NodeLogging(NodeBaseInterface::SharedPtr node_base)
    : node_base_(std::move(node_base)),
      logger_(rclcpp::get_logger(rcl_node_get_logger_name(node_base_->get_rcl_node_handle()))) {}

void NodeLogging::create_logger_services(NodeServicesInterface::SharedPtr services) {
  get_levels_ =
      create_service<GetLoggerLevels>(node_base_, services, "~/get_logger_levels", get_levels, ServicesQoS(), nullptr);
  set_levels_ =
      create_service<SetLoggerLevels>(node_base_, services, "~/set_logger_levels", set_levels, ServicesQoS(), nullptr);
}

}  // namespace rclcpp::node_interfaces
