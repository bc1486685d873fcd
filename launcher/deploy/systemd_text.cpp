// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/systemd_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text/utf8.hpp"

namespace launch {
namespace {

constexpr unsigned char kDelete = 0x7f;

}  // namespace

std::string systemd_quoted(std::string_view text, bool in_command) {
  std::string all = "\"";
  while (!text.empty()) {
    const CodePoint point = decode_utf8(text);
    const char c = text.front();
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      all += {'\\', c};
    } else if (c == '%' || (c == '$' && in_command)) {
      all += {c, c};
    } else if (c == '\n') {
      all += "\\n";
    } else if (byte < ' ' || byte == kDelete || !point.valid) {
      all += fmt::format("\\x{:02x}", byte);
    } else {
      all += text.substr(0, point.size);
    }
    text.remove_prefix(point.size);
  }
  return all + '"';
}

std::string systemd_line(std::string_view text) {
  std::string valid;
  append_as_utf8(valid, text);
  std::string line;
  for (const char c : valid) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < ' ' || byte == kDelete ? '?' : c;
    line += c == '%' ? "%" : "";
  }
  return line.ends_with('\\') ? line + " -" : line;
}

bool is_systemd_path(std::string_view path) {
  const bool is_plain = std::none_of(path.begin(), path.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < ' ' || byte == kDelete || c == '"' || c == '\'' || c == '\\' || c == '$';
  });
  const std::string components = std::string(path) + "/";
  return path.starts_with('/') && is_plain && is_utf8(path) && !path.ends_with(' ') &&
         components.find("/../") == std::string::npos;
}

std::string unit_name(std::string_view text) {
  std::string name(text);
  for (char& c : name) {
    const bool allowed =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':';
    c = allowed ? c : '-';
  }
  return name;
}

}  // namespace launch
