// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace track_parsers {

class Parser {
 public:
  virtual ~Parser() = default;
  virtual int width(const std::string& text) = 0;
};

[[deprecated("for the test")]] inline int old_width() {
  return 640;
}

}  // namespace track_parsers
