// SPDX-License-Identifier: Apache-2.0
#include "message_layout.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_description_interfaces/msg/field_type.hpp>
#include <unique_identifier_msgs/msg/uuid.hpp>
#include <vector>

namespace rclcpp_action {
namespace {

using type_description_interfaces::msg::FieldType;

// An array of a type has the number of the type and this, sequences two and three times this.
constexpr std::uint8_t kArrays = FieldType::FIELD_TYPE_NESTED_TYPE_ARRAY - FieldType::FIELD_TYPE_NESTED_TYPE;

std::size_t alignment_of(const rosidl_type_description_t& type);

// Of one value.
std::size_t alignment_of_value(std::uint8_t type_id, const rosidl_field_description_t& field) {
  switch (type_id) {
    case FieldType::FIELD_TYPE_NESTED_TYPE:
      return field.nested_type == nullptr ? 1 : alignment_of(*field.nested_type);
    case FieldType::FIELD_TYPE_INT16:
    case FieldType::FIELD_TYPE_UINT16:
    case FieldType::FIELD_TYPE_WCHAR:
      return alignof(std::int16_t);
    case FieldType::FIELD_TYPE_INT32:
    case FieldType::FIELD_TYPE_UINT32:
      return alignof(std::int32_t);
    case FieldType::FIELD_TYPE_FLOAT:
      return alignof(float);
    case FieldType::FIELD_TYPE_INT64:
    case FieldType::FIELD_TYPE_UINT64:
      return alignof(std::int64_t);
    case FieldType::FIELD_TYPE_DOUBLE:
      return alignof(double);
    case FieldType::FIELD_TYPE_LONG_DOUBLE:
      return alignof(long double);
    case FieldType::FIELD_TYPE_STRING:
    case FieldType::FIELD_TYPE_WSTRING:
    case FieldType::FIELD_TYPE_FIXED_STRING:
    case FieldType::FIELD_TYPE_FIXED_WSTRING:
    case FieldType::FIELD_TYPE_BOUNDED_STRING:
    case FieldType::FIELD_TYPE_BOUNDED_WSTRING:
      return alignof(std::string);
    default:
      return 1;
  }
}

std::size_t alignment_of(const rosidl_field_description_t& field) {
  const int form = (field.type_id - FieldType::FIELD_TYPE_NESTED_TYPE) / kArrays;
  if (form > 1) {
    return alignof(std::vector<std::uint8_t>);
  }
  return alignment_of_value(static_cast<std::uint8_t>(field.type_id - form * kArrays), field);
}

std::size_t alignment_of(const rosidl_type_description_t& type) {
  std::size_t alignment = 1;
  for (std::size_t i = 0; i < type.field_count; ++i) {
    alignment = std::max(alignment, alignment_of(type.fields[i]));
  }
  return alignment;
}

}  // namespace

std::size_t offset_of(ActionPart part, const rosidl_action_type_support_t& action) {
  const std::string_view name = part == ActionPart::kGoal     ? "goal"
                                : part == ActionPart::kResult ? "result"
                                                              : "feedback";
  // Before a result there is the status of its goal, before the others the identity of the goal.
  const std::size_t before =
      part == ActionPart::kResult ? sizeof(std::int8_t) : sizeof(unique_identifier_msgs::msg::UUID);
  for (std::size_t i = 0; action.description != nullptr && i < action.description->field_count; ++i) {
    const rosidl_field_description_t& field = action.description->fields[i];
    if (field.name == name) {
      const std::size_t alignment = alignment_of(field);
      return (before + alignment - 1) / alignment * alignment;
    }
  }
  throw std::runtime_error("the type support of the action does not describe its " + std::string(name));
}

}  // namespace rclcpp_action
