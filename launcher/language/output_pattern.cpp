// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/output_pattern.hpp"

#include <fmt/format.h>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/language/fields.hpp"

namespace launch {

OutputPattern::OutputPattern(const std::string& expression, const SourceRange& expression_where,
                             const std::string& stream, const SourceRange& stream_where)
    : text_(expression), out_(stream != "stderr"), err_(stream != "stdout") {
  if (stream != "stdout" && stream != "stderr" && stream != "both") {
    throw LaunchError(fmt::format("'{}' is no stream of a process, expected stdout, stderr or both", stream),
                      stream_where, did_you_mean(stream, {"stdout", "stderr", "both"}));
  }
  if (text_.empty()) {
    return;
  }
  try {
    expression_ = std::make_shared<const std::regex>(text_, std::regex::ECMAScript | std::regex::optimize);
  } catch (const std::regex_error& error) {
    throw LaunchError(fmt::format("'{}' is not a regular expression: {}", text_, error.what()), expression_where,
                      R"(put two backslashes in front of characters such as ( [ * + ? that stand for themselves)");
  }
}

bool OutputPattern::matches(OutputStream stream, std::string_view line) const {
  if (!(stream == OutputStream::kOut ? out_ : err_)) {
    return false;
  }
  line = line.substr(0, kSearchedLength);
  return expression_ == nullptr || std::regex_search(line.begin(), line.end(), *expression_);
}

std::string_view OutputPattern::stream() const {
  return out_ && err_ ? "both" : out_ ? "stdout" : "stderr";
}

std::string OutputPattern::describe() const {
  return fmt::format("{}{}", expression_ == nullptr ? "any line" : fmt::format("a line that matches '{}'", text_),
                     out_ && err_ ? "" : fmt::format(" on {}", stream()));
}

OutputPattern perform_output_pattern(const Fields& fields, Scope& scope) {
  const auto text = [&](const char* attribute, const char* otherwise) {
    return fields.has(attribute) ? fields.text(attribute).perform(scope) : std::string(otherwise);
  };
  const std::string pattern = text("pattern", "");
  return {pattern, fields.where("pattern"), text("stream", "both"), fields.where("stream")};
}

}  // namespace launch
