// SPDX-License-Identifier: Apache-2.0
// How a message of the launcher becomes a line: a format of Python's logging in braces, as ROS 2 has it in the
// variables OVERRIDE_LAUNCH_SCREEN_FORMAT and OVERRIDE_LAUNCH_LOG_FORMAT.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

struct FormattedMessage {
  double created;  // seconds since 1970
  int level;       // Python's number: 10 for DEBUG to 50 for CRITICAL
  std::string_view level_name;
  std::string_view logger;
  std::string_view text;
};

class MessageFormat {
 public:
  // "{created:.3f} [{levelname}] {name}: {msg}", or one of the names `default` ("[{levelname}] [{name}]: {msg}") and
  // `default_with_timestamp`. Backslash escapes mean what they mean to Python. Throws std::invalid_argument with a
  // sentence.
  explicit MessageFormat(std::string_view text);

  // The line, without its end.
  std::string line(const FormattedMessage& message) const;

 private:
  enum class Field { kText, kCreated, kTime, kLevelName, kLevelNumber, kName, kMessage, kProcess };
  struct Part {
    Field field;
    std::string text;  // of kText; else the specification, "{:.3f}"
  };

  static Part field(std::string_view inside);

  std::vector<Part> parts_;
};

}  // namespace launch
