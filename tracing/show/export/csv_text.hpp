// SPDX-License-Identifier: Apache-2.0
// Texts in CSV files.
#pragma once

#include <string>
#include <string_view>

namespace tracing {

// Quoted as RFC 4180 says, where it must be.
inline void append_csv_text(std::string& line, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') {
      line += '"';
    }
    line += c;
  }
  line += '"';
}

}  // namespace tracing
