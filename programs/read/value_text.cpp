// SPDX-License-Identifier: Apache-2.0
#include "programs/read/value_text.hpp"

#include <cmath>
#include <iterator>

#include "base/text/utf8.hpp"

namespace tracing {

namespace {

void append_real(Buffer& out, double value, bool json) {
  if (json && !std::isfinite(value)) {
    return append(out, "null");
  }
  fmt::format_to(std::back_inserter(out), "{}", value);
}

}  // namespace

void append(Buffer& out, std::string_view text) {
  out.append(text.data(), text.data() + text.size());
}

void append_quoted(Buffer& out, std::string_view text) {
  out.push_back('"');
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c == '"' || c == '\\') {
      out.push_back('\\');
      out.push_back(static_cast<char>(c));
    } else if (c == '\n') {
      append(out, "\\n");
    } else if (c == '\t') {
      append(out, "\\t");
    } else if (c < 0x20 || c == 0x7f) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", c);
    } else if (c < 0x80) {
      out.push_back(static_cast<char>(c));
    } else {
      const launch::CodePoint character = launch::decode_utf8(text.substr(i));
      append(out, character.valid ? text.substr(i, character.size) : "\xef\xbf\xbd");
      i += character.size - 1;
    }
  }
  out.push_back('"');
}

void append_number(Buffer& out, const FieldValue& value, bool hexadecimal) {
  if (const auto number = value.unsigned_integer()) {
    if (hexadecimal) {
      fmt::format_to(std::back_inserter(out), "{:#x}", *number);
    } else {
      fmt::format_to(std::back_inserter(out), "{}", *number);
    }
  } else if (const auto with_sign = value.integer()) {
    fmt::format_to(std::back_inserter(out), "{}", *with_sign);
  }
}

bool is_number(const FieldValue& value) {
  return value.unsigned_integer().has_value() || value.integer().has_value();
}

namespace {

void append_value(Buffer& out, const FieldValue& value, bool json) {
  if (const auto label = value.enumeration_label()) {
    if (json) {
      return append_quoted(out, *label);
    }
    append(out, *label);
    out.push_back(':');
  }
  if (is_number(value)) {
    return append_number(out, value, !json && value.is_hexadecimal());
  }
  if (const auto real = value.real()) {
    return append_real(out, *real, json);
  }
  if (const auto text = value.string()) {
    return append_quoted(out, *text);
  }
  if (value.is_variant()) {
    return append_value(out, value[0], json);
  }
  out.push_back(value.is_structure() ? '{' : '[');
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (i > 0) {
      out.push_back(json ? ',' : ' ');
    }
    if (value.is_structure()) {
      json ? append_quoted(out, value.member_name(i)) : append(out, value.member_name(i));
      out.push_back(json ? ':' : '=');
    }
    append_value(out, value[i], json);
  }
  out.push_back(value.is_structure() ? '}' : ']');
}

}  // namespace

void append_text(Buffer& out, const FieldValue& value) {
  append_value(out, value, false);
}

void append_json(Buffer& out, const FieldValue& value) {
  append_value(out, value, true);
}

}  // namespace tracing
