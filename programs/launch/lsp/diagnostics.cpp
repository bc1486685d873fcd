// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
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

Json range_in(const SourceFile& file, const SourceRange& where) {
  return Document(file.text()).range(where.begin, where.end);
}

// The names that the help suggests: did you mean 'a' or 'b'?
std::vector<std::string> suggestions(const std::string& help) {
  std::vector<std::string> names;
  std::size_t at = help.find("did you mean '");
  const std::size_t stop = at == std::string::npos ? at : help.find('?', at);
  while (at < stop) {
    const std::size_t begin = help.find('\'', at) + 1;
    const std::size_t end = help.find('\'', begin);
    if (begin == 0 || begin > stop || end == std::string::npos) {
      break;
    }
    names.push_back(help.substr(begin, end - begin));
    at = end + 1;
  }
  return names;
}

}  // namespace

Json check_document(const Workspace& workspace, const Reading& reading) {
  set_unsaved_texts(workspace.texts());
  Json answer = Json::object();
  CheckOptions options;
  options.planned = [&](std::size_t processes) { answer["processes"] = processes; };
  std::vector<Diagnostic> found =
      check_launch_file(reading.path, workspace.registry(), workspace.environment(), options);
  Json list = Json::array();
  for (const Diagnostic& diagnostic : found) {
    // What is wrong in an included file is told at the include, and points into that file.
    SourceRange here = diagnostic.where;
    Json related = Json::array();
    while (here && here.file->path() != reading.path) {
      related.push_back({{"location", {{"uri", uri_of(here.file->path())}, {"range", range_in(*here.file, here)}}},
                         {"message", related.empty() ? diagnostic.message : "included from here"}});
      here = here.file->included_from();
    }
    Json item = {{"range", here ? range_in(*here.file, here) : reading.document.range(0, 0)},
                 {"severity", diagnostic.severity == Severity::kError ? kErrorSeverity : kWarningSeverity},
                 {"code", finding_id(diagnostic.finding)},
                 {"source", "launch"},
                 {"message", diagnostic.message + (diagnostic.help.empty() ? "" : "\n" + diagnostic.help)}};
    if (!related.empty()) {
      item["relatedInformation"] = std::move(related);
    } else if (here) {
      const std::string written = here.file->text().substr(here.begin, here.end - here.begin);
      const std::vector<std::string> names = suggestions(diagnostic.help);
      if (!written.empty() && !names.empty() && diagnostic.message.find("'" + written + "'") != std::string::npos) {
        item["data"] = names;
      }
    }
    list.push_back(std::move(item));
  }
  answer["diagnostics"] = std::move(list);
  return answer;
}

Json code_actions(const Reading& reading, const Json& diagnostics) {
  Json actions = Json::array();
  const std::string uri = uri_of(reading.path);
  for (const Json& diagnostic : diagnostics) {
    const Json names = diagnostic.value("data", Json::array());
    for (const Json& name : names.is_array() ? names : Json::array()) {
      const auto& text = name.get_ref<const std::string&>();
      actions.push_back(
          {{"title", fmt::format("Change to '{}'", text)},
           {"kind", "quickfix"},
           {"diagnostics", Json::array({diagnostic})},
           {"isPreferred", names.size() == 1},
           {"edit", {{"changes", {{uri, Json::array({{{"range", diagnostic.at("range")}, {"newText", text}}})}}}}}});
    }
  }
  return actions;
}

}  // namespace launch::lsp
