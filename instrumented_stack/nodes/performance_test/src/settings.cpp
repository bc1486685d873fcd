// SPDX-License-Identifier: Apache-2.0
#include "settings.hpp"

#include <stdexcept>

namespace performance_test {

namespace {

[[noreturn]] void refuse(const std::string& parameter, const std::string& value, const std::string& allowed) {
  throw std::invalid_argument("parameter '" + parameter + "' is '" + value + "': it must be " + allowed);
}

int count(rclcpp::Node& node, const std::string& name, int default_value) {
  const int value = node.declare_parameter(name, default_value);
  if (value < 0) {
    refuse(name, std::to_string(value), "0 or more");
  }
  return value;
}

double number(rclcpp::Node& node, const std::string& name, double default_value) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.dynamic_typing = true;  // accept 10 as well as 10.0
  const rclcpp::ParameterValue& value = node.declare_parameter(name, rclcpp::ParameterValue(default_value), descriptor);
  const double result = value.get_type() == rclcpp::PARAMETER_INTEGER
                            ? static_cast<double>(value.get<rclcpp::PARAMETER_INTEGER>())
                            : value.get<rclcpp::PARAMETER_DOUBLE>();
  if (result < 0) {
    refuse(name, std::to_string(result), "0 or more");
  }
  return result;
}

rclcpp::QoS qos(rclcpp::Node& node) {
  const std::string history = node.declare_parameter("history", std::string("keep_last"));
  const int depth = count(node, "history_depth", 16);
  if (history != "keep_last" && history != "keep_all") {
    refuse("history", history, "keep_last or keep_all");
  }
  if (history == "keep_last" && depth == 0) {
    refuse("history_depth", "0", "1 or more");
  }
  rclcpp::QoS qos = history == "keep_all" ? rclcpp::QoS(rclcpp::KeepAll())
                                          : rclcpp::QoS(rclcpp::KeepLast(static_cast<size_t>(depth)));
  const std::string reliability = node.declare_parameter("reliability", std::string("reliable"));
  if (reliability == "best_effort") {
    qos.best_effort();
  } else if (reliability != "reliable") {
    refuse("reliability", reliability, "reliable or best_effort");
  }
  const std::string durability = node.declare_parameter("durability", std::string("volatile"));
  if (durability == "transient_local") {
    qos.transient_local();
  } else if (durability != "volatile") {
    refuse("durability", durability, "volatile or transient_local");
  }
  return qos;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

Settings read_settings(rclcpp::Node& node) {
  Settings settings;
  settings.msg = node.declare_parameter("msg", std::string("Array1k"));
  settings.topic = node.declare_parameter("topic", std::string("test_topic"));
  settings.rate = number(node, "rate", 1000);
  settings.publishers = count(node, "publishers", 1);
  settings.subscribers = count(node, "subscribers", 1);
  settings.expected_publishers = count(node, "expected_publishers", settings.publishers);
  settings.expected_subscribers = count(node, "expected_subscribers", settings.subscribers);
  settings.qos = qos(node);
  settings.intra_process = node.declare_parameter("intra_process", false);
  settings.zero_copy = node.declare_parameter("zero_copy", false);
  settings.max_runtime = number(node, "max_runtime", 0);
  settings.ignore = number(node, "ignore", 0);
  settings.logfile = node.declare_parameter("logfile", std::string());
  if (settings.publishers == 0 && settings.subscribers == 0) {
    throw std::invalid_argument("parameters 'publishers' and 'subscribers' are both 0: there is nothing to measure");
  }
  if (!settings.logfile.empty() && !ends_with(settings.logfile, ".csv") && !ends_with(settings.logfile, ".json")) {
    refuse("logfile", settings.logfile, "a file name that ends with .csv or .json");
  }
  return settings;
}

}  // namespace performance_test
