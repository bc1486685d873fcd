// SPDX-License-Identifier: Apache-2.0
// Shared libraries with components.
//
// A library's components register themselves when it is loaded, be that by a container or because a program links it.
// Libraries are never unloaded: code addresses of a trace stay valid, and so do the objects that a component gave away.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rclcpp_components/node_factory.hpp"

namespace rclcpp_components {

class ComponentLibrary {
 public:
  // Loads the library at `path`, or finds it loaded. Throws std::runtime_error with the reason of the dynamic loader.
  explicit ComponentLibrary(const std::string& path);

  // Class names as they were registered, such as `composition::Talker`.
  std::vector<std::string> get_available_classes() const;

  // Null if the library has no such component.
  std::shared_ptr<NodeFactory> create_factory(const std::string& class_name) const;

 private:
  std::string name_;  // as the dynamic loader has it
};

// The factory of a component in whatever library of this process. Null if there is none.
std::shared_ptr<NodeFactory> create_component_factory(const std::string& class_name);

// What RCLCPP_COMPONENTS_REGISTER_NODE defines: an entry in the list of this process's components, as long as it lives.
class ComponentRegistration {
 public:
  using CreateFactory = std::shared_ptr<NodeFactory> (*)();

  ComponentRegistration(const char* class_name, CreateFactory create_factory);
  ~ComponentRegistration();
  ComponentRegistration(const ComponentRegistration&) = delete;
  ComponentRegistration& operator=(const ComponentRegistration&) = delete;

  const std::string class_name;
  const CreateFactory create_factory;
  const std::string library;  // the one that this object is in, as the dynamic loader has it
};

}  // namespace rclcpp_components
