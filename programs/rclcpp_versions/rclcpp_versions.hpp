// SPDX-License-Identifier: Apache-2.0
// What rclcpp offers in some distributions of ROS 2 only. The programs that are built against an installation of ROS 2
// (programs/companion/) call it by these names.
#pragma once

#include <fmt/format.h>
#include <rcl_yaml_param_parser/parser.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <rclcpp/exceptions.hpp>
#include <rclcpp/parameter_map.hpp>
#include <rclcpp/rclcpp.hpp>
#include <string>

namespace launch::rclcpp_versions {

// How long it takes at most on an idle machine until a new node knows all others. The middleware of this stack
// announces itself more often than rmw_fastrtps_cpp of Humble does, which has taken almost four seconds.
#ifdef LAUNCH_COMPANION
inline constexpr std::chrono::duration<double> kLongestDiscovery{6};
#else
inline constexpr std::chrono::duration<double> kLongestDiscovery{3};
#endif

namespace detail {

// Endpoints of DDS that belong to servers ("rq", "Request") or clients ("rr", "Reply") of the service. Middlewares that
// have no such topics tell only whether there is a server.
template <typename Node>
std::size_t readers_of_service(const Node& node, const std::string& service, const char* prefix, const char* suffix) {
  constexpr bool kNameOfDds = true;
  return node.get_subscriptions_info_by_topic(prefix + service + suffix, kNameOfDds).size();
}

}  // namespace detail

// How many servers of the service the graph has. Humble has no function for it.
template <typename Node>
std::size_t count_services(const Node& node, const std::string& service) {
  if constexpr (requires { node.count_services(service); }) {
    return node.count_services(service);
  } else {
    const std::size_t known = node.get_service_names_and_types().count(service);
    return std::max(known, detail::readers_of_service(node, service, "rq", "Request"));
  }
}

template <typename Node>
std::size_t count_clients(const Node& node, const std::string& service) {
  if constexpr (requires { node.count_clients(service); }) {
    return node.count_clients(service);
  } else {
    return detail::readers_of_service(node, service, "rr", "Reply");
  }
}

// Of the type of an endpoint: "RIHS01_" and hexadecimal digits, or "INVALID" if it has told none, as all of Humble.
template <typename Endpoint>
std::string type_hash_text(const Endpoint& endpoint) {
  std::string text = "INVALID";
  if constexpr (requires { endpoint.topic_type_hash(); }) {
    const auto& hash = endpoint.topic_type_hash();
    if (hash.version != 0) {
      text = fmt::format("RIHS{:02}_", hash.version);
      for (const std::uint8_t byte : hash.value) {
        text += fmt::format("{:02x}", byte);
      }
    }
  }
  return text;
}

// The parameters of a file for the node, or by nodes as the file has them if `node` is null. Humble reads files only as
// they are. Throws rclcpp's exceptions.
template <typename Path>
rclcpp::ParameterMap parameters_of_file(const Path& file, const char* node) {
  if constexpr (requires { rclcpp::parameter_map_from_yaml_file(file, node); }) {
    return rclcpp::parameter_map_from_yaml_file(file, node);
  } else {
    const std::unique_ptr<rcl_params_t, decltype(&rcl_yaml_node_struct_fini)> read(
        rcl_yaml_node_struct_init(rcutils_get_default_allocator()), rcl_yaml_node_struct_fini);
    if (!rcl_parse_yaml_file(file.c_str(), read.get())) {
      rclcpp::exceptions::throw_from_rcl_error(RCL_RET_ERROR);
    }
    return rclcpp::parameter_map_from(read.get(), node);
  }
}

}  // namespace launch::rclcpp_versions
