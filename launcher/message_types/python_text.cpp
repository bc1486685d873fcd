// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>

#include "base/text/utf8.hpp"
#include "launcher/message_types/print_value.hpp"

namespace launch {

namespace {

// The quotes that need no escapes, if there are such.
char quote_for(std::string_view text) {
  return text.find('\'') != text.npos && text.find('"') == text.npos ? '"' : '\'';
}

void append_escaped(std::string& to, char32_t c, char quote) {
  if (c == static_cast<unsigned char>(quote) || c == '\\') {
    to += '\\';
    to += static_cast<char>(c);
  } else if (c == '\n') {
    to += "\\n";
  } else if (c == '\t') {
    to += "\\t";
  } else if (c == '\r') {
    to += "\\r";
  } else {
    to += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
  }
}

std::string single(const FieldType& type, const MessageValue& value) {
  switch (type.kind) {
    case FieldKind::kMessage:
      return to_python(*type.message, value);
    case FieldKind::kString:
    case FieldKind::kWstring:
      return python_string(std::get<std::string>(value.data));
    case FieldKind::kByte: {
      const auto byte = static_cast<std::uint8_t>(std::get<std::int64_t>(value.data));
      return python_bytes(&byte, 1);
    }
    default:
      return to_csv(type, value);
  }
}

}  // namespace

std::string python_string(std::string_view text) {
  const char quote = quote_for(text);
  std::string quoted(1, quote);
  while (!text.empty()) {
    const CodePoint character = decode_utf8(text);
    const char32_t c = character.valid ? character.value : 0xFFFD;
    if (c < 0x20 || c == 0x7F || c == '\\' || c == static_cast<unsigned char>(quote)) {
      append_escaped(quoted, c, quote);
    } else {
      append_utf8(quoted, c);
    }
    text.remove_prefix(character.size);
  }
  return quoted + quote;
}

std::string python_bytes(const std::uint8_t* bytes, std::size_t size) {
  const char quote = quote_for({reinterpret_cast<const char*>(bytes), size});
  std::string text = std::string("b") + quote;
  std::for_each(bytes, bytes + size, [&](std::uint8_t byte) {
    if (byte >= 0x20 && byte < 0x7F && byte != '\\' && byte != static_cast<unsigned char>(quote)) {
      text += static_cast<char>(byte);
    } else {
      append_escaped(text, byte, quote);
    }
  });
  return text + quote;
}

std::string to_python(const FieldType& type, const MessageValue& value) {
  if (type.many == Many::kOne) {
    return single(type, value);
  }
  const FieldType element = type.element();
  std::string text;
  for (const MessageValue& each : value.list()) {
    text += (text.empty() ? "" : ", ") + single(element, each);
  }
  return "[" + text + "]";
}

std::string to_python(const MessageType& type, const MessageValue& value) {
  std::string name = type.name;
  std::replace(name.begin(), name.end(), '/', '.');
  std::string fields;
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    fields += fmt::format("{}{}={}", fields.empty() ? "" : ", ", type.fields[i].name,
                          to_python(type.fields[i].type, value.list()[i]));
  }
  return fmt::format("{}({})", name, fields);
}

}  // namespace launch
