// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_interfaces/node_graph.hpp"

#include <rcl/graph.h>
#include <rmw/wait_for_graph_change.h>

#include <algorithm>

#include "node/names_and_types.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp::node_interfaces {

using detail::require_ok;
using detail::to_map;

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
  rcl_names_and_types_t topics = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  require_ok(rcl_get_topic_names_and_types(node_base_->get_rcl_node_handle(), &allocator, no_demangle, &topics),
             "failed to get topic names and types");
  return to_map(topics);
}

size_t NodeGraph::count_publishers(const std::string& topic_name) const {
  size_t count = 0;
  const std::string full_name = node_base_->resolve_topic_or_service_name(topic_name, false);
  require_ok(rcl_count_publishers(node_base_->get_rcl_node_handle(), full_name.c_str(), &count),
             "could not count publishers");
  return count;
}

size_t NodeGraph::count_subscribers(const std::string& topic_name) const {
  size_t count = 0;
  const std::string full_name = node_base_->resolve_topic_or_service_name(topic_name, false);
  require_ok(rcl_count_subscribers(node_base_->get_rcl_node_handle(), full_name.c_str(), &count),
             "could not count subscribers");
  return count;
}

NodeGraph::NamesAndTypes NodeGraph::get_service_names_and_types() const {
  rcl_names_and_types_t services = rcl_get_zero_initialized_names_and_types();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  require_ok(rcl_get_service_names_and_types(node_base_->get_rcl_node_handle(), &allocator, &services),
             "failed to get service names and types");
  return to_map(services);
}

size_t NodeGraph::count_services(const std::string& service_name) const {
  size_t count = 0;
  const std::string full_name = node_base_->resolve_topic_or_service_name(service_name, true);
  require_ok(rcl_count_services(node_base_->get_rcl_node_handle(), full_name.c_str(), &count),
             "could not count services");
  return count;
}

size_t NodeGraph::count_clients(const std::string& service_name) const {
  size_t count = 0;
  const std::string full_name = node_base_->resolve_topic_or_service_name(service_name, true);
  require_ok(rcl_count_clients(node_base_->get_rcl_node_handle(), full_name.c_str(), &count),
             "could not count clients");
  return count;
}

Event::SharedPtr NodeGraph::get_graph_event() {
  // Events may outlive the node interface, so they hold the rcl node.
  return std::make_shared<Event>([node = node_base_->get_shared_rcl_node_handle()] {
    uint64_t number = 0;
    (void)rmw_wait_for_graph_change(rcl_node_get_rmw_handle(node.get()), &number, 0);
    rcl_reset_error();
    return number;
  });
}

void NodeGraph::wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) {
  if (!event) {
    throw exceptions::InvalidEventError();
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

}  // namespace rclcpp::node_interfaces
