// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_components/component_manager.hpp"

#include <algorithm>
#include <ament_index_cpp/get_resource.hpp>
#include <array>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string_view>
#include <thread>
#include <typeinfo>
#include <utility>

#include "nearest_name.hpp"

namespace rclcpp_components {

namespace {

using std::placeholders::_1;
using std::placeholders::_2;
using std::placeholders::_3;

int64_t hardware_threads() {
  return std::max<int64_t>(1, std::thread::hardware_concurrency());
}

// Throws ComponentManagerException if the argument is not a boolean.
bool boolean(const rclcpp::Parameter& argument) {
  if (argument.get_type() != rclcpp::ParameterType::PARAMETER_BOOL) {
    throw ComponentManagerException("Extra component argument '" + argument.get_name() + "' must be a boolean");
  }
  return argument.as_bool();
}

using SetOption = rclcpp::NodeOptions& (rclcpp::NodeOptions::*)(bool);
constexpr std::array<std::pair<std::string_view, SetOption>, 9> kExtraArguments = {
    {{"allow_undeclared_parameters", &rclcpp::NodeOptions::allow_undeclared_parameters},
     {"enable_logger_service", &rclcpp::NodeOptions::enable_logger_service},
     {"enable_rosout", &rclcpp::NodeOptions::enable_rosout},
     {"enable_topic_statistics", &rclcpp::NodeOptions::enable_topic_statistics},
     {"forward_global_arguments", &rclcpp::NodeOptions::use_global_arguments},
     {"start_parameter_event_publisher", &rclcpp::NodeOptions::start_parameter_event_publisher},
     {"start_parameter_services", &rclcpp::NodeOptions::start_parameter_services},
     {"use_clock_thread", &rclcpp::NodeOptions::use_clock_thread},
     {"use_intra_process_comms", &rclcpp::NodeOptions::use_intra_process_comms}}};
constexpr std::string_view kTypeDescriptions = "enable_type_description_service";

// Sets an option of a component, if there is one of that name. Throws ComponentManagerException for a wrong value.
void apply(const rclcpp::Parameter& argument, rclcpp::NodeOptions& options) {
  if (argument.get_name() == kTypeDescriptions) {
    options.append_parameter_override("start_type_description_service", boolean(argument));
  }
  for (const auto& [name, set] : kExtraArguments) {
    if (argument.get_name() == name) {
      (options.*set)(boolean(argument));
    }
  }
}

// Throws ComponentManagerException if there is no extra argument of that name.
void require_known(const std::string& argument) {
  std::vector<std::string_view> names = {kTypeDescriptions};
  for (const auto& [name, set] : kExtraArguments) {
    names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  if (std::binary_search(names.begin(), names.end(), argument)) {
    return;
  }
  std::string known = did_you_mean(argument, names);
  if (known.empty()) {
    for (const std::string_view name : names) {
      known += (known.empty() ? "; known are " : ", ") + std::string(name);
    }
  }
  throw ComponentManagerException("Unknown extra component argument '" + argument + "'" + known);
}

// The name that ROS 2 uses for a component in its log.
std::string factory_class(const std::string& class_name) {
  return "rclcpp_components::NodeFactoryTemplate<" + class_name + ">";
}

}  // namespace

ComponentManager::ComponentManager(std::weak_ptr<rclcpp::Executor> executor, std::string node_name,
                                   const rclcpp::NodeOptions& node_options)
    : Node(std::move(node_name), node_options), executor_(std::move(executor)) {
  load_node_srv_ =
      create_service<LoadNode>("~/_container/load_node", std::bind(&ComponentManager::on_load_node, this, _1, _2, _3));
  unload_node_srv_ = create_service<UnloadNode>("~/_container/unload_node",
                                                std::bind(&ComponentManager::on_unload_node, this, _1, _2, _3));
  list_nodes_srv_ = create_service<ListNodes>("~/_container/list_nodes",
                                              std::bind(&ComponentManager::on_list_nodes, this, _1, _2, _3));

  rcl_interfaces::msg::IntegerRange range;
  range.from_value = 1;
  range.to_value = hardware_threads();
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = "Number of thread";
  descriptor.integer_range.push_back(range);
  descriptor.read_only = true;
  declare_parameter("thread_num", hardware_threads(), descriptor);
}

ComponentManager::~ComponentManager() {
  if (const auto executor = executor_.lock()) {
    for (const auto& [id, wrapper] : node_wrappers_) {
      if (wrapper.get_node_base_interface()->get_associated_with_executor_atomic()) {
        executor->remove_node(wrapper.get_node_base_interface());
      }
    }
  }
}

std::vector<ComponentManager::ComponentResource> ComponentManager::get_component_resources(
    const std::string& package_name, const std::string& resource_index) const {
  std::string content;
  std::string prefix;
  if (package_name.empty() || !ament_index_cpp::get_resource(resource_index, package_name, content, &prefix)) {
    throw ComponentManagerException("Could not find requested resource in ament index");
  }
  std::vector<ComponentResource> resources;
  std::istringstream lines(content);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) {
      continue;
    }
    // The line is CLASS;LIBRARY, with the library relative to the prefix.
    const size_t semicolon = line.find(';');
    if (semicolon == std::string::npos || line.find(';', semicolon + 1) != std::string::npos) {
      throw ComponentManagerException("Invalid resource entry");
    }
    resources.emplace_back(line.substr(0, semicolon),
                           (std::filesystem::path(prefix) / line.substr(semicolon + 1)).string());
  }
  return resources;
}

