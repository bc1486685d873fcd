// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "base/diagnostics/read_source_file.hpp"
#include "programs/launch/check/check_launch_file.hpp"
#include "programs/launch/check/finding_table.hpp"
#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

namespace {

// DiagnosticSeverity
constexpr int kErrorSeverity = 1;
constexpr int kWarningSeverity = 2;

// The positions of ranges, with a document for each file.
class Ranges {
 public:
  Json in(const SourceRange& where) {
    const auto known = documents_.try_emplace(where.file.get(), where.file->text()).first;
    return known->second.range(where.begin, where.end);
  }

 private:
  std::map<const SourceFile*, Document> documents_;
};

}  // namespace

Json check_document(const Workspace& workspace, const Reading& reading) {
  set_unsaved_texts(workspace.texts());
  Json answer = Json::object();
  CheckOptions options;
  options.recorded_nodes = workspace.recorded();
  options.planned = [&](std::size_t processes) { answer["processes"] = processes; };
  workspace.forget_unknown_settings();
  std::vector<Diagnostic> found =
      check_launch_file(reading.path, workspace.registry(), workspace.environment(), options);
  if (workspace.has_unknown_settings()) {
    std::erase_if(found, [](const Diagnostic& diagnostic) { return diagnostic.finding == Finding::kUndefined; });
  }
  Json list = Json::array();
  Ranges ranges;
  for (const Diagnostic& diagnostic : found) {
    // What is wrong in an included file is told at the include, and points into that file.
    SourceRange here = diagnostic.where;
    Json related = Json::array();
    while (here && here.file->path() != reading.path) {
      related.push_back({{"location", {{"uri", uri_of(here.file->path())}, {"range", ranges.in(here)}}},
                         {"message", related.empty() ? diagnostic.message : "included from here"}});
      here = here.file->included_from();
    }
    Json item = {{"range", here ? ranges.in(here) : reading.document.range(0, 0)},
                 {"severity", diagnostic.severity == Severity::kError ? kErrorSeverity : kWarningSeverity},
                 {"code", finding_id(diagnostic.finding)},
                 {"source", "launch"},
                 {"message", diagnostic.message + (diagnostic.help.empty() ? "" : "\n" + diagnostic.help)}};
    if (!related.empty()) {
      item["relatedInformation"] = std::move(related);
    } else if (here) {
      // The name that a section of a parameter file should have is no name of this file.
      const std::vector<std::string> names = suggested_names(diagnostic.help);
      if (!names.empty() && diagnostic.finding != Finding::kUnmatchedParameterFile) {
        item["data"] = names;
      }
    }
    list.push_back(std::move(item));
  }
  answer["diagnostics"] = std::move(list);
  return answer;
}

}  // namespace launch::lsp
