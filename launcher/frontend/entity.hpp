// SPDX-License-Identifier: Apache-2.0
// The neutral tree that XML and YAML launch files are read into.
//
// Entities are plain data: what a tag or an attribute means is declared by the actions
// (launcher/language/registry.hpp), which check the tree against their declaration. The XML and the YAML form of one
// launch file give equal trees.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "launcher/base/source.hpp"

namespace launch {

class Action;
class Template;

// One scalar. XML gives only kUntyped; YAML gives the types of YAML 1.1 as PyYAML's safe loader resolves them.
struct Scalar {
  enum class Type { kUntyped, kString, kBool, kInt, kFloat, kNull, kOther /* a date, for instance */ };

  Type type = Type::kUntyped;
  LocatedText text;  // for typed scalars the text as written
  bool bool_value = false;
  std::int64_t int_value = 0;
  double float_value = 0.0;
  // Given by Python launch files alone: the substitutions that a template would have been parsed to. `text` only
  // describes them.
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
  // child per item, named after the key; the key `children` (or a list as the action's value) gives the sub-actions.
  std::vector<Entity> children;
  // True when the file had a place for sub-actions, even an empty one. Always true in XML.
  bool has_children_list = true;
  // True for an item of a YAML list that is named by its key, as `param: [{...}]`. XML does not tell: always false.
  bool is_structured_item = false;
  // Given by Python launch files alone: an action that no tag can say. The rest is empty then.
  std::shared_ptr<const Action> made;

  const Attribute* find(std::string_view name) const;
};

// Human-readable name of a scalar's type as the messages use it: "str", "int", "bool", "float", "null", "date".
std::string_view type_name(Scalar::Type type);

}  // namespace launch
