// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/parameter_text.hpp"

#include <fmt/format.h>

#include <optional>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/message_types/print_value.hpp"
#include "launcher/message_types/yaml_text.hpp"

namespace launch {

namespace {

// The number of the type as a single value in rcl_interfaces/msg/ParameterType; that of a list is five more.
enum class Single { kBool = 1, kInteger = 2, kDouble = 3, kString = 4 };
constexpr int kListOffset = 5;
constexpr const char* kNames[] = {"", "bool", "integer", "double", "string"};

std::optional<Single> type_of(const Value& value) {
  const Scalar* const scalar = value.scalar();
  if (scalar == nullptr) {
    return std::nullopt;
  }
  switch (scalar->type) {
    case Scalar::Type::kBool:
      return Single::kBool;
    case Scalar::Type::kInt:
      return Single::kInteger;
    case Scalar::Type::kFloat:
      return Single::kDouble;
    case Scalar::Type::kString:
      return Single::kString;
    default:
      return std::nullopt;
  }
}

std::string yaml_of(const Scalar& scalar, Single type) {
  switch (type) {
    case Single::kBool:
      return scalar.bool_value ? "true" : "false";
    case Single::kInteger:
      return fmt::to_string(scalar.int_value);
    case Single::kDouble:
      return to_yaml({FieldKind::kFloat64}, {scalar.float_value});
    case Single::kString:
      break;
  }
  return yaml_text(scalar.text.text(), true);
}

std::string as_text(const std::string& text) {
  return fmt::format("{{type: 4, string_value: {}}}", yaml_text(text, true));
}

}  // namespace

std::string yaml_list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) {
    list += (list.empty() ? "" : ", ") + yaml_text(text, true);
  }
  return "[" + list + "]";
}

std::string parameter_value_yaml(const std::string& text) {
  Value value;
  try {
    value = yaml11_value(LocatedText(text));
  } catch (const LaunchError&) {
    return as_text(text);
  }
  if (const std::vector<Value>* const list = value.list()) {
    const Single type = list->empty() ? Single::kBool : type_of(list->front()).value_or(Single::kString);
    std::string items;
    for (const Value& item : *list) {
      if (type_of(item) != type) {
        return as_text(text);
      }
      items += (items.empty() ? "" : ", ") + yaml_of(*item.scalar(), type);
    }
    return fmt::format("{{type: {}, {}_array_value: [{}]}}", static_cast<int>(type) + kListOffset,
                       kNames[static_cast<int>(type)], items);
  }
  const std::optional<Single> type = type_of(value);
  if (!type) {
    return as_text(text);
  }
  return fmt::format("{{type: {}, {}_value: {}}}", static_cast<int>(*type), kNames[static_cast<int>(*type)],
                     yaml_of(*value.scalar(), *type));
}

}  // namespace launch
