// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/interface_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace launch {

namespace {

constexpr std::array<std::string_view, 15> kNames = {"bool",   "byte",    "char",    "int8",   "uint8",
                                                     "int16",  "uint16",  "int32",   "uint32", "int64",
                                                     "uint64", "float32", "float64", "string", "wstring"};

MessageValue zero(const FieldType& type) {
  switch (type.kind) {
    case FieldKind::kBool:
      return {false};
    case FieldKind::kUint64:
      return {std::uint64_t{0}};
    case FieldKind::kFloat32:
    case FieldKind::kFloat64:
      return {0.0};
    case FieldKind::kString:
    case FieldKind::kWstring:
      return {std::string()};
    case FieldKind::kMessage:
      return default_value(*type.message);
    default:
      return {std::int64_t{0}};
  }
}

}  // namespace

bool operator==(const MessageValue& left, const MessageValue& right) {
  return left.data == right.data;
}

std::string_view name_of(FieldKind kind) {
  return kind == FieldKind::kMessage ? std::string_view() : kNames[static_cast<std::size_t>(kind)];
}

std::optional<FieldKind> primitive_kind(std::string_view name) {
  const auto* const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    return std::nullopt;
  }
  return static_cast<FieldKind>(found - kNames.begin());
}

bool is_integer(FieldKind kind) {
  return kind >= FieldKind::kByte && kind <= FieldKind::kUint64;
}

std::string to_string(const FieldType& type) {
  std::string text;
  if (type.kind == FieldKind::kMessage) {
    const std::string& name = type.message->name;
    const std::size_t msg = name.find("/msg/");
    text = msg == std::string::npos ? name : name.substr(0, msg) + name.substr(msg + 4);
  } else {
    text = name_of(type.kind);
  }
  if (type.string_bound != 0) {
    text += fmt::format("<={}", type.string_bound);
  }
  if (type.many == Many::kArray) {
    text += fmt::format("[{}]", type.count);
  } else if (type.many == Many::kSequence) {
    text += type.count == 0 ? "[]" : fmt::format("[<={}]", type.count);
  }
  return text;
}

const MessageField* MessageType::find(std::string_view field) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& each) { return each.name == field; });
  return found == fields.end() ? nullptr : &*found;
}

std::vector<std::string> MessageType::field_names() const {
  std::vector<std::string> names;
  for (const MessageField& field : fields) {
    names.push_back(field.name);
  }
  return names;
}

MessageValue default_value(const MessageType& type) {
  MessageValue::List members;
  for (const MessageField& field : type.fields) {
    members.push_back(field.default_value);
  }
  return {std::move(members)};
}

MessageValue default_value(const FieldType& type) {
  if (type.many == Many::kOne) {
    return zero(type);
  }
  return {MessageValue::List(type.many == Many::kArray ? type.count : 0, zero(type))};
}

}  // namespace launch
