// SPDX-License-Identifier: Apache-2.0
// The known facts about one publisher or subscription of the system.
#pragma once

#include <rcl/graph.h>

#include <array>
#include <cstdint>
#include <string>

#include "rclcpp/qos.hpp"

namespace rclcpp {

enum class EndpointType {
  Invalid = RMW_ENDPOINT_INVALID,
  Publisher = RMW_ENDPOINT_PUBLISHER,
  Subscription = RMW_ENDPOINT_SUBSCRIPTION,
  Client = RMW_ENDPOINT_CLIENT,
  Server = RMW_ENDPOINT_SERVER,
};

// For an endpoint of another process, history and depth are unknown: HistoryPolicy::Unknown and 0.
class TopicEndpointInfo {
 public:
  explicit TopicEndpointInfo(const rcl_topic_endpoint_info_t& info);

  std::string& node_name() { return node_name_; }
  const std::string& node_name() const { return node_name_; }
  std::string& node_namespace() { return node_namespace_; }
  const std::string& node_namespace() const { return node_namespace_; }
  // `std_msgs/msg/String`
  std::string& topic_type() { return topic_type_; }
  const std::string& topic_type() const { return topic_type_; }
  // The hash of the type's description; zero if the endpoint does not announce it.
  rosidl_type_hash_t& topic_type_hash() { return topic_type_hash_; }
  const rosidl_type_hash_t& topic_type_hash() const { return topic_type_hash_; }
  rclcpp::EndpointType& endpoint_type() { return endpoint_type_; }
  const rclcpp::EndpointType& endpoint_type() const { return endpoint_type_; }
  // Identifies the endpoint in the whole system; the same value as in the trace.
  std::array<uint8_t, RMW_GID_STORAGE_SIZE>& endpoint_gid() { return endpoint_gid_; }
  const std::array<uint8_t, RMW_GID_STORAGE_SIZE>& endpoint_gid() const { return endpoint_gid_; }
  QoS& qos_profile() { return qos_profile_; }
  const QoS& qos_profile() const { return qos_profile_; }

 private:
  std::string node_name_;
  std::string node_namespace_;
  std::string topic_type_;
  rosidl_type_hash_t topic_type_hash_;
  rclcpp::EndpointType endpoint_type_;
  std::array<uint8_t, RMW_GID_STORAGE_SIZE> endpoint_gid_;
  QoS qos_profile_;
};

}  // namespace rclcpp
