// SPDX-License-Identifier: Apache-2.0
// Shared libraries with components.
//
// A library's components register themselves when a container loads it, or when a program links it. Libraries are never
// unloaded. So code addresses in a trace stay valid, and so do objects that a component gave away.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rclcpp_components/node_factory.hpp"

namespace rclcpp_components {

class ComponentLibrary {
 public:
  // Loads the library at `path`, unless it is loaded already. Throws std::runtime_error with the reason of the dynamic
  // loader.
  explicit ComponentLibrary(const std::string& path);

  // The registered class names, such as `composition::Talker`.
  std::vector<std::string> get_available_classes() const;

  // Null if the library has no such component.
  std::shared_ptr<NodeFactory> create_factory(const std::string& class_name) const;

 private:
  std::string name_;  // as in the dynamic loader
};

// The factory of a component in any library of this process. Null if there is none.
std::shared_ptr<NodeFactory> create_component_factory(const std::string& class_name);

// RCLCPP_COMPONENTS_REGISTER_NODE defines one. While it lives, the component is in the list of this process.
class ComponentRegistration {
 public:
  using CreateFactory = std::shared_ptr<NodeFactory> (*)();

  ComponentRegistration(const char* class_name, CreateFactory create_factory);
  ~ComponentRegistration();
  ComponentRegistration(const ComponentRegistration&) = delete;
  ComponentRegistration& operator=(const ComponentRegistration&) = delete;

  const std::string class_name;
  const CreateFactory create_factory;
  const std::string library;  // the library that contains this object, as in the dynamic loader
};

}  // namespace rclcpp_components
