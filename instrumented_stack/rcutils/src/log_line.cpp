// SPDX-License-Identifier: Apache-2.0
#include "log_line.hpp"

#include <array>
#include <cstdio>
#include <ctime>
#include <utility>

namespace rcutils {
namespace {

constexpr std::string_view kResetColor = "\033[0m";

std::string_view color_of(int severity) {
  switch (severity) {
    case RCUTILS_LOG_SEVERITY_DEBUG:
      return "\033[32m";
    case RCUTILS_LOG_SEVERITY_WARN:
      return "\033[33m";
    case RCUTILS_LOG_SEVERITY_ERROR:
    case RCUTILS_LOG_SEVERITY_FATAL:
      return "\033[31m";
    default:
      return kResetColor;
  }
}

std::string seconds(rcutils_time_point_value_t timestamp) {
  char text[32];
  std::snprintf(text, sizeof(text), "%010lld.%09lld", static_cast<long long>(RCUTILS_NS_TO_S(timestamp)),
                static_cast<long long>(timestamp % RCUTILS_S_TO_NS(1)));
  return text;
}

std::string nanoseconds(rcutils_time_point_value_t timestamp) {
  char text[32];
  std::snprintf(text, sizeof(text), "%019lld", static_cast<long long>(timestamp));
  return text;
}

std::string date_time(rcutils_time_point_value_t timestamp) {
  const std::time_t whole = static_cast<std::time_t>(RCUTILS_NS_TO_S(timestamp));
  std::tm local{};
  localtime_r(&whole, &local);
  char date[32];
  std::strftime(date, sizeof(date), "%Y-%m-%d %H:%M:%S", &local);
  char text[48];
  std::snprintf(text, sizeof(text), "%s.%03lld", date, static_cast<long long>(RCUTILS_NS_TO_MS(timestamp) % 1000));
  return text;
}

char unescaped(char c) {
  switch (c) {
    case 'a':
      return '\a';
    case 'b':
      return '\b';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case '\\':
      return '\\';
    default:
      return 0;
  }
}

}  // namespace

LogLine::Token LogLine::token_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Token>, 9> kTokens{{
      {"severity", Token::kSeverity},
      {"name", Token::kName},
      {"message", Token::kMessage},
      {"function_name", Token::kFunctionName},
      {"file_name", Token::kFileName},
      {"line_number", Token::kLineNumber},
      {"time", Token::kTime},
      {"time_as_nanoseconds", Token::kTimeAsNanoseconds},
      {"date_time_with_ms", Token::kDateTimeWithMs},
  }};
  for (const auto& [known, token] : kTokens) {
    if (known == name) {
      return token;
    }
  }
  return Token::kLiteral;
}

LogLine::LogLine(std::string_view format) {
  std::string literal;
  const auto flush = [&] {
    if (!literal.empty()) {
      pieces_.push_back({Token::kLiteral, std::exchange(literal, {})});
    }
  };
  for (size_t i = 0; i < format.size(); ++i) {
    if (format[i] == '\\' && i + 1 < format.size() && unescaped(format[i + 1]) != 0) {
      literal += unescaped(format[++i]);
      continue;
    }
    const size_t end = format[i] == '{' ? format.find('}', i) : std::string_view::npos;
    if (end != std::string_view::npos) {
      const Token token = token_named(format.substr(i + 1, end - i - 1));
      if (token != Token::kLiteral) {
        flush();
        pieces_.push_back({token, {}});
        i = end;
        continue;
      }
    }
    literal += format[i];
  }
  flush();
}

std::string LogLine::fill(const rcutils_log_location_t* location, int severity, const char* name,
                          rcutils_time_point_value_t timestamp, std::string_view message, bool colorized) const {
  std::string line;
  line.reserve(message.size() + 64);
  if (colorized) {
    line += color_of(severity);
  }
  for (const Piece& piece : pieces_) {
    switch (piece.token) {
      case Token::kLiteral:
        line += piece.literal;
        break;
      case Token::kSeverity:
        if (const char* text = rcutils_logging_severity_name(severity)) {
          line += text;
        }
        break;
      case Token::kName:
        line += name == nullptr ? "" : name;
        break;
      case Token::kMessage:
        line += message;
        break;
      case Token::kFunctionName:
        line += location == nullptr ? "" : location->function_name;
        break;
      case Token::kFileName:
        line += location == nullptr ? "" : location->file_name;
        break;
      case Token::kLineNumber:
        line += location == nullptr ? "" : std::to_string(location->line_number);
        break;
      case Token::kTime:
        line += seconds(timestamp);
        break;
      case Token::kTimeAsNanoseconds:
        line += nanoseconds(timestamp);
        break;
      case Token::kDateTimeWithMs:
        line += date_time(timestamp);
        break;
    }
  }
  if (colorized) {
    line += kResetColor;
  }
  line += '\n';
  return line;
}

}  // namespace rcutils
