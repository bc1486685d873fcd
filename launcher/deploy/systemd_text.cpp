// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/systemd_text.hpp"

namespace launch {

std::string systemd_quoted(std::string_view text, bool in_command) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      all += '\\';
    } else if (c == '%' || (c == '$' && in_command)) {
      all += c;
    } else if (c == '\n') {
      all += "\\n";
      continue;
    }
    all += c;
  }
  return all + '"';
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
