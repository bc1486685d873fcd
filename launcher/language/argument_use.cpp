// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/argument_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace launch {

namespace {

constexpr std::string_view kOwnConfigurations[] = {"launch-prefix",   "launch-prefix-filter", "sigterm_timeout",
                                                   "sigkill_timeout", "emulate_tty",          "ros_namespace"};

constexpr std::string_view kQuotes[] = {"'", "\"", "&quot;", "&apos;"};

bool reads_in_python(const std::string& text, std::string_view name) {
  return text.find(fmt::format("'{}'", name)) != std::string::npos ||
         text.find(fmt::format("\"{}\"", name)) != std::string::npos ||
         text.find("launch_configurations") != std::string::npos;
}

}  // namespace

bool may_read(const SourceFile& file, std::string_view name) {
  constexpr std::string_view kVariable = "$(var ";
  if (file.path().ends_with(".py")) {
    return reads_in_python(file.text(), name);
  }
  const std::string_view text = file.text();
  for (std::size_t at = text.find(kVariable); at != std::string_view::npos; at = text.find(kVariable, at + 1)) {
    std::string_view read = text.substr(at + kVariable.size());
    for (const std::string_view quote : kQuotes) {
      if (read.starts_with(quote)) {
        read.remove_prefix(quote.size());
        break;
      }
    }
    const std::string_view first = read.substr(0, read.find_first_of(")' \"&"));
    if (first == name || first.find("$(") != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

bool is_own_configuration(std::string_view name) {
  return std::find(std::begin(kOwnConfigurations), std::end(kOwnConfigurations), name) != std::end(kOwnConfigurations);
}

std::vector<std::string> own_configurations() {
  return {std::begin(kOwnConfigurations), std::end(kOwnConfigurations)};
}

}  // namespace launch
