// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/print_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/text/utf8.hpp"
#include "launcher/message_types/yaml_text.hpp"

namespace launch {

namespace {

std::size_t length_of(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) {
    text.remove_prefix(decode_utf8(text).size);
  }
  return count;
}

std::string_view first_characters(std::string_view text, std::size_t count) {
  std::size_t size = 0;
  for (; count > 0 && size < text.size(); --count) {
    size += decode_utf8(text.substr(size)).size;
  }
  return text.substr(0, size);
}

std::string array_summary(const FieldType& type, std::size_t length) {
  std::string element = type.kind == FieldKind::kMessage ? type.message->name : std::string(name_of(type.kind));
  if (type.kind == FieldKind::kFloat32 || type.kind == FieldKind::kFloat64) {
    element = type.kind == FieldKind::kFloat32 ? "float" : "double";
  } else if (type.kind == FieldKind::kBool) {
    element = "boolean";
  } else if (type.kind == FieldKind::kByte) {
    element = "octet";
  } else if (type.kind == FieldKind::kChar) {
    element = "uint8";
  }
  if (type.many == Many::kArray) {
    return fmt::format("<array type: {}[{}]>", element, type.count);
  }
  return type.count == 0 ? fmt::format("<sequence type: {}, length: {}>", element, length)
                         : fmt::format("<sequence type: {}[{}], length: {}>", element, type.count, length);
}

bool is_text(FieldKind kind) {
  return kind == FieldKind::kString || kind == FieldKind::kWstring;
}

// A byte is a character of this number.
std::string byte_text(const MessageValue& value) {
  std::string text;
  append_utf8(text, static_cast<char32_t>(std::get<std::int64_t>(value.data) & 0xFF));
  return text;
}

std::string shown_text(const std::string& text, const PrintStyle& style) {
  if (style.no_strings) {
    return fmt::format("<string length: <{}>>", length_of(text));
  }
  if (style.truncate < text.size() && length_of(text) > style.truncate) {
    return std::string(first_characters(text, style.truncate)) + "...";
  }
  return text;
}

std::string yaml_float(double value) {
  if (std::isnan(value)) {
    return ".nan";
  }
  if (std::isinf(value)) {
    return value > 0 ? ".inf" : "-.inf";
  }
  std::string text = python_float(value);
  // A number without a point is a text in YAML 1.1.
  if (const std::size_t exponent = text.find('e');
      exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");
  }
  return text;
}

std::string yaml_scalar(const FieldType& type, const MessageValue& value, const PrintStyle& style, bool in_flow) {
  if (is_text(type.kind)) {
    return yaml_text(shown_text(std::get<std::string>(value.data), style), in_flow);
  }
  switch (type.kind) {
    case FieldKind::kBool:
      return std::get<bool>(value.data) ? "true" : "false";
    case FieldKind::kByte:
      return yaml_text(byte_text(value), in_flow);
    case FieldKind::kFloat32:
    case FieldKind::kFloat64:
      return yaml_float(std::get<double>(value.data));
    case FieldKind::kUint64:
      return fmt::to_string(std::get<std::uint64_t>(value.data));
    default:
      return fmt::to_string(std::get<std::int64_t>(value.data));
  }
}

class BlockWriter {
 public:
  explicit BlockWriter(const PrintStyle& style) : style_(style) {}

  // Writes what stands behind "name:" or, without a name, a whole document.
  void value(const FieldType& type, const MessageValue& value, std::size_t indent, bool after_dash) {
    if (type.many != Many::kOne) {
      list(type, value, indent);
    } else if (type.kind == FieldKind::kMessage) {
      message(*type.message, value, indent, after_dash);
    } else {
      out += yaml_scalar(type, value, style_, false) + "\n";
    }
  }

  std::string out;

 private:
  void message(const MessageType& type, const MessageValue& value, std::size_t indent, bool after_dash) {
    if (type.fields.empty()) {
      // ROS 2 gives such a message this member.
      out += after_dash ? "" : std::string(indent, ' ');
      out += "structure_needs_at_least_one_member: 0\n";
      return;
    }
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      const MessageField& field = type.fields[i];
      out += (i == 0 && after_dash ? "" : std::string(indent, ' ')) + yaml_text(field.name, false) + ":";
      member(field.type, value.list()[i], indent);
    }
  }

