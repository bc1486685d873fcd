// SPDX-License-Identifier: Apache-2.0
// The known facts about one client or server of a service.
#pragma once

#include <rcl/graph.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rclcpp/qos.hpp"
#include "rclcpp/topic_endpoint_info.hpp"

namespace rclcpp {

// A client or server has two endpoints, its reader and its writer, in this order. Of another process, history and depth
// are unknown: HistoryPolicy::Unknown and 0.
class ServiceEndpointInfo {
 public:
  explicit ServiceEndpointInfo(const rcl_service_endpoint_info_t& info);

  std::string& node_name() { return node_name_; }
  const std::string& node_name() const { return node_name_; }
  std::string& node_namespace() { return node_namespace_; }
  const std::string& node_namespace() const { return node_namespace_; }
  // `std_srvs/srv/Empty`
  std::string& service_type() { return service_type_; }
  const std::string& service_type() const { return service_type_; }
  // Zero: endpoints announce the hashes of request and response only.
  rosidl_type_hash_t& service_type_hash() { return service_type_hash_; }
  const rosidl_type_hash_t& service_type_hash() const { return service_type_hash_; }
  // Client or Server.
  rclcpp::EndpointType& endpoint_type() { return endpoint_type_; }
  const rclcpp::EndpointType& endpoint_type() const { return endpoint_type_; }
  size_t& endpoint_count() { return endpoint_count_; }
  const size_t& endpoint_count() const { return endpoint_count_; }
  std::vector<std::array<uint8_t, RMW_GID_STORAGE_SIZE>>& endpoint_gids() { return endpoint_gids_; }
  const std::vector<std::array<uint8_t, RMW_GID_STORAGE_SIZE>>& endpoint_gids() const { return endpoint_gids_; }
  std::vector<QoS>& qos_profiles() { return qos_profiles_; }
  const std::vector<QoS>& qos_profiles() const { return qos_profiles_; }

 private:
  std::string node_name_;
  std::string node_namespace_;
  std::string service_type_;
  rosidl_type_hash_t service_type_hash_;
  rclcpp::EndpointType endpoint_type_;
  size_t endpoint_count_;
  std::vector<std::array<uint8_t, RMW_GID_STORAGE_SIZE>> endpoint_gids_;
  std::vector<QoS> qos_profiles_;
};

}  // namespace rclcpp
