// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/argument_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

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

// Calls `found` with what stands after each "$(var ", until it returns false.
template <typename Found>
void for_each_read(std::string_view text, Found found) {
  constexpr std::string_view kVariable = "$(var ";
  for (std::size_t at = text.find(kVariable); at != std::string_view::npos; at = text.find(kVariable, at + 1)) {
    std::string_view read = text.substr(at + kVariable.size());
    for (const std::string_view quote : kQuotes) {
      if (read.starts_with(quote)) {
        read.remove_prefix(quote.size());
        break;
      }
    }
    if (!found(read.substr(0, read.find_first_of(")' \"&")))) {
      return;
    }
  }
}

bool is_computed(std::string_view name) {
  return name.find("$(") != std::string_view::npos;
}

}  // namespace

ArgumentUse::ArgumentUse(std::shared_ptr<const SourceFile> file) {
  if (file->path().ends_with(".py")) {
    python_ = std::move(file);
    return;
  }
  for_each_read(file->text(), [this](std::string_view name) {
    names_.emplace(name);
    computes_names_ = computes_names_ || is_computed(name);
    return true;
  });
}

bool ArgumentUse::may_read(std::string_view name) const {
  return python_ != nullptr ? reads_in_python(python_->text(), name) : computes_names_ || names_.contains(name);
}

bool may_read(const SourceFile& file, std::string_view name) {
  if (file.path().ends_with(".py")) {
    return reads_in_python(file.text(), name);
  }
  bool is_read = false;
  for_each_read(file.text(), [&](std::string_view read) {
    is_read = read == name || is_computed(read);
    return !is_read;
  });
  return is_read;
}

bool is_own_configuration(std::string_view name) {
  return std::find(std::begin(kOwnConfigurations), std::end(kOwnConfigurations), name) != std::end(kOwnConfigurations);
}

std::vector<std::string> own_configurations() {
  return {std::begin(kOwnConfigurations), std::end(kOwnConfigurations)};
}

}  // namespace launch
