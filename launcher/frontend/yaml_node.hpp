// SPDX-License-Identifier: Apache-2.0
// The plain tree that YAML text is read into.
#pragma once

#include <string>
#include <vector>

#include "launcher/base/source.hpp"
#include "launcher/frontend/entity.hpp"

namespace launch {

struct YamlEntry;

struct YamlNode {
  enum class Kind { kScalar, kSequence, kMapping };

  Kind kind = Kind::kScalar;
  Scalar scalar;                   // of a kScalar
  std::vector<YamlNode> items;     // of a kSequence
  std::vector<YamlEntry> entries;  // of a kMapping, keys are unique
  SourceRange where;               // a scalar's text; the first character of a sequence or mapping
  bool is_plain = false;           // a scalar without quotes or tag

  bool is_null() const { return kind == Kind::kScalar && scalar.type == Scalar::Type::kNull; }
};

struct YamlEntry {
  YamlNode key;
  YamlNode value;
};

// "a list", "a mapping", "str 'text'", "null": what a message calls the node.
std::string describe(const YamlNode& node);

}  // namespace launch