  void member(const FieldType& type, const MessageValue& value, std::size_t indent) {
    if (type.many != Many::kOne) {
      if (style_.no_arrays) {
        out += " " + yaml_text(array_summary(type, value.list().size()), false) + "\n";
      } else if (value.list().empty()) {
        out += " []\n";
      } else {
        out += "\n";
        list(type, value, indent);
      }
    } else if (type.kind == FieldKind::kMessage) {
      out += "\n";
      message(*type.message, value, indent + 2, false);
    } else {
      out += " " + yaml_scalar(type, value, style_, false) + "\n";
    }
  }

  void list(const FieldType& type, const MessageValue& value, std::size_t indent) {
    const FieldType element = type.element();
    const MessageValue::List& list = value.list();
    if (list.empty()) {
      out += "[]\n";
    }
    for (std::size_t i = 0; i < std::min(list.size(), style_.truncate); ++i) {
      out += std::string(indent, ' ') + "- ";
      this->value(element, list[i], indent + 2, true);
    }
    if (list.size() > style_.truncate) {
      out += std::string(indent, ' ') + "- '...'\n";
    }
  }

  const PrintStyle& style_;
};

std::string flow(const FieldType& type, const MessageValue& value, const PrintStyle& style) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (type.many != Many::kOne) {
    const FieldType element = type.element();
    const MessageValue::List& list = value.list();
    for (std::size_t i = 0; i < std::min(list.size(), style.truncate); ++i) {
      add(flow(element, list[i], style));
    }
    if (list.size() > style.truncate) {
      add("'...'");
    }
    return "[" + text + "]";
  }
  if (type.kind != FieldKind::kMessage) {
    return yaml_scalar(type, value, style, true);
  }
  for (std::size_t i = 0; i < type.message->fields.size(); ++i) {
    const MessageField& field = type.message->fields[i];
    const MessageValue& member = value.list()[i];
    const bool summarised = field.type.many != Many::kOne && style.no_arrays;
    add(yaml_text(field.name, true) + ": " +
        (summarised ? yaml_text(array_summary(field.type, member.list().size()), true)
                    : flow(field.type, member, style)));
  }
  return "{" + (text.empty() ? "structure_needs_at_least_one_member: 0" : text) + "}";
}

}  // namespace

std::string python_float(double value) {
  if (std::isnan(value)) {
    return "nan";
  }
  if (std::isinf(value)) {
    return value > 0 ? "inf" : "-inf";
  }
  // The shortest digits that give the same number. Python writes an exponent below 1e-4 and from 1e16 on.
  const double magnitude = std::abs(value);
  const bool plain = magnitude == 0.0 || (magnitude >= 1e-4 && magnitude < 1e16);
  std::string text(400, '\0');
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific);
  text.resize(static_cast<std::size_t>(end.ptr - text.data()));
  if (plain && text.find('.') == std::string::npos) {
    text += ".0";
  }
  return text;
}

std::string to_yaml(const FieldType& type, const MessageValue& value, const PrintStyle& style) {
  if (type.many != Many::kOne && style.no_arrays) {
    return array_summary(type, value.list().size()) + "\n";
  }
  if (style.flow) {
    return flow(type, value, style) + "\n";
  }
  BlockWriter writer(style);
  writer.value(type, value, 0, false);
  return std::move(writer.out);
}

std::string to_csv(const FieldType& type, const MessageValue& value, const PrintStyle& style) {
  std::string text;
  bool is_first = true;
  const auto add = [&](const std::string& part) {
    text += (is_first ? "" : ",") + part;
    is_first = false;
  };
  if (type.many != Many::kOne) {
    if (style.no_arrays) {
      return array_summary(type, value.list().size());
    }
    const FieldType element = type.element();
    const MessageValue::List& list = value.list();
    for (std::size_t i = 0; i < std::min(list.size(), style.truncate); ++i) {
      add(to_csv(element, list[i], style));
    }
    if (list.size() > style.truncate) {
      add("...");
    }
    return text;
  }
  if (type.kind == FieldKind::kMessage) {
    for (std::size_t i = 0; i < type.message->fields.size(); ++i) {
      add(to_csv(type.message->fields[i].type, value.list()[i], style));
    }
    return text;
  }
  if (is_text(type.kind)) {
    return shown_text(std::get<std::string>(value.data), style);
  }
  switch (type.kind) {
    case FieldKind::kBool:
      return std::get<bool>(value.data) ? "True" : "False";
    case FieldKind::kFloat32:
    case FieldKind::kFloat64:
      return python_float(std::get<double>(value.data));
    default:
      return yaml_scalar(type.kind == FieldKind::kByte ? FieldType{FieldKind::kUint8} : type, value, style, false);
  }
}

}  // namespace launch
