// SPDX-License-Identifier: Apache-2.0
#include "tracing/expect/wrapper_file.hpp"

#include <fmt/format.h>

namespace launch_trace_testing {

namespace {

// A text as the value of an attribute. `$` and `\` mean something in launch files.
std::string attribute(const std::string& text) {
  std::string value;
  for (const char c : text) {
    switch (c) {
      case '&':
        value += "&amp;";
        break;
      case '<':
        value += "&lt;";
        break;
      case '"':
        value += "&quot;";
        break;
      case '\n':
        value += "&#10;";
        break;
      case '\t':
        value += "&#9;";
        break;
      case '$':
      case '\\':
        value += '\\';
        [[fallthrough]];
      default:
        value += c;
    }
  }
  return "\"" + value + "\"";
}

// One word of a command line that is split as a shell splits it.
std::string quoted_word(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) {
    quoted += c == '\'' ? std::string("'\"'\"'") : std::string(1, c);
  }
  return quoted + "'";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " ") + quoted_word(word);
  }
  return text;
}

}  // namespace

std::string wrapper_file(const RunOptions& options, const std::string& session,
                         const std::filesystem::path& trace_directory) {
  std::string text = "<launch>\n";
  if (!options.events.empty()) {
    text += fmt::format("  <trace session-name={} base-path={} events-ust={}/>\n", attribute(session),
                        attribute(trace_directory.string()), attribute(joined(options.events)));
  }
  if (!options.file.empty()) {
    text += fmt::format("  <include file={}>\n", attribute(std::filesystem::absolute(options.file).string()));
    for (const auto& [name, value] : options.arguments) {
      text += fmt::format("    <arg name={} value={}/>\n", attribute(name), attribute(value));
    }
    text += "  </include>\n";
  }
  for (const Program& program : options.programs) {
    text += fmt::format("  <executable cmd={} output=\"screen\"/>\n", attribute(joined(program)));
  }
  return text + "</launch>\n";
}

}  // namespace launch_trace_testing
