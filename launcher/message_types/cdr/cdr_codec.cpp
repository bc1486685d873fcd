// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/cdr/cdr_codec.hpp"

#include <fastcdr/exceptions/Exception.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fastcdr_versions/cdr.hpp"
#include "launcher/message_types/utf16.hpp"

namespace launch {

namespace {

using eprosima::fastcdr::Cdr;

constexpr std::size_t kHeaderSize = 4;

// Calls `use` with an example of the C++ type that a number has in the bytes.
template <typename Use>
auto with_number_type(FieldKind kind, const Use& use) {
  switch (kind) {
    case FieldKind::kInt8:
      return use(std::int8_t{});
    case FieldKind::kInt16:
      return use(std::int16_t{});
    case FieldKind::kUint16:
      return use(std::uint16_t{});
    case FieldKind::kInt32:
      return use(std::int32_t{});
    case FieldKind::kUint32:
      return use(std::uint32_t{});
    case FieldKind::kInt64:
      return use(std::int64_t{});
    case FieldKind::kUint64:
      return use(std::uint64_t{});
    case FieldKind::kFloat32:
      return use(float{});
    case FieldKind::kFloat64:
      return use(double{});
    default:
      return use(std::uint8_t{});
  }
}

std::size_t size_of(FieldKind kind) {
  return with_number_type(kind, [](auto example) { return sizeof(example); });
}

bool is_text(FieldKind kind) {
  return kind == FieldKind::kString || kind == FieldKind::kWstring;
}

// The least number of bytes of one element, without those for alignment.
std::size_t least_size(const FieldType& type) {
  if (type.kind != FieldKind::kMessage) {
    return is_text(type.kind) ? sizeof(std::uint32_t) : size_of(type.kind);
  }
  std::size_t sum = type.message->fields.empty() ? 1 : 0;
  for (const MessageField& field : type.message->fields) {
    sum += field.type.many == Many::kSequence ? sizeof(std::uint32_t)
                                              : least_size(field.type) * std::max<std::size_t>(field.type.count, 1);
  }
  return sum;
}

class Writer {
 public:
  explicit Writer(Cdr& cdr) : cdr_(cdr) {}

  void message(const MessageType& type, const MessageValue& value) {
    if (type.fields.empty()) {
      cdr_.serialize(std::uint8_t{0});  // ROS 2 gives such a message a member
    }
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      field(type.fields[i].type, value.list()[i]);
    }
  }

 private:
  void field(const FieldType& type, const MessageValue& value) {
    if (type.many == Many::kOne) {
      single(type, value);
      return;
    }
    if (type.many == Many::kSequence) {
      cdr_.serialize(static_cast<std::uint32_t>(value.list().size()));
    }
    for (const MessageValue& element : value.list()) {
      single(type, element);
    }
  }

  void single(const FieldType& type, const MessageValue& value) {
    switch (type.kind) {
      case FieldKind::kMessage:
        message(*type.message, value);
        return;
      case FieldKind::kBool:
        cdr_.serialize(std::get<bool>(value.data));
        return;
      case FieldKind::kString: {
        const auto& text = std::get<std::string>(value.data);
        cdr_.serialize(static_cast<std::uint32_t>(text.size() + 1));
        fastcdr_versions::write_array(cdr_, text.c_str(), text.size() + 1);
        return;
      }
      case FieldKind::kWstring: {
        const std::u16string text = to_utf16(std::get<std::string>(value.data));
        cdr_.serialize(static_cast<std::uint32_t>(text.size()));
        for (const char16_t unit : text) {
          cdr_.serialize(static_cast<std::uint32_t>(unit));
        }
        return;
      }
      default:
        break;
    }
    with_number_type(type.kind, [&](auto example) {
      using Number = decltype(example);
      if constexpr (std::is_floating_point_v<Number>) {
        cdr_.serialize(static_cast<Number>(std::get<double>(value.data)));
      } else if constexpr (std::is_same_v<Number, std::uint64_t>) {
        cdr_.serialize(std::get<std::uint64_t>(value.data));
      } else {
        cdr_.serialize(static_cast<Number>(std::get<std::int64_t>(value.data)));
      }
    });
  }

  Cdr& cdr_;
};

class Reader {
 public:
  explicit Reader(Cdr& cdr) : cdr_(cdr) {}

  MessageValue message(const MessageType& type) {
    if (type.fields.empty()) {
      std::uint8_t placeholder = 0;
      cdr_.deserialize(placeholder);
    }
    MessageValue::List members;
    members.reserve(type.fields.size());
    for (const MessageField& each : type.fields) {
      members.push_back(field(each.type));
    }
    return {std::move(members)};
  }

