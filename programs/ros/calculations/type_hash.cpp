// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/calculations/type_hash.hpp"

#include <fmt/format.h>
#include <rcutils/sha256.h>

#include <map>
#include <string_view>

namespace launch {

namespace {

// Numbers of type_description_interfaces/msg/FieldType.
constexpr int kNested = 1;
constexpr int kBoundedString = 21;
constexpr int kBoundedWstring = 22;
constexpr int kArray = 48;
constexpr int kBoundedSequence = 96;
constexpr int kUnboundedSequence = 144;
// What a message without fields has, because C has no structure without members.
constexpr const char* kOnlyMember = "structure_needs_at_least_one_member";

int number_of_kind(FieldKind kind) {
  switch (kind) {
    case FieldKind::kMessage:
      return kNested;
    case FieldKind::kInt8:
      return 2;
    case FieldKind::kUint8:
    case FieldKind::kChar:
      return 3;
    case FieldKind::kInt16:
      return 4;
    case FieldKind::kUint16:
      return 5;
    case FieldKind::kInt32:
      return 6;
    case FieldKind::kUint32:
      return 7;
    case FieldKind::kInt64:
      return 8;
    case FieldKind::kUint64:
      return 9;
    case FieldKind::kFloat32:
      return 10;
    case FieldKind::kFloat64:
      return 11;
    case FieldKind::kBool:
      return 15;
    case FieldKind::kByte:
      return 16;
    case FieldKind::kString:
      return 17;
    case FieldKind::kWstring:
      return 18;
  }
  return 0;
}

int number_of_type(const FieldType& type) {
  int number = number_of_kind(type.kind);
  if (type.string_bound > 0) {
    number = type.kind == FieldKind::kWstring ? kBoundedWstring : kBoundedString;
  }
  if (type.many == Many::kArray) {
    return number + kArray;
  }
  if (type.many == Many::kSequence) {
    return number + (type.count > 0 ? kBoundedSequence : kUnboundedSequence);
  }
  return number;
}

std::string field_text(std::string_view name, const FieldType& type) {
  return fmt::format(
      R"({{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": {}, "nested_type_name": "{}"}}}})",
      name, number_of_type(type), type.count, type.string_bound, type.message ? type.message->name : "");
}

// The text of a definition, whose separators are part of what the hash is defined by.
class Description {
 public:
  explicit Description(std::string name) : name_(std::move(name)) {}

  void add(std::string_view field, const FieldType& type) {
    fields_ += (fields_.empty() ? "" : ", ") + field_text(field, type);
  }
  void add_fields(const MessageType& message) {
    for (const MessageField& field : message.fields) {
      add(field.name, field.type);
    }
    if (message.fields.empty()) {
      add(kOnlyMember, {.kind = FieldKind::kUint8});
    }
  }
  std::string text() const { return fmt::format(R"({{"type_name": "{}", "fields": [{}]}})", name_, fields_); }

 private:
  std::string name_;
  std::string fields_;
};

using Referenced = std::map<std::string, std::string>;  // descriptions by name

void add_referenced(const MessageType& message, Referenced& found) {
  const auto [entry, is_new] = found.try_emplace(message.name);
  if (!is_new) {
    return;
  }
  Description description(message.name);
  description.add_fields(message);
  entry->second = description.text();
  for (const MessageField& field : message.fields) {
    if (field.type.message) {
      add_referenced(*field.type.message, found);
    }
  }
}

std::string hash_of(const Description& description, const Referenced& referenced) {
  std::string others;
  for (const auto& [name, text] : referenced) {
    others += (others.empty() ? "" : ", ") + text;
  }
  const std::string text =
      fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})", description.text(), others);
  rcutils_sha256_ctx_t context;
  rcutils_sha256_init(&context);
  rcutils_sha256_update(&context, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  std::uint8_t bytes[RCUTILS_SHA256_BLOCK_SIZE];
  rcutils_sha256_final(&context, bytes);
  std::string hash = "RIHS01_";
  for (const std::uint8_t byte : bytes) {
    hash += fmt::format("{:02x}", byte);
  }
  return hash;
}

}  // namespace

std::string type_hash(const MessageType& message) {
  Description description(message.name);
  description.add_fields(message);
  Referenced referenced;
  for (const MessageField& field : message.fields) {
    if (field.type.message) {
      add_referenced(*field.type.message, referenced);
    }
  }
  return hash_of(description, referenced);
}

std::string service_type_hash(const ServiceType& service, const MessageType& event) {
  Description description(service.name);
  Referenced referenced;
  const auto add = [&](const char* field, const MessageType& message) {
    const std::shared_ptr<const MessageType> unowned(std::shared_ptr<const void>(), &message);
    description.add(field, {.kind = FieldKind::kMessage, .message = unowned});
    add_referenced(message, referenced);
  };
  add("request_message", *service.request);
  add("response_message", *service.response);
  add("event_message", event);
  return hash_of(description, referenced);
}

}  // namespace launch
