// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/entity.hpp"

#include <algorithm>

namespace launch {

const Attribute* Entity::find(std::string_view name) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const Attribute& attribute) { return attribute.name == name; });
  return found == attributes.end() ? nullptr : &*found;
}

std::string_view type_name(Scalar::Type type) {
  switch (type) {
    case Scalar::Type::kUntyped:
    case Scalar::Type::kString:
      return "str";
    case Scalar::Type::kBool:
      return "bool";
    case Scalar::Type::kInt:
      return "int";
    case Scalar::Type::kFloat:
      return "float";
    case Scalar::Type::kNull:
      return "null";
    case Scalar::Type::kOther:
      return "date";
  }
  return "str";
}

}  // namespace launch
