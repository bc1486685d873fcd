// SPDX-License-Identifier: Apache-2.0
// The plain tree that YAML text is read into, with the merge keys of YAML 1.1.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
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

// Replaces each entry `<<: MAPPING` by the entries of MAPPING. Keys of the mapping itself take precedence over merged
// keys. Earlier merged mappings take precedence over later ones. A key that is given twice is an error here, although
// yaml-cpp and PyYAML accept it.
void resolve_merge_keys(YamlNode& mapping, std::vector<Diagnostic>& errors);

}  // namespace launch
