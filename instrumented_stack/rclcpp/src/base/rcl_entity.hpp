// SPDX-License-Identifier: Apache-2.0
// What publishers, subscriptions, clients and services do alike with rcl.
#pragma once

#include <rcl/node.h>

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp::detail {

// Throws exceptions::InvalidTopicNameError if `name`, as written in the program, is malformed. Otherwise throws
// exceptions::RCLError with rcl's reason: expansion or remapping can make a name wrong.
[[noreturn]] void throw_invalid_topic_name(const std::string& name);
// Like throw_invalid_topic_name(), with exceptions::InvalidServiceNameError.
[[noreturn]] void throw_invalid_service_name(const std::string& name);

// Shares an entity that rcl has initialised. It ends with its last owner, and its node not before. `failure` is logged
// if it cannot be ended.
template <typename EntityT>
std::shared_ptr<EntityT> shared_entity(std::unique_ptr<EntityT> entity, std::shared_ptr<rcl_node_t> node,
                                       rcl_ret_t (*fini)(EntityT*, rcl_node_t*), const char* failure) {
  return {entity.release(), [node = std::move(node), fini, failure](EntityT* ended) {
            log_error(fini(ended, node.get()), failure);
            delete ended;
          }};
}

// Throws exceptions::RCLError with the code `invalid` if rcl has given null for an invalid entity.
inline QoS qos_of(const rmw_qos_profile_t* profile, rcl_ret_t invalid) {
  if (!profile) {
    exceptions::throw_from_rcl_error(invalid, "failed to get qos settings");
  }
  return QoS(QoSInitialization::from_rmw(*profile), *profile);
}

}  // namespace rclcpp::detail
