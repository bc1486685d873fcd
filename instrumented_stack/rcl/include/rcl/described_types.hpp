// SPDX-License-Identifier: Apache-2.0
// What the service ~/get_type_description of a node tells of a type.
#pragma once

#include <string>
#include <vector>

#include "rcl/node.h"
#include "rosidl_runtime_c/type_description.h"

namespace rcl {

struct DescribedTypes {
  // The type, then the types within it, sorted by name. Empty if the node does not know the type.
  std::vector<const rosidl_type_description_t*> types{};
  // Why it is empty.
  const char* failure_reason = "";
};

// Looks for a type that the node uses by its hash, "RIHS01_…". Any thread.
DescribedTypes describe_type(const rcl_node_t* node, const std::string& type_hash);

}  // namespace rcl
