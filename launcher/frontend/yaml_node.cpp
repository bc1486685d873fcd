// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/yaml_node.hpp"

#include <fmt/format.h>

namespace launch {

std::string describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kSequence:
      return "a list";
    case YamlNode::Kind::kMapping:
      return "a mapping";
    case YamlNode::Kind::kScalar:
      break;
  }
  if (node.is_null()) {
    return "nothing";
  }
  return fmt::format("{} '{}'", type_name(node.scalar.type), node.scalar.text.text());
}

}  // namespace launch
