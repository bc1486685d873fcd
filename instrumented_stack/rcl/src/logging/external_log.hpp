// SPDX-License-Identifier: Apache-2.0
// Where messages go beside the console and /rosout.
#pragma once

#include <string>

namespace rcl {

// Thread safe.
class ExternalLog {
 public:
  virtual ~ExternalLog() = default;
  // `line` ends with a line feed.
  virtual void write(int severity, const char* name, std::string line) = 0;
};

}  // namespace rcl
