// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "programs/launch/check/diagnostic_output.hpp"
#include "programs/launch/check/finding_table.hpp"

namespace launch {

namespace {

std::string from_here(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::path absolute = std::filesystem::absolute(path, ignored).lexically_normal();
  return absolute.lexically_proximate(std::filesystem::current_path(ignored)).string();
}

// The escapes of GitHub's workflow commands. In a property two more characters have a meaning.
std::string escaped(std::string_view text, bool property) {
  static const std::map<char, std::string_view> escapes = {{'%', "%25"}, {'\r', "%0D"}, {'\n', "%0A"}};
  std::string result;
  for (const char byte : text) {
    const auto escape = escapes.find(byte);
    if (escape != escapes.end()) {
      result += escape->second;
    } else if (property && (byte == ':' || byte == ',')) {
      result += byte == ':' ? "%3A" : "%2C";
    } else {
      result += byte;
    }
  }
  return result;
}

// FNV-1a, which is the same everywhere.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char byte : text) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
  }
  return hash;
}

}  // namespace

std::string diagnostics_for_github(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    text += diagnostic.severity == Severity::kError ? "::error " : "::warning ";
    if (const SourceRange& where = diagnostic.where) {
      const auto begin = where.file->position(where.begin);
      const auto end = where.file->position(where.end);
      text += fmt::format("file={},line={},endLine={},", escaped(from_here(where.file->path()), true), begin.line,
                          end.line);
      if (begin.line == end.line) {  // GitHub takes columns within one line only
        text += fmt::format("col={},endColumn={},", begin.column, end.column);
      }
    }
    text += fmt::format(
        "title={}::{}\n",
        escaped(fmt::format("{} {}", finding_id(diagnostic.finding), finding_info(diagnostic.finding).title), true),
        escaped(diagnostic.message + (diagnostic.help.empty() ? "" : "\n" + diagnostic.help), false));
  }
  return text;
}

std::string diagnostics_for_gitlab(const std::vector<Diagnostic>& diagnostics) {
  nlohmann::ordered_json report = nlohmann::ordered_json::array();
  std::map<std::string, std::size_t> counts;
  for (const Diagnostic& diagnostic : diagnostics) {
    const SourceRange& where = diagnostic.where;
    const std::string path = where ? from_here(where.file->path()) : ".";
    const std::string key = fmt::format("{}\n{}\n{}", path, finding_id(diagnostic.finding), diagnostic.message);
    report.push_back(
        {{"description", diagnostic.message + (diagnostic.help.empty() ? "" : " (" + diagnostic.help + ")")},
         {"check_name", finding_id(diagnostic.finding)},
         // Without the line, so that it stays the same finding when it moves.
         {"fingerprint", fmt::format("{:016x}", hash_of(fmt::format("{}\n{}", key, counts[key]++)))},
         {"severity", diagnostic.severity == Severity::kError ? "major" : "minor"},
         {"location", {{"path", path}, {"lines", {{"begin", where ? where.file->position(where.begin).line : 1}}}}}});
  }
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace launch
