// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/exit_code_filter.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/ascii.hpp"

namespace launch {

namespace {

constexpr int kHighestExitCode = 255;
constexpr std::string_view kBlanks = " \t\n";

std::optional<int> whole_number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end ? std::optional(value) : std::nullopt;
}

std::optional<int> exit_code(const std::string& word) {
  if (const std::optional<int> number = whole_number(word)) {
    const bool possible = *number >= 0 ? *number <= kHighestExitCode : ::sigabbrev_np(-*number) != nullptr;
    return possible ? number : std::nullopt;
  }
  const int signal = word.starts_with("SIG") ? signal_number(word) : 0;
  return signal != 0 ? std::optional(-signal) : std::nullopt;
}

}  // namespace

ExitCodeFilter::ExitCodeFilter(const std::string& text, const SourceRange& where) : text_(trim(text, kBlanks)) {
  if (text_ == "any") {
    return;
  }
  if (text_ == "nonzero") {
    kind_ = Kind::kNonzero;
    return;
  }
  kind_ = Kind::kListed;
  for (std::size_t begin = 0; begin <= text_.size();) {
    const std::size_t end = std::min(text_.find(',', begin), text_.size());
    const std::string word(trim(std::string_view(text_).substr(begin, end - begin), kBlanks));
    const std::optional<int> code = exit_code(word);
    if (!code) {
      if (word == "any" || word == "nonzero") {
        throw LaunchError(fmt::format("'{}' stands alone", word), where,
                          fmt::format("leave the other exit codes out, or leave {} out", word));
      }
      if (signal_number("SIG" + word) != 0) {
        throw LaunchError(fmt::format("'{}' is no exit code", word), where, fmt::format("did you mean 'SIG{}'?", word));
      }
      std::vector<std::string> known = signal_names();
      known.insert(known.end(), {"any", "nonzero"});
      const std::string suggestion = did_you_mean(word, known);
      throw LaunchError(fmt::format("'{}' is no exit code", word), where,
                        suggestion.empty()
                            ? "write any, nonzero, or numbers from 0 to 255 and signals such as SIGSEGV, "
                              "separated by commas"
                            : suggestion);
    }
    codes_.push_back(*code);
    begin = end + 1;
  }
}

bool ExitCodeFilter::matches(int code) const {
  switch (kind_) {
    case Kind::kAny:
      return true;
    case Kind::kNonzero:
      return code != 0;
    case Kind::kListed:
      break;
  }
  return std::find(codes_.begin(), codes_.end(), code) != codes_.end();
}

int ExitCodeFilter::example() const {
  return kind_ == Kind::kListed ? codes_.front() : kind_ == Kind::kNonzero ? 1 : 0;
}

int signal_number(const std::string& name) {
  if (const std::optional<int> number = whole_number(name)) {
    return *number > 0 && ::sigabbrev_np(*number) != nullptr ? *number : 0;
  }
  const std::string short_name = name.starts_with("SIG") ? name.substr(3) : name;
  for (int signal = 1; signal < NSIG; ++signal) {
    const char* const known = ::sigabbrev_np(signal);
    if (known != nullptr && short_name == known) {
      return signal;
    }
  }
  return 0;
}

std::vector<std::string> signal_names() {
  std::vector<std::string> names;
  for (int signal = 1; signal < NSIG; ++signal) {
    if (const char* const known = ::sigabbrev_np(signal)) {
      names.push_back(fmt::format("SIG{}", known));
    }
  }
  return names;
}

int signal_of(const std::string& name, const SourceRange& where) {
  const int signal = signal_number(name);
  if (signal == 0) {
    throw LaunchError(fmt::format("'{}' is no signal", name), where, did_you_mean(name, signal_names()));
  }
  return signal;
}

}  // namespace launch
