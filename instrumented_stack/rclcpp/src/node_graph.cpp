#include "rclcpp/node_interfaces/node_graph.hpp"

#include <rcl/graph.h>

#include "rclcpp/exceptions.hpp"

namespace rclcpp::node_interfaces {

namespace {

void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, what);
  }
}

// Also frees them.
std::map<std::string, std::vector<std::string>> to_map(rcl_names_and_types_t& names_and_types) {
  std::map<std::string, std::vector<std::string>> result;
  for (size_t i = 0; i < names_and_types.names.size; ++i) {
    const rcutils_string_array_t& types = names_and_types.types[i];
    result[names_and_types.names.data[i]] = std::vector<std::string>(types.data, types.data + types.size);
  }
  require_ok(rcl_names_and_types_fini(&names_and_types), "failed to free names and types");
  return result;
}

}  // namespace

std::vector<std::string> NodeGraph::get_node_names() const {
  rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t namespaces = rcutils_get_zero_initialized_string_array();
  require_ok(rcl_get_node_names(node_base_->get_rcl_node_handle(), rcl_get_default_allocator(), &names, &namespaces),
             "failed to get node names");
  std::vector<std::string> result;
  for (size_t i = 0; i < names.size; ++i) {
    const std::string node_namespace = namespaces.data[i];
    result.push_back((node_namespace == "/" ? "" : node_namespace) + "/" + names.data[i]);
  }
  require_ok(rcutils_string_array_fini(&names), "failed to free node names");
  require_ok(rcutils_string_array_fini(&namespaces), "failed to free node namespaces");
  return result;
}

std::map<std::string, std::vector<std::string>> NodeGraph::get_topic_names_and_types(bool no_demangle) const {
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

std::map<std::string, std::vector<std::string>> NodeGraph::get_service_names_and_types() const {
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

}  // namespace rclcpp::node_interfaces
