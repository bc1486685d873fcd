// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_graph.hpp"

#include <rcl/graph.h>
#include <rmw/wait_for_graph_change.h>

#include <algorithm>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/expand_topic_or_service_name.hpp"

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

ServiceEndpointInfo::ServiceEndpointInfo(const rcl_service_endpoint_info_t& info)
    : node_name_(info.node_name),
      node_namespace_(info.node_namespace),
      service_type_(info.service_type),
      service_type_hash_(info.service_type_hash),
      endpoint_type_(static_cast<rclcpp::EndpointType>(info.endpoint_type)),
      endpoint_count_(info.endpoint_count) {
  for (size_t i = 0; i < info.endpoint_count; ++i) {
    std::copy(std::begin(info.endpoint_gids[i]), std::end(info.endpoint_gids[i]),
              endpoint_gids_.emplace_back().begin());
    const rmw_qos_profile_t& profile = info.qos_profiles[i];
    qos_profiles_.emplace_back(QoSInitialization(profile.history, profile.depth), profile);
  }
}

namespace node_interfaces {

using detail::require_ok;

namespace {

// `ask` is a function of rcl that takes `arguments` between the allocator and the result.
template <typename Ask, typename... Arguments>
NodeGraph::NamesAndTypes names_and_types(const NodeBaseInterface& node_base, const char* failure, Ask ask,
                                         Arguments... arguments) {
  rcl_names_and_types_t found = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  require_ok(ask(node_base.get_rcl_node_handle(), &allocator, arguments..., &found), failure);
  NodeGraph::NamesAndTypes result;
  for (size_t i = 0; i < found.names.size; ++i) {
    const rcutils_string_array_t& types = found.types[i];
    result[found.names.data[i]] = std::vector<std::string>(types.data, types.data + types.size);
  }
  require_ok(rcl_names_and_types_fini(&found), "failed to free names and types");
  return result;
}

using Count = rcl_ret_t (*)(const rcl_node_t*, const char*, size_t*);

size_t counted(const NodeBaseInterface& node_base, const std::string& name, bool is_service, Count count,
               const char* failure) {
  size_t number = 0;
  const std::string full_name = node_base.resolve_topic_or_service_name(name, is_service);
  require_ok(count(node_base.get_rcl_node_handle(), full_name.c_str(), &number), failure);
  return number;
}

using AskForEndpoints = rcl_ret_t (*)(const rcl_node_t*, rcl_allocator_t*, const char*, bool,
                                      rcl_topic_endpoint_info_array_t*);

std::vector<TopicEndpointInfo> endpoints(const NodeBaseInterface& node_base, const std::string& topic_name,
                                         bool no_mangle, AskForEndpoints ask) {
  if (!no_mangle) {  // throws exceptions::InvalidTopicNameError
    (void)expand_topic_or_service_name(topic_name, node_base.get_name(), node_base.get_namespace());
  }
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

using AskForEnds = rcl_ret_t (*)(const rcl_node_t*, rcl_allocator_t*, const char*, bool,
                                 rcl_service_endpoint_info_array_t*);

std::vector<ServiceEndpointInfo> service_ends(const NodeBaseInterface& node_base, const std::string& service_name,
                                              bool no_mangle, AskForEnds ask) {
  const std::string name = node_base.resolve_topic_or_service_name(service_name, true);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_service_endpoint_info_array_t infos = rcl_get_zero_initialized_service_endpoint_info_array();
  require_ok(ask(node_base.get_rcl_node_handle(), &allocator, name.c_str(), no_mangle, &infos),
             "failed to get information about a service");
  const std::vector<ServiceEndpointInfo> result(infos.info_array, infos.info_array + infos.size);
  require_ok(rcl_service_endpoint_info_array_fini(&infos, &allocator), "failed to free information about a service");
  return result;
}

}  // namespace

std::vector<std::string> NodeGraph::get_node_names() const {
  std::vector<std::string> result;
  for (const auto& [name, node_namespace] : get_node_names_and_namespaces()) {
    result.push_back((node_namespace == "/" ? "" : node_namespace) + "/" + name);
  }
  return result;
}

std::vector<std::pair<std::string, std::string>> NodeGraph::get_node_names_and_namespaces() const {
  rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t namespaces = rcutils_get_zero_initialized_string_array();
  require_ok(rcl_get_node_names(node_base_->get_rcl_node_handle(), rcl_get_default_allocator(), &names, &namespaces),
             "failed to get node names");
  std::vector<std::pair<std::string, std::string>> result;
  for (size_t i = 0; i < names.size; ++i) {
    result.emplace_back(names.data[i], namespaces.data[i]);
  }
  require_ok(rcutils_string_array_fini(&names), "failed to free node names");
  require_ok(rcutils_string_array_fini(&namespaces), "failed to free node namespaces");
  return result;
}

std::vector<std::tuple<std::string, std::string, std::string>> NodeGraph::get_node_names_with_enclaves() const {
  std::vector<std::tuple<std::string, std::string, std::string>> result;
  for (const auto& [name, node_namespace] : get_node_names_and_namespaces()) {
    result.emplace_back(name, node_namespace, "/");
  }
  return result;
}

NodeGraph::NamesAndTypes NodeGraph::get_topic_names_and_types(bool no_demangle) const {
  return names_and_types(*node_base_, "failed to get topic names and types", rcl_get_topic_names_and_types,
                         no_demangle);
}

NodeGraph::NamesAndTypes NodeGraph::get_service_names_and_types() const {
  return names_and_types(*node_base_, "failed to get service names and types", rcl_get_service_names_and_types);
}

NodeGraph::NamesAndTypes NodeGraph::get_publisher_names_and_types_by_node(const std::string& node_name,
                                                                          const std::string& namespace_,
                                                                          bool no_demangle) const {
  return names_and_types(*node_base_, "failed to get publisher names and types by node",
                         rcl_get_publisher_names_and_types_by_node, no_demangle, node_name.c_str(), namespace_.c_str());
}

NodeGraph::NamesAndTypes NodeGraph::get_subscriber_names_and_types_by_node(const std::string& node_name,
                                                                           const std::string& namespace_,
                                                                           bool no_demangle) const {
  return names_and_types(*node_base_, "failed to get subscriber names and types by node",
                         rcl_get_subscriber_names_and_types_by_node, no_demangle, node_name.c_str(),
                         namespace_.c_str());
}

NodeGraph::NamesAndTypes NodeGraph::get_service_names_and_types_by_node(const std::string& node_name,
                                                                        const std::string& namespace_) const {
  return names_and_types(*node_base_, "failed to get service names and types by node",
                         rcl_get_service_names_and_types_by_node, node_name.c_str(), namespace_.c_str());
}

NodeGraph::NamesAndTypes NodeGraph::get_client_names_and_types_by_node(const std::string& node_name,
                                                                       const std::string& namespace_) const {
  return names_and_types(*node_base_, "failed to get client names and types by node",
                         rcl_get_client_names_and_types_by_node, node_name.c_str(), namespace_.c_str());
}

size_t NodeGraph::count_publishers(const std::string& topic_name) const {
  return counted(*node_base_, topic_name, false, rcl_count_publishers, "could not count publishers");
}
size_t NodeGraph::count_subscribers(const std::string& topic_name) const {
  return counted(*node_base_, topic_name, false, rcl_count_subscribers, "could not count subscribers");
}
size_t NodeGraph::count_services(const std::string& service_name) const {
  return counted(*node_base_, service_name, true, rcl_count_services, "could not count services");
}
size_t NodeGraph::count_clients(const std::string& service_name) const {
  return counted(*node_base_, service_name, true, rcl_count_clients, "could not count clients");
}

std::vector<TopicEndpointInfo> NodeGraph::get_publishers_info_by_topic(const std::string& topic_name,
                                                                       bool no_mangle) const {
  return endpoints(*node_base_, topic_name, no_mangle, rcl_get_publishers_info_by_topic);
}

std::vector<TopicEndpointInfo> NodeGraph::get_subscriptions_info_by_topic(const std::string& topic_name,
                                                                          bool no_mangle) const {
  return endpoints(*node_base_, topic_name, no_mangle, rcl_get_subscriptions_info_by_topic);
}

std::vector<ServiceEndpointInfo> NodeGraph::get_clients_info_by_service(const std::string& service_name,
                                                                        bool no_mangle) const {
  return service_ends(*node_base_, service_name, no_mangle, rcl_get_clients_info_by_service);
}

std::vector<ServiceEndpointInfo> NodeGraph::get_servers_info_by_service(const std::string& service_name,
                                                                        bool no_mangle) const {
  return service_ends(*node_base_, service_name, no_mangle, rcl_get_servers_info_by_service);
}

Event::SharedPtr NodeGraph::get_graph_event() {
  // Events may outlive the node interface, so they hold the rcl node.
  return std::make_shared<Event>([node = node_base_->get_shared_rcl_node_handle(), user = user_] {
    uint64_t number = 0;
    (void)rmw_wait_for_graph_change(rcl_node_get_rmw_handle(node.get()), &number, 0);
    rcl_reset_error();
    return number;
  });
}

size_t NodeGraph::count_graph_users() const {
  return static_cast<size_t>(user_.use_count()) - 1;
}

const rcl_guard_condition_t* NodeGraph::get_graph_guard_condition() const {
  return rcl_node_get_graph_guard_condition(node_base_->get_rcl_node_handle());
}

void NodeGraph::notify_graph_change() {
  // rcl has no other guard condition to wait for the graph with; it is not changed by triggering it.
  auto* condition = const_cast<rcl_guard_condition_t*>(get_graph_guard_condition());
  require_ok(rcl_trigger_guard_condition(condition), "failed to notify wait set on graph change");
}

void NodeGraph::notify_shutdown() {
  // Whoever waits for the graph waits for the end of the context, too.
}

void NodeGraph::wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) {
  if (!event) {
    throw exceptions::InvalidEventError();
  }
  if (!event->watches_graph()) {
    throw exceptions::EventNotRegisteredError();
  }
  const auto start = std::chrono::steady_clock::now();
  const rmw_node_t* node = rcl_node_get_rmw_handle(node_base_->get_rcl_node_handle());
  uint64_t number = 0;
  (void)rmw_wait_for_graph_change(node, &number, 0);  // before check(): a change between the two ends the wait
  std::chrono::nanoseconds left = timeout;
  while (!event->check() && node_base_->get_context()->is_valid()) {
    if (rmw_wait_for_graph_change(node, &number, left.count()) != RMW_RET_OK) {
      return;
    }
    if (timeout >= std::chrono::nanoseconds::zero()) {
      left = std::max(timeout - (std::chrono::steady_clock::now() - start), std::chrono::nanoseconds::zero());
    }
  }
}

}  // namespace node_interfaces

}  // namespace rclcpp
