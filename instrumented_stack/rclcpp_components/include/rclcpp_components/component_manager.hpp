// SPDX-License-Identifier: Apache-2.0
// The node of a container. On request it loads components into this process, unloads them and lists them.
//
// Its services are ~/_container/load_node, unload_node and list_nodes of composition_interfaces. A component's node
// gets the process arguments of the container only if the request says forward_global_arguments. The remap rules and
// parameters of the request apply only to that node. Library paths come from the ament index, resource
// rclcpp_components of the package.
#pragma once

#include <composition_interfaces/srv/list_nodes.hpp>
#include <composition_interfaces/srv/load_node.hpp>
#include <composition_interfaces/srv/unload_node.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/executor.hpp"
#include "rclcpp/node_options.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/component_library.hpp"
#include "rclcpp_components/node_factory.hpp"
#include "rclcpp_components/node_instance_wrapper.hpp"

namespace rclcpp_components {

// The reason why a component was not loaded; what() is the error_message of the response.
class ComponentManagerException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ComponentManager : public rclcpp::Node {
 public:
  using LoadNode = composition_interfaces::srv::LoadNode;
  using UnloadNode = composition_interfaces::srv::UnloadNode;
  using ListNodes = composition_interfaces::srv::ListNodes;

  // Class name and absolute path of the library.
  using ComponentResource = std::pair<std::string, std::string>;

  // Components are added to `executor`. It may be set later, before the first request. The read-only parameter
  // thread_num is the number of threads of a multi-threaded executor. Default and maximum are the number of processors.
  explicit ComponentManager(std::weak_ptr<rclcpp::Executor> executor = std::weak_ptr<rclcpp::Executor>(),
                            std::string node_name = "ComponentManager",
                            const rclcpp::NodeOptions& node_options = rclcpp::NodeOptions()
                                                                          .start_parameter_services(false)
                                                                          .start_parameter_event_publisher(false));
  ~ComponentManager() override;

  // The components of a package. Throws ComponentManagerException if the package has none or its entry is malformed.
  virtual std::vector<ComponentResource> get_component_resources(
      const std::string& package_name, const std::string& resource_index = "rclcpp_components") const;

  // Null if the library has no such component. Throws ComponentManagerException if the library cannot be loaded.
  virtual std::shared_ptr<NodeFactory> create_component_factory(const ComponentResource& resource);

  virtual void set_executor(const std::weak_ptr<rclcpp::Executor> executor);

 protected:
  // The options for constructing a component. Throws ComponentManagerException for wrong values of extra arguments. A
  // derived class may have more extra arguments, which are none of this class.
  virtual rclcpp::NodeOptions create_node_options(const std::shared_ptr<LoadNode::Request> request);

  // Whether an extra argument that create_node_options() of this class does not know is refused: not in a class that a
  // program has derived.
  virtual bool knows_all_extra_arguments() const;

  // Called after a component was added to node_wrappers_, and before it is removed.
  virtual void add_node_to_executor(uint64_t node_id);
  virtual void remove_node_from_executor(uint64_t node_id);

  // The services. They never use an id twice.
  virtual void on_load_node(const std::shared_ptr<rmw_request_id_t> request_header,
                            const std::shared_ptr<LoadNode::Request> request,
                            std::shared_ptr<LoadNode::Response> response);
  virtual void on_unload_node(const std::shared_ptr<rmw_request_id_t> request_header,
                              const std::shared_ptr<UnloadNode::Request> request,
                              std::shared_ptr<UnloadNode::Response> response);
  virtual void on_list_nodes(const std::shared_ptr<rmw_request_id_t> request_header,
                             const std::shared_ptr<ListNodes::Request> request,
                             std::shared_ptr<ListNodes::Response> response);

  std::weak_ptr<rclcpp::Executor> executor_;
  uint64_t unique_id_ = 1;
  std::map<uint64_t, NodeInstanceWrapper> node_wrappers_;

 private:
  // Creates the component and adds it to node_wrappers_. Throws ComponentManagerException.
  uint64_t load_node(const std::shared_ptr<LoadNode::Request>& request);

  std::map<std::string, ComponentLibrary> libraries_;  // key: path
  rclcpp::Service<LoadNode>::SharedPtr load_node_srv_;
  rclcpp::Service<UnloadNode>::SharedPtr unload_node_srv_;
  rclcpp::Service<ListNodes>::SharedPtr list_nodes_srv_;
};

}  // namespace rclcpp_components