std::shared_ptr<NodeFactory> ComponentManager::create_component_factory(const ComponentResource& resource) {
  const auto& [class_name, path] = resource;
  auto library = libraries_.find(path);
  if (library == libraries_.end()) {
    RCLCPP_INFO(get_logger(), "Load Library: %s", path.c_str());
    try {
      library = libraries_.emplace(path, path).first;
    } catch (const std::exception& error) {
      throw ComponentManagerException("Failed to load library: " + std::string(error.what()));
    }
  }
  for (const std::string& available : library->second.get_available_classes()) {
    RCLCPP_INFO(get_logger(), "Found class: %s", factory_class(available).c_str());
    if (available == class_name) {
      RCLCPP_INFO(get_logger(), "Instantiate class: %s", factory_class(available).c_str());
      return library->second.create_factory(class_name);
    }
  }
  return nullptr;
}

bool ComponentManager::knows_all_extra_arguments() const {
  return typeid(*this) == typeid(ComponentManager);
}

void ComponentManager::set_executor(const std::weak_ptr<rclcpp::Executor> executor) {
  executor_ = executor;
}

rclcpp::NodeOptions ComponentManager::create_node_options(const std::shared_ptr<LoadNode::Request> request) {
  std::vector<rclcpp::Parameter> parameters;
  for (const rcl_interfaces::msg::Parameter& parameter : request->parameters) {
    parameters.push_back(rclcpp::Parameter::from_parameter_msg(parameter));
  }
  std::vector<std::string> arguments = {"--ros-args"};
  const auto remap = [&](const std::string& rule) { arguments.insert(arguments.end(), {"-r", rule}); };
  for (const auto& rule : request->remap_rules) {
    remap(rule);
  }
  if (!request->node_name.empty()) {
    remap("__node:=" + request->node_name);
  }
  if (!request->node_namespace.empty()) {
    remap("__ns:=" + request->node_namespace);
  }
  auto options = rclcpp::NodeOptions().use_global_arguments(false).parameter_overrides(parameters).arguments(arguments);

  if (request->log_level != 0) {
    options.log_level(static_cast<rclcpp::Logger::Level>(request->log_level));
  }
  for (const rcl_interfaces::msg::Parameter& message : request->extra_arguments) {
    apply(rclcpp::Parameter::from_parameter_msg(message), options);
  }
  return options;
}

void ComponentManager::add_node_to_executor(uint64_t node_id) {
  if (const auto executor = executor_.lock()) {
    executor->add_node(node_wrappers_.at(node_id).get_node_base_interface());
  }
}

void ComponentManager::remove_node_from_executor(uint64_t node_id) {
  if (const auto executor = executor_.lock()) {
    executor->remove_node(node_wrappers_.at(node_id).get_node_base_interface());
  }
}

uint64_t ComponentManager::load_node(const std::shared_ptr<LoadNode::Request>& request) {
  for (const ComponentResource& resource : get_component_resources(request->package_name)) {
    if (resource.first != request->plugin_name) {
      continue;
    }
    const std::shared_ptr<NodeFactory> factory = create_component_factory(resource);
    if (!factory) {
      continue;
    }
    if (knows_all_extra_arguments()) {
      for (const rcl_interfaces::msg::Parameter& argument : request->extra_arguments) {
        require_known(argument.name);
      }
    }
    const rclcpp::NodeOptions options = create_node_options(request);
    const uint64_t node_id = unique_id_++;
    try {
      node_wrappers_.emplace(node_id, factory->create_node_instance(options));
    } catch (const std::exception& error) {
      throw ComponentManagerException("Component constructor threw an exception: " + std::string(error.what()));
    } catch (...) {
      throw ComponentManagerException("Component constructor threw an exception");
    }
    return node_id;
  }
  throw ComponentManagerException("Failed to find class with the requested plugin name.");
}

void ComponentManager::on_load_node(const std::shared_ptr<rmw_request_id_t>,
                                    const std::shared_ptr<LoadNode::Request> request,
                                    std::shared_ptr<LoadNode::Response> response) {
  try {
    const uint64_t node_id = load_node(request);
    const auto node = node_wrappers_.at(node_id).get_node_base_interface();
    add_node_to_executor(node_id);
    response->full_node_name = node->get_fully_qualified_name();
    response->unique_id = node_id;
    response->success = true;
  } catch (const std::exception& error) {
    // Any exception fails only this component, not the container.
    RCLCPP_ERROR(get_logger(), "Cannot load component '%s' of package '%s': %s", request->plugin_name.c_str(),
                 request->package_name.c_str(), error.what());
    response->error_message = error.what();
    response->success = false;
  }
}

void ComponentManager::on_unload_node(const std::shared_ptr<rmw_request_id_t>,
                                      const std::shared_ptr<UnloadNode::Request> request,
                                      std::shared_ptr<UnloadNode::Response> response) {
  const auto wrapper = node_wrappers_.find(request->unique_id);
  if (wrapper == node_wrappers_.end()) {
    response->success = false;
    response->error_message = "No node found with unique_id: " + std::to_string(request->unique_id);
    RCLCPP_WARN(get_logger(), "%s", response->error_message.c_str());
    return;
  }
  remove_node_from_executor(request->unique_id);
  node_wrappers_.erase(wrapper);
  response->success = true;
}

void ComponentManager::on_list_nodes(const std::shared_ptr<rmw_request_id_t>, const std::shared_ptr<ListNodes::Request>,
                                     std::shared_ptr<ListNodes::Response> response) {
  for (const auto& [id, wrapper] : node_wrappers_) {
    response->unique_ids.push_back(id);
    response->full_node_names.emplace_back(wrapper.get_node_base_interface()->get_fully_qualified_name());
  }
}

}  // namespace rclcpp_components
