// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/failure.hpp"

#include <fmt/format.h>

namespace launch {

TestFailure as_text(const Diagnostic& diagnostic) {
  TestFailure failure;
  failure.message = diagnostic.message;
  failure.text = render(diagnostic);
  if (diagnostic.where) {
    const SourceFile::Position position = diagnostic.where.file->position(diagnostic.where.begin);
    failure.file = diagnostic.where.file->path();
    failure.line = position.line;
    failure.column = position.column;
  }
  return failure;
}

TestFailure as_text(const Failure& failure) {
  TestFailure result = as_text(Diagnostic{Severity::kError, failure.message, failure.where, {}});
  const auto note = [&](const char* kind, const std::string& text) {
    if (!text.empty()) {
      result.text += fmt::format("      = {}: {}\n", kind, text);
    }
  };
  note("expected", failure.expected);
  note("seen", failure.seen);
  note("help", failure.help);
  if (!failure.evidence.empty()) {
    result.text += fmt::format("      = {}:\n", failure.evidence_title);
    for (const std::string& line : failure.evidence) {
      result.text += fmt::format("          {}\n", line);
    }
  }
  return result;
}

}  // namespace launch
