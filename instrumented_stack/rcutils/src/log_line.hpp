// SPDX-License-Identifier: Apache-2.0
// The format of a console line: RCUTILS_CONSOLE_OUTPUT_FORMAT parsed once, filled in for each message.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rcutils/logging.h"

namespace rcutils {

class LogLine {
 public:
  static constexpr std::string_view kDefaultFormat = "[{severity}] [{time}] [{name}]: {message}";

  // `{token}` stands for a value; unknown tokens are literal text; \a \b \n \r \t \\ are escapes.
  explicit LogLine(std::string_view format = kDefaultFormat);

  // One line, with the newline. `location` and `name` may be null.
  std::string fill(const rcutils_log_location_t* location, int severity, const char* name,
                   rcutils_time_point_value_t timestamp, std::string_view message, bool colorized) const;

 private:
  enum class Token {
    kLiteral,
    kSeverity,
    kName,
    kMessage,
    kFunctionName,
    kFileName,
    kLineNumber,
    kTime,
    kTimeAsNanoseconds,
    kDateTimeWithMs,
  };
  struct Piece {
    Token token;
    std::string literal;
  };

  static Token token_named(std::string_view name);

  std::vector<Piece> pieces_;
};

}  // namespace rcutils
