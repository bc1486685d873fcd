// SPDX-License-Identifier: Apache-2.0
// A YAML tree as text, with the place of each node: equal texts are equal trees.
#pragma once

#include <fmt/format.h>

#include <string>

#include "launcher/frontend/yaml_document.hpp"

namespace test_support {

inline std::string place(const launch::SourceRange& where) {
  return fmt::format("@{}-{}", where.begin, where.end);
}

inline std::string tree_text(const launch::YamlNode& node) {
  std::string text = place(node.where);
  switch (node.kind) {
    case launch::YamlNode::Kind::kScalar: {
      const launch::LocatedText& scalar = node.scalar.text;
      text += fmt::format("{}{}'{}'", static_cast<int>(node.scalar.type), node.is_plain ? "p" : "", scalar.text());
      for (std::size_t i = 0; i < scalar.text().size(); ++i) {
        text += place(scalar.range(i, 1));
      }
      return text;
    }
    case launch::YamlNode::Kind::kSequence:
      text += "[";
      for (const launch::YamlNode& item : node.items) {
        text += tree_text(item) + ",";
      }
      return text + "]";
    case launch::YamlNode::Kind::kMapping:
      text += "{";
      for (const launch::YamlEntry& entry : node.entries) {
        text += tree_text(entry.key) + ":" + tree_text(entry.value) + ",";
      }
      return text + "}";
  }
  return text;
}

}  // namespace test_support
