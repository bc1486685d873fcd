// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/message_format.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/text/utf8.hpp"

namespace launch {
namespace {

constexpr FormattedMessage kSample{1.5, 20, "INFO", "launch", "text"};

std::string with_escapes(std::string_view text) {
  constexpr std::string_view kLetters = "ntr\\'\"abfv";
  constexpr std::string_view kMeanings = "\n\t\r\\'\"\a\b\f\v";
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      result += text[i];
      continue;
    }
    const char letter = text[++i];
    const std::size_t width = letter == 'x' ? 2 : letter == 'u' ? 4 : letter == 'U' ? 8 : 0;
    const bool hexadecimal = width > 0;
    const bool octal = letter >= '0' && letter <= '7';
    if (const std::size_t at = kLetters.find(letter); at != std::string_view::npos) {
      result += kMeanings[at];
    } else if (hexadecimal || octal) {
      const std::string_view digits = hexadecimal ? text.substr(i + 1, width) : text.substr(i, 3);
      unsigned value = 0;
      const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 8).ptr;
      const auto size = static_cast<std::size_t>(end - digits.data());
      const bool is_character = value < 0xd800 || (value > 0xdfff && value <= 0x10ffff);
      if (width > 2 && (size < width || !is_character)) {
        result.append({'\\', letter});
        continue;
      }
      i += hexadecimal ? size : size - 1;
      // Python's codec reads the number of \x and of octal digits as a character of Latin-1.
      append_utf8(result, value);
    } else {
      result.append({'\\', letter});
    }
  }
  return result;
}

std::string asctime(double created) {
  const auto seconds = static_cast<std::time_t>(std::floor(created));
  tm local{};
  ::localtime_r(&seconds, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &local);
  return fmt::format("{},{:03}", text.data(), static_cast<int>((created - std::floor(created)) * 1000));
}

// Puts the value in place of the field of a specification, "{:>8}". Throws fmt::format_error.
template <typename Value>
void append(std::string& line, const std::string& specification, const Value& value) {
  fmt::format_to(std::back_inserter(line), fmt::runtime(specification), value);
}

}  // namespace

MessageFormat::MessageFormat(std::string_view given) {
  std::string text = with_escapes(given);
  if (text == "default") {
    text = "[{levelname}] [{name}]: {msg}";
  } else if (text == "default_with_timestamp") {
    text = "{created:.7f} [{levelname}] [{name}]: {msg}";
  }
  parts_.push_back({Field::kText, ""});
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool brace = text[i] == '{' || text[i] == '}';
    if (brace && i + 1 < text.size() && text[i + 1] == text[i]) {
      ++i;
    } else if (brace) {
      const std::size_t end = text.find('}', i);
      if (text[i] == '}' || end == std::string::npos) {
        throw std::invalid_argument("a brace has no partner; write {{ or }} for a brace itself");
      }
      parts_.push_back(field(std::string_view(text).substr(i + 1, end - i - 1)));
      parts_.push_back({Field::kText, ""});
      i = end;
      continue;
    }
    parts_.back().text += text[i];
  }
  try {
    line(kSample);
  } catch (const fmt::format_error&) {
    throw std::invalid_argument("a field has a specification that does not suit it");
  }
}

MessageFormat::Part MessageFormat::field(std::string_view inside) {
  static const std::vector<std::pair<std::string, Field>> kFields = {
      {"created", Field::kCreated},     {"asctime", Field::kTime},   {"levelname", Field::kLevelName},
      {"levelno", Field::kLevelNumber}, {"name", Field::kName},      {"msg", Field::kMessage},
      {"message", Field::kMessage},     {"process", Field::kProcess}};
  const std::size_t colon = inside.find(':');
  const std::string_view name = inside.substr(0, colon);
  for (const auto& [known, field] : kFields) {
    if (name == known) {
      return {field, colon == std::string_view::npos ? "{}" : fmt::format("{{{}}}", inside.substr(colon))};
    }
  }
  throw std::invalid_argument(fmt::format(
      "there is no field '{}'; the fields are created, asctime, levelname, levelno, name, msg, process", name));
}

std::string MessageFormat::line(const FormattedMessage& message) const {
  std::string line;
  for (const Part& part : parts_) {
    switch (part.field) {
      case Field::kText:
        line += part.text;
        break;
      case Field::kCreated:
        append(line, part.text, message.created);
        break;
      case Field::kTime:
        append(line, part.text, asctime(message.created));
        break;
      case Field::kLevelName:
        append(line, part.text, message.level_name);
        break;
      case Field::kLevelNumber:
        append(line, part.text, message.level);
        break;
      case Field::kName:
        append(line, part.text, message.logger);
        break;
      case Field::kMessage:
        append(line, part.text, message.text);
        break;
      case Field::kProcess:
        append(line, part.text, ::getpid());
        break;
    }
  }
  return line;
}

}  // namespace launch
