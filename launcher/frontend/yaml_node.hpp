// SPDX-License-Identifier: Apache-2.0
// The plain tree that YAML text is read into.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/frontend/entity.hpp"

namespace launch {

struct YamlEntry;

struct YamlNode {
  enum class Kind { kScalar, kSequence, kMapping };

  Kind kind = Kind::kScalar;
  Scalar scalar;                   // of kScalar
  std::vector<YamlNode> items;     // of kSequence
  std::vector<YamlEntry> entries;  // of kMapping, with unique keys
  SourceRange where;               // the text of a scalar, or the first character of a sequence or mapping
  bool is_plain = false;           // a scalar without quotes or tag

  bool is_null() const { return kind == Kind::kScalar && scalar.type == Scalar::Type::kNull; }
};

struct YamlEntry {
  YamlNode key;
  YamlNode value;
};

// The name of the node in messages: "a list", "a mapping", "str 'text'", "nothing".
std::string describe(const YamlNode& node);

}  // namespace launch
