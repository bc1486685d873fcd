// SPDX-License-Identifier: Apache-2.0
// The exit codes that a launch file means: "0", "nonzero", "1, 2, SIGSEGV".
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

class ExitCodeFilter {
 public:
  ExitCodeFilter() = default;  // any code
  // `text` is "any", "nonzero", or codes separated by commas: numbers, -N or SIGNAME for an end by signal. Throws
  // LaunchError at `where`.
  ExitCodeFilter(const std::string& text, const SourceRange& where);

  // `code` is as in ProcessExit: -N for an end by signal N.
  bool matches(int code) const;
  // The text of the launch file; "any" when there was none.
  const std::string& text() const { return text_; }
  // The codes that it lists; none if it accepts any code, or any but 0.
  const std::vector<int>& codes() const { return codes_; }
  bool is_listed() const { return kind_ == Kind::kListed; }
  // A code that it accepts.
  int example() const;

 private:
  enum class Kind { kAny, kNonzero, kListed };

  Kind kind_ = Kind::kAny;
  std::vector<int> codes_;
  std::string text_ = "any";
};

// The number of a signal from its name, with or without "SIG", or from its number; 0 when there is no such signal.
// signal_names() gives the known names, for suggestions.
int signal_number(const std::string& name);
std::vector<std::string> signal_names();
// The number of a signal. Throws LaunchError at `where` when there is no such signal.
int signal_of(const std::string& name, const SourceRange& where);

}  // namespace launch
