// SPDX-License-Identifier: Apache-2.0
// The tree that XML and YAML launch files are read into. It does not depend on the format: the XML and the YAML form of
// one launch file give equal trees.
//
// Entities are plain data. The actions declare what a tag or an attribute means (launcher/language/registry.hpp), and
// check the tree against their declaration.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

class Action;
class Template;

// One scalar. Scalars of XML are always kUntyped. Scalars of YAML have the types of YAML 1.1 as PyYAML's safe loader
// resolves them.
struct Scalar {
  enum class Type { kUntyped, kString, kBool, kInt, kFloat, kNull, kOther /* a date, for instance */ };

  Type type = Type::kUntyped;
  LocatedText text;  // as written in the file, also for typed scalars
  bool bool_value = false;
  std::int64_t int_value = 0;
  double float_value = 0.0;
  // Only Python launch files set this: the substitutions of the value. `text` only describes them.
  std::shared_ptr<const Template> made;
};

// The value of an attribute: a scalar, or (YAML only) a list, possibly nested.
struct Value {
  std::variant<Scalar, std::vector<Value>> data;
  SourceRange where;

  const Scalar* scalar() const { return std::get_if<Scalar>(&data); }
  const std::vector<Value>* list() const { return std::get_if<std::vector<Value>>(&data); }
};

struct Attribute {
  std::string name;
  SourceRange name_where;
  Value value;
};

// One element: an action (`node`) or a structured item of an action (`param`).
struct Entity {
  std::string type_name;
  SourceRange where;  // the tag name
  std::vector<Attribute> attributes;
  // Sub-actions and structured items in document order. In YAML, a key whose value is a list of mappings gives one
  // child for each item, and the children have the name of the key. The key `children`, or a list as the value of the
  // action, gives the sub-actions.
  std::vector<Entity> children;
  // True if the file has a place for sub-actions, even an empty one. Always true in XML.
  bool has_children_list = true;
  // True for an item of a YAML list under a key, as in `param: [{...}]`. Always false in XML, which does not tell.
  bool is_structured_item = false;
  // Only Python launch files set this: an action that no tag can express. The other members are empty then.
  std::shared_ptr<const Action> made;

  const Attribute* find(std::string_view name) const;
};

// The name of a type in messages: "str", "int", "bool", "float", "null", "date".
std::string_view type_name(Scalar::Type type);

}  // namespace launch