 private:
  MessageValue field(const FieldType& type) {
    if (type.many == Many::kOne) {
      return single(type);
    }
    const std::size_t count = type.many == Many::kArray ? type.count : length(least_size(type));
    MessageValue::List list;
    list.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      list.push_back(single(type));
    }
    return {std::move(list)};
  }

  // Checks a length against the remaining bytes, before memory is allocated for it.
  std::size_t length(std::size_t least_element_size) {
    std::uint32_t count = 0;
    cdr_.deserialize(count);
    if (!fastcdr_versions::has_left(cdr_, count * least_element_size)) {
      throw std::length_error("a length in the message goes beyond the message");
    }
    return count;
  }

  MessageValue single(const FieldType& type) {
    switch (type.kind) {
      case FieldKind::kMessage:
        return message(*type.message);
      case FieldKind::kBool: {
        bool value = false;
        cdr_.deserialize(value);
        return {value};
      }
      case FieldKind::kString: {
        std::string text(length(1), '\0');
        if (!text.empty()) {
          fastcdr_versions::read_array(cdr_, text.data(), text.size());
          if (text.back() == '\0') {  // some writers do not count the final NUL
            text.pop_back();
          }
        }
        return {std::move(text)};
      }
      case FieldKind::kWstring: {
        std::u16string text(length(sizeof(std::uint32_t)), u'\0');
        for (char16_t& unit : text) {
          std::uint32_t character = 0;
          cdr_.deserialize(character);
          unit = static_cast<char16_t>(character);
        }
        return {to_utf8(text)};
      }
      default:
        break;
    }
    return with_number_type(type.kind, [&](auto number) -> MessageValue {
      using Number = decltype(number);
      cdr_.deserialize(number);
      if constexpr (std::is_floating_point_v<Number>) {
        return {static_cast<double>(number)};
      } else if constexpr (std::is_same_v<Number, std::uint64_t>) {
        return {number};
      } else {
        return {static_cast<std::int64_t>(number)};
      }
    });
  }

  Cdr& cdr_;
};

std::size_t aligned(std::size_t position, std::size_t alignment) {
  return (position + alignment - 1) / alignment * alignment;
}

std::size_t end_of_message(const MessageType& type, const MessageValue& value, std::size_t at);

std::size_t end_of_single(const FieldType& type, const MessageValue& value, std::size_t at) {
  switch (type.kind) {
    case FieldKind::kMessage:
      return end_of_message(*type.message, value, at);
    case FieldKind::kBool:
      return at + 1;
    case FieldKind::kString:
      return aligned(at, 4) + 4 + std::get<std::string>(value.data).size() + 1;
    case FieldKind::kWstring:
      return aligned(at, 4) + 4 + 4 * to_utf16(std::get<std::string>(value.data)).size();
    default:
      return aligned(at, size_of(type.kind)) + size_of(type.kind);
  }
}

std::size_t end_of_message(const MessageType& type, const MessageValue& value, std::size_t at) {
  if (type.fields.empty()) {
    return at + 1;
  }
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    const FieldType& field = type.fields[i].type;
    const MessageValue& member = value.list()[i];
    if (field.many == Many::kOne) {
      at = end_of_single(field, member, at);
      continue;
    }
    at = field.many == Many::kSequence ? aligned(at, 4) + 4 : at;
    for (const MessageValue& element : member.list()) {
      at = end_of_single(field, element, at);
    }
  }
  return at;
}

}  // namespace

void write_cdr(const MessageType& type, const MessageValue& value, Cdr& cdr) {
  Writer(cdr).message(type, value);
}

MessageValue read_cdr(const MessageType& type, Cdr& cdr) {
  return Reader(cdr).message(type);
}

std::size_t cdr_size(const MessageType& type, const MessageValue& value) {
  return end_of_message(type, value, 0);
}

std::vector<std::uint8_t> to_cdr(const MessageType& type, const MessageValue& value) {
  std::vector<std::uint8_t> bytes(kHeaderSize + cdr_size(type, value));
  eprosima::fastcdr::FastBuffer memory(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr = fastcdr_versions::plain_cdr(memory);
  cdr.serialize_encapsulation();
  write_cdr(type, value, cdr);
  return bytes;
}

MessageValue from_cdr(const MessageType& type, const std::uint8_t* bytes, std::size_t size) try {
  // Fast CDR has one buffer type for both directions. Reading does not write to it.
  eprosima::fastcdr::FastBuffer memory(const_cast<char*>(reinterpret_cast<const char*>(bytes)), size);
  Cdr cdr = fastcdr_versions::plain_cdr(memory);
  cdr.read_encapsulation();
  return read_cdr(type, cdr);
} catch (const eprosima::fastcdr::exception::Exception& error) {
  throw std::runtime_error("the bytes are no message " + type.name + ": " + error.what());
} catch (const std::length_error& error) {
  throw std::runtime_error("the bytes are no message " + type.name + ": " + error.what());
}

}  // namespace launch
