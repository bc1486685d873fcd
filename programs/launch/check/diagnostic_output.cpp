// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/check/diagnostic_output.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "programs/launch/check/finding_table.hpp"

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kShownOfAKind = 100;

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string diagnostics_as_json(const std::vector<Diagnostic>& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    Json item;
    item["id"] = finding_id(diagnostic.finding);
    item["severity"] = diagnostic.severity == Severity::kError ? "error" : "warning";
    item["message"] = diagnostic.message;
    item["help"] = diagnostic.help;
    const SourceRange& where = diagnostic.where;
    if (where) {
      const auto begin = where.file->position(where.begin);
      const auto end = where.file->position(where.end);
      item["file"] = where.file->path();
      item["line"] = begin.line;
      item["column"] = begin.column;
      item["end_line"] = end.line;
      item["end_column"] = end.column;
    } else {
      for (const char* const key : {"file", "line", "column", "end_line", "end_column"}) {
        item[key] = nullptr;
      }
    }
    item["included_from"] = Json::array();
    for (SourceRange from = where ? where.file->included_from() : SourceRange{}; from;
         from = from.file->included_from()) {
      item["included_from"].push_back(place_with_path(from));
    }
    list.push_back(std::move(item));
  }
  return dump(list);
}

std::string diagnostics_as_text(const std::vector<Diagnostic>& diagnostics, bool colour) {
  std::string text;
  std::map<Finding, std::size_t> counts;
  for (Diagnostic diagnostic : diagnostics) {
    if (++counts[diagnostic.finding] <= kShownOfAKind) {
      diagnostic.message += fmt::format(" [{}]", finding_id(diagnostic.finding));
      text += render(diagnostic, colour);
    }
  }
  for (const auto& [finding, count] : counts) {
    if (count > kShownOfAKind) {
      text += fmt::format("{} more of {} ({}), --format json shows all\n", count - kShownOfAKind, finding_id(finding),
                          finding_info(finding).title);
    }
  }
  return text;
}

std::string diagnostics_as_sarif(const std::vector<Diagnostic>& diagnostics) {
  Json results = Json::array();
  std::set<Finding> rules;
  for (const Diagnostic& diagnostic : diagnostics) {
    Json result;
    result["ruleId"] = finding_id(diagnostic.finding);
    rules.insert(diagnostic.finding);
    result["level"] = diagnostic.severity == Severity::kError ? "error" : "warning";
    const std::string help = diagnostic.help.empty() ? "" : " (" + diagnostic.help + ")";
    result["message"]["text"] = diagnostic.message + help;
    const auto place = [](const SourceRange& where) {
      const auto begin = where.file->position(where.begin);
      const auto end = where.file->position(where.end);
      Json physical;
      physical["artifactLocation"]["uri"] = "file://" + where.file->path();
      physical["region"] = {
          {"startLine", begin.line}, {"startColumn", begin.column}, {"endLine", end.line}, {"endColumn", end.column}};
      return physical;
    };
    if (diagnostic.where) {
      result["locations"] = Json::array({{{"physicalLocation", place(diagnostic.where)}}});
      Json related = Json::array();
      for (SourceRange from = diagnostic.where.file->included_from(); from; from = from.file->included_from()) {
        related.push_back({{"physicalLocation", place(from)}, {"message", {{"text", "included from here"}}}});
      }
      if (!related.empty()) {
        result["relatedLocations"] = std::move(related);
      }
    }
    results.push_back(std::move(result));
  }
  Json run;
  run["tool"]["driver"] = {{"name", "launch check"}, {"version", LAUNCH_VERSION}, {"rules", Json::array()}};
  for (const Finding finding : rules) {
    const FindingInfo& info = finding_info(finding);
    run["tool"]["driver"]["rules"].push_back({{"id", finding_id(finding)},
                                              {"shortDescription", {{"text", info.title}}},
                                              {"fullDescription", {{"text", info.explanation}}}});
  }
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = std::move(results);
  Json root;
  root["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  root["version"] = "2.1.0";
  root["runs"] = Json::array({std::move(run)});
  return dump(root);
}

}  // namespace launch
