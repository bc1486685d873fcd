// SPDX-License-Identifier: Apache-2.0
// Declares the parameters described in qos_overriding_options.hpp.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/qos_overriding_options.hpp"

namespace rclcpp::detail {

enum class QosEntity { Publisher, Subscription };

// Declares a read-only parameter for each policy of `options` that the entity has. Returns `qos` with their values.
// `topic_name` is the full name. Throws exceptions::InvalidQosOverridesException for a refused or unknown value, and
// what declaring parameters throws.
QoS declare_qos_parameters(const QosOverridingOptions& options, node_interfaces::NodeParametersInterface& parameters,
                           const std::string& topic_name, const QoS& qos, QosEntity entity);

// Like declare_qos_parameters(), with `topic_name` as the creator gave it. Returns `qos` unchanged if `options` has no
// policy. Throws std::runtime_error if there are policies to override but no parameters interface.
QoS overridden_qos(const QosOverridingOptions& options,
                   const std::shared_ptr<node_interfaces::NodeParametersInterface>& parameters,
                   const node_interfaces::NodeBaseInterface& node_base, const std::string& topic_name, const QoS& qos,
                   QosEntity entity);

}  // namespace rclcpp::detail
