// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/diagnostic_output.hpp"

#include <nlohmann/json.hpp>

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string diagnostics_as_json(const std::vector<Diagnostic>& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    Json item;
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
      item["included_from"].push_back(to_string(from));
    }
    list.push_back(std::move(item));
  }
  return dump(list);
}

std::string diagnostics_as_sarif(const std::vector<Diagnostic>& diagnostics) {
  Json results = Json::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    Json result;
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
  run["tool"]["driver"] = {{"name", "launch check"}, {"version", LAUNCH_VERSION}};
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = std::move(results);
  Json root;
  root["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  root["version"] = "2.1.0";
  root["runs"] = Json::array({std::move(run)});
  return dump(root);
}

}  // namespace launch
