// SPDX-License-Identifier: Apache-2.0
// Lets parameters override the QoS of a publisher or subscription:
//
//   rclcpp::PublisherOptions options;
//   options.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies();
//
// declares `qos_overrides./topic.publisher.history`, `….depth` and `….reliability` as read-only parameters. With an
// identifier they are `qos_overrides./topic.publisher_<id>.history` and so on. For subscriptions, `subscription`
// replaces `publisher`.
#pragma once

#include <functional>
#include <initializer_list>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "rcl_interfaces/msg/set_parameters_result.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

enum class QosPolicyKind {
  AvoidRosNamespaceConventions,
  Deadline,
  Depth,
  Durability,
  History,
  Lifespan,
  Liveliness,
  LivelinessLeaseDuration,
  Reliability,
  Invalid,
};

// The policy's part of the parameter name: `depth`, `liveliness_lease_duration`.
const char* qos_policy_kind_to_cstr(const QosPolicyKind& policy_kind);
std::ostream& operator<<(std::ostream& stream, const QosPolicyKind& policy_kind);

using QosCallbackResult = rcl_interfaces::msg::SetParametersResult;
using QosCallback = std::function<QosCallbackResult(const QoS&)>;

namespace exceptions {

class InvalidQosOverridesException : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace exceptions

class QosOverridingOptions {
 public:
  // No policy can be overridden.
  QosOverridingOptions() = default;
  // `validation_callback` checks the QoS after the overrides. `id` distinguishes several entities of a node on one
  // topic.
  QosOverridingOptions(std::initializer_list<QosPolicyKind> policy_kinds, QosCallback validation_callback = nullptr,
                       std::string id = {});

  // History, depth and reliability.
  static QosOverridingOptions with_default_policies(QosCallback validation_callback = nullptr, std::string id = {});

  const std::string& get_id() const { return id_; }
  const std::vector<QosPolicyKind>& get_policy_kinds() const { return policy_kinds_; }
  const QosCallback& get_validation_callback() const { return validation_callback_; }

 private:
  std::string id_;
  std::vector<QosPolicyKind> policy_kinds_;
  QosCallback validation_callback_;
};

}  // namespace rclcpp
