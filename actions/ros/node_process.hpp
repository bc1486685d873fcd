// SPDX-License-Identifier: Apache-2.0
// The common part of <node>, <node_container> and <lifecycle_node>: a process that understands --ros-args.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actions/process/process_settings.hpp"
#include "actions/ros/parameters.hpp"

namespace launch {

class NodeProcess {
 public:
  // Declarations for an ActionType. With `named`, the attributes name and namespace are required.
  static std::vector<AttributeSpec> attributes(bool named);
  static std::vector<ItemSpec> items();

  explicit NodeProcess(const Fields& fields);

  // Asks the context to start the process. Returns the node's fully qualified name, or an empty text when the program
  // chooses a part of the name.
  std::string request(LaunchContext& context) const;

  // By which it may be assigned to a machine.
  AssignableProcess assignable(Scope& scope) const;

 private:
  std::string program(Scope& scope) const;
  std::optional<std::string> node_name(Scope& scope) const;

  Fields fields_;
  std::vector<Parameters> parameters_;
};

// The <remap> items of nodes and components.
ItemSpec remap_item();
// From and to of one of them.
std::pair<std::string, std::string> perform_remap(const Fields& remap, LaunchContext& context);

}  // namespace launch
