// SPDX-License-Identifier: Apache-2.0
// The definition of a message as its interface file has it, and a value of a message. Nothing here knows the middleware
// or generated code: all interfaces that are installed can be handled alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace launch {

// A value of any field. Integers of 64 bits without sign are uint64_t, all others int64_t; strings are UTF-8, also of
// `wstring`. A list holds the elements of an array, or the members of a message in the order of its fields.
struct MessageValue {
  using List = std::vector<MessageValue>;
  std::variant<std::int64_t, std::uint64_t, bool, double, std::string, List> data;

  const List& list() const { return std::get<List>(data); }
  List& list() { return std::get<List>(data); }
};

bool operator==(const MessageValue& left, const MessageValue& right);

enum class FieldKind : std::uint8_t {
  kBool,
  kByte,
  kChar,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kString,
  kWstring,
  kMessage
};

// "uint8"; "" for a message.
std::string_view name_of(FieldKind kind);
std::optional<FieldKind> primitive_kind(std::string_view name);
bool is_integer(FieldKind kind);  // byte and char, too

struct MessageType;

enum class Many : std::uint8_t { kOne, kArray, kSequence };

struct FieldType {
  FieldKind kind = FieldKind::kInt64;
  std::shared_ptr<const MessageType> message = nullptr;  // of kMessage
  Many many = Many::kOne;
  std::size_t count = 0;         // of an array; the bound of a sequence, 0: none
  std::size_t string_bound = 0;  // most characters of a string; 0: no bound

  FieldType element() const { return {kind, message, Many::kOne, 0, string_bound}; }
};

// "float64[9]", "string<=8[<=3]", "std_msgs/Header", as an interface file has it.
std::string to_string(const FieldType& type);

struct MessageField {
  std::string name;
  FieldType type;
  MessageValue default_value;  // zero, "" or empty if the file gives none
};

struct MessageConstant {
  std::string name;
  FieldType type;
  MessageValue value;
};

struct MessageType {
  std::string name;                  // "std_msgs/msg/Header", "example_interfaces/srv/AddTwoInts_Request"
  std::vector<MessageField> fields;  // without the member that stands for a message without fields
  std::vector<MessageConstant> constants;

  // Null if there is none.
  const MessageField* find(std::string_view field) const;
  std::vector<std::string> field_names() const;
};

struct ServiceType {
  std::string name;
  std::shared_ptr<const MessageType> request;
  std::shared_ptr<const MessageType> response;
};

MessageValue default_value(const MessageType& type);
MessageValue default_value(const FieldType& type);

}  // namespace launch
