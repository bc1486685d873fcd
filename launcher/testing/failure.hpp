// SPDX-License-Identifier: Apache-2.0
// Why a test has failed, for a person and for files of results.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"

namespace launch {

// What a check has found.
struct Failure {
  std::string message;  // one sentence, as in Diagnostic
  SourceRange where;
  std::string expected = {};               // may be empty
  std::string seen = {};                   // may be empty
  std::vector<std::string> evidence = {};  // lines
  std::string evidence_title = {};         // "last lines of talker-1"
  std::string help = {};
};

// The same when only text is left, as it goes from the process of a test to the report.
struct TestFailure {
  std::string message;
  std::string file;  // empty: no place
  unsigned line = 0;
  unsigned column = 0;
  std::string text;  // as render() of a diagnostic gives it, with what was expected and seen below
};

TestFailure as_text(const Failure& failure);
TestFailure as_text(const Diagnostic& diagnostic);

}  // namespace launch
