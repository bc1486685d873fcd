// SPDX-License-Identifier: Apache-2.0
// Errors and warnings for a person at a terminal: place, line, caret, suggestion, include chain.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/finding.hpp"
#include "base/diagnostics/source.hpp"

namespace launch {

enum class Severity { kWarning, kError };

struct Diagnostic {
  Severity severity = Severity::kError;
  // One sentence, lower case, no full stop: "unknown attribute 'exce' of <node>".
  std::string message;
  // What the caret points at; may be empty.
  SourceRange where;
  // What to do about it: "did you mean 'exec'?"; may be empty.
  std::string help;
  Finding finding = Finding::kNone;
};

// Errors found while loading or visiting a launch file. Holds at least one diagnostic; what() is the plain rendering.
class LaunchError : public std::runtime_error {
 public:
  explicit LaunchError(std::vector<Diagnostic> diagnostics);
  LaunchError(std::string message, SourceRange where, std::string help = {}, Finding finding = Finding::kNone);

  // Gives a kind to the diagnostics that have none.
  void classify(Finding finding);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

// Renders as compilers do, with a line end after each line:
//
//   system.launch.xml:4:21: error: unknown attribute 'exce' of <node>
//       4 |   <node pkg="demo" exce="talker"/>
//         |                    ^~~~
//         = help: did you mean 'exec'?
//         = included from main.launch.xml:3:3
//
// `colour` adds ANSI colours. Long lines are cut around the caret, tabs become spaces. A diagnostic without a place
// begins with the name of the `command`, if there is one: "launch check: error: …".
std::string render(const Diagnostic& diagnostic, bool colour = false, std::string_view command = {});
std::string render(const std::vector<Diagnostic>& diagnostics, bool colour = false, std::string_view command = {});

// The line with the help below an error, with its line end; "" when there is no help.
std::string help_line(std::string_view help);

// "did you mean 'exec'?" for the candidate nearest to `name`, or "" when none is near enough.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace launch
