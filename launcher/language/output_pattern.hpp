// SPDX-License-Identifier: Apache-2.0
// The lines of a process that a launch file means.
#pragma once

#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <string_view>

#include "base/diagnostics/source.hpp"
#include "launcher/process/output/output_router.hpp"

namespace launch {

class Fields;
struct Scope;

class OutputPattern {
 public:
  // Only this part of a line is searched, because the time and the memory of a search grow with the line.
  static constexpr std::size_t kSearchedLength = 4096;

  OutputPattern() = default;  // every line
  // `expression` is an ECMAScript regular expression that is searched for in each line. An empty expression matches
  // every line. `stream` is "stdout", "stderr" or "both". Throws LaunchError at the place of the wrong argument.
  OutputPattern(const std::string& expression, const SourceRange& expression_where, const std::string& stream,
                const SourceRange& stream_where);

  // `line` without its end.
  bool matches(OutputStream stream, std::string_view line) const;

  const std::string& expression() const { return text_; }
  // "stdout", "stderr" or "both".
  std::string_view stream() const;
  // "a line that matches 'ready' on stdout", "any line".
  std::string describe() const;

 private:
  std::string text_;
  std::shared_ptr<const std::regex> expression_;  // null: every line
  bool out_ = true;
  bool err_ = true;
};

// What the attributes `pattern` and `stream` of an action give, which may be missing. Throws LaunchError.
OutputPattern perform_output_pattern(const Fields& fields, Scope& scope);

}  // namespace launch
