// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/command_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string command_error(std::string_view command, std::string_view message, std::string_view help) {
  return fmt::format("{}: error: {}\n{}", command, message, help_line(help));
}

std::string usage_error(std::string_view command, std::string_view message, std::string_view help) {
  return command_error(command, message, help) + help_line(fmt::format("see '{} --help'", command));
}

std::string unexpected_word_error(std::string_view command, const std::vector<std::string>& words,
                                  const KnownWords& known, std::string_view message) {
  const auto unknown = [&](std::string_view what, const std::string& word, const std::vector<std::string>& names) {
    return usage_error(command, fmt::format("unknown {} '{}'", what, word), did_you_mean(word, names));
  };
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));  // without the value of "--format=json"
    if (name.starts_with('-') && name.size() > 1 && !contains(known.options, name)) {
      return unknown("option", name, known.options);
    }
    if (!name.starts_with('-') && !known.commands.empty() && !contains(known.commands, word)) {
      return unknown("command", word, known.commands);
    }
  }
  return usage_error(command, message);
}

std::string wrong_value_error(std::string_view command, std::string_view message) {
  // "--format: png not in {dot,svg}"
  constexpr std::string_view kNotIn = " not in {";
  const std::size_t option_end = message.find(": ");
  const std::size_t value_end = message.find(kNotIn);
  if (option_end >= value_end || value_end == std::string_view::npos || !message.ends_with('}')) {
    return usage_error(command, message);
  }
  const std::string value(message.substr(option_end + 2, value_end - option_end - 2));
  std::istringstream list(std::string(message.substr(value_end + kNotIn.size())));
  std::vector<std::string> values;
  for (std::string one; std::getline(list, one, ',');) {
    values.push_back(one.substr(0, one.find('}')));
  }
  return usage_error(
      command,
      fmt::format("{} {} is unknown, expected {}", message.substr(0, option_end), value, fmt::join(values, ", ")),
      did_you_mean(value, values));
}

}  // namespace launch
