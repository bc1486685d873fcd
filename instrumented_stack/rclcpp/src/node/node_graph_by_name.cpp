// SPDX-License-Identifier: Apache-2.0
// The functions of NodeGraph for one node or one topic.
#include <algorithm>

#include "node/names_and_types.hpp"
#include "rclcpp/node_interfaces/node_graph.hpp"

namespace rclcpp {

TopicEndpointInfo::TopicEndpointInfo(const rcl_topic_endpoint_info_t& info)
    : node_name_(info.node_name),
      node_namespace_(info.node_namespace),
      topic_type_(info.topic_type),
      topic_type_hash_(info.topic_type_hash),
      endpoint_type_(static_cast<rclcpp::EndpointType>(info.endpoint_type)),
      qos_profile_(QoSInitialization(info.qos_profile.history, info.qos_profile.depth), info.qos_profile) {
  std::copy(std::begin(info.endpoint_gid), std::end(info.endpoint_gid), endpoint_gid_.begin());
}

namespace node_interfaces {

using detail::require_ok;
using detail::to_map;

namespace {

using AskForEndpoints = rcl_ret_t (*)(const rcl_node_t*, rcl_allocator_t*, const char*, bool,
                                      rcl_topic_endpoint_info_array_t*);

std::vector<TopicEndpointInfo> endpoints(const NodeBaseInterface& node_base, const std::string& topic_name,
                                         bool no_mangle, AskForEndpoints ask) {
  const std::string name = no_mangle ? topic_name : node_base.resolve_topic_or_service_name(topic_name, false);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_topic_endpoint_info_array_t infos = rcl_get_zero_initialized_topic_endpoint_info_array();
  require_ok(ask(node_base.get_rcl_node_handle(), &allocator, name.c_str(), no_mangle, &infos),
             "failed to get information about a topic");
  std::vector<TopicEndpointInfo> result;
  for (size_t i = 0; i < infos.size; ++i) {
    result.emplace_back(infos.info_array[i]);
  }
  require_ok(rcl_topic_endpoint_info_array_fini(&infos, &allocator), "failed to free information about a topic");
  return result;
}

}  // namespace

NodeGraph::NamesAndTypes NodeGraph::get_publisher_names_and_types_by_node(const std::string& node_name,
                                                                          const std::string& namespace_,
                                                                          bool no_demangle) const {
  rcl_names_and_types_t topics = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  require_ok(rcl_get_publisher_names_and_types_by_node(node_base_->get_rcl_node_handle(), &allocator, no_demangle,
                                                       node_name.c_str(), namespace_.c_str(), &topics),
             "failed to get publisher names and types by node");
  return to_map(topics);
}

NodeGraph::NamesAndTypes NodeGraph::get_subscriber_names_and_types_by_node(const std::string& node_name,
                                                                           const std::string& namespace_,
                                                                           bool no_demangle) const {
  rcl_names_and_types_t topics = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  require_ok(rcl_get_subscriber_names_and_types_by_node(node_base_->get_rcl_node_handle(), &allocator, no_demangle,
                                                        node_name.c_str(), namespace_.c_str(), &topics),
             "failed to get subscriber names and types by node");
  return to_map(topics);
}

NodeGraph::NamesAndTypes NodeGraph::get_service_names_and_types_by_node(const std::string& node_name,
                                                                        const std::string& namespace_) const {
  rcl_names_and_types_t services = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  require_ok(rcl_get_service_names_and_types_by_node(node_base_->get_rcl_node_handle(), &allocator, node_name.c_str(),
                                                     namespace_.c_str(), &services),
             "failed to get service names and types by node");
  return to_map(services);
}

NodeGraph::NamesAndTypes NodeGraph::get_client_names_and_types_by_node(const std::string& node_name,
                                                                       const std::string& namespace_) const {
  rcl_names_and_types_t services = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  require_ok(rcl_get_client_names_and_types_by_node(node_base_->get_rcl_node_handle(), &allocator, node_name.c_str(),
                                                    namespace_.c_str(), &services),
             "failed to get client names and types by node");
  return to_map(services);
}

std::vector<TopicEndpointInfo> NodeGraph::get_publishers_info_by_topic(const std::string& topic_name,
                                                                       bool no_mangle) const {
  return endpoints(*node_base_, topic_name, no_mangle, rcl_get_publishers_info_by_topic);
}

std::vector<TopicEndpointInfo> NodeGraph::get_subscriptions_info_by_topic(const std::string& topic_name,
                                                                          bool no_mangle) const {
  return endpoints(*node_base_, topic_name, no_mangle, rcl_get_subscriptions_info_by_topic);
}

}  // namespace node_interfaces

}  // namespace rclcpp
