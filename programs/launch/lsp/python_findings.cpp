// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/finding.hpp"
#include "launcher/python/interpreter/python_module.hpp"
#include "programs/launch/check/finding_table.hpp"
#include "programs/launch/lsp/python_features.hpp"
#include "programs/launch/lsp/python_names.hpp"

namespace launch::lsp {

namespace {

class PythonFindings {
 public:
  PythonFindings(const Workspace& workspace, const Reading& reading)
      : workspace_(workspace), reading_(reading), file_(python_file(workspace, reading)) {}

  Json find() {
    check_syntax();
    for (const PythonImport& import : reading_.python.imports) {
      check_import(import);
    }
    for (const PythonBrackets& call : reading_.python.brackets) {
      check_arguments(call);
      check_package(call);
    }
    return std::move(found_);
  }

 private:
  void add(Span span, Finding finding, const std::string& message, const std::string& wrong,
           const std::vector<std::string>& right) {
    const std::string help = did_you_mean(wrong, right);
    Json item = {{"range", reading_.document.range(span.begin, span.end)},
                 {"severity", 1},
                 {"code", finding_id(finding)},
                 {"source", "launch"},
                 {"message", message + (help.empty() ? "" : "\n" + help)}};
    if (const std::vector<std::string> names = suggested_names(help); !names.empty()) {
      item["data"] = names;
    }
    found_.push_back(std::move(item));
  }

  // Python's own compiler finds it. It runs nothing of the file.
  void check_syntax() {
    const Document& document = reading_.document;
    if (const std::optional<python::SyntaxError> error = python_syntax_error(document.text())) {
      const std::size_t begin = document.offset_of_character(error->line, error->column);
      const std::size_t end = document.offset_of_character(error->last_line, error->last_column);
      add({begin, std::max(begin, end)}, Finding::kPython, error->message, {}, {});
    }
  }

  void check_import(const PythonImport& import) {
    const PythonNames& table = PythonNames::of_installation();
    const PythonNames::Module* const module = table.module(import.module);
    const bool is_module = table.module(import.module + "." + import.name) != nullptr;
    // A module that only half is in the table, as one that a package of the user extends, has names of its own.
    if (module == nullptr || module->empty() || import.name.empty() || import.name == "*" ||
        module->contains(import.name) || is_module) {
      return;
    }
    std::vector<std::string> names;
    for (const auto& [name, known] : *module) {
      names.push_back(name);
    }
    if (did_you_mean(import.name, names).empty()) {
      return;  // perhaps a name that only a newer release has
    }
    add(import.name_span, Finding::kPython, fmt::format("{} has no '{}'", import.module, import.name), import.name,
        names);
  }

  void check_arguments(const PythonBrackets& call) {
    if (call.callee.empty()) {
      return;
    }
    const PythonName* const known = PythonNames::of_installation().find(reading_.python.full_name(call.callee));
    if (known == nullptr || !known->complete || known->arguments.empty()) {
      return;
    }
    std::vector<std::string> names;
    for (const PythonNameArgument& argument : known->arguments) {
      names.push_back(argument.name);
    }
    for (const PythonArgument& argument : call.arguments) {
      if (!argument.keyword.empty() && std::find(names.begin(), names.end(), argument.keyword) == names.end()) {
        add(argument.keyword_span, Finding::kPython,
            fmt::format("{} has no argument '{}'", call.callee.substr(call.callee.rfind('.') + 1), argument.keyword),
            argument.keyword, names);
      }
    }
  }

  void check_package(const PythonBrackets& call) {
    const std::string name = file_.short_name(call);
    const bool finds =
        name == "FindPackageShare" || name == "FindPackagePrefix" || name == "get_package_share_directory";
    const bool has_package = name == "Node" || name == "LifecycleNode" || name == "ComposableNodeContainer";
    const std::optional<Span> span = file_.literal(finds         ? call.find("package", 0)
                                                   : has_package ? call.find("package")
                                                                 : nullptr);
    if (!span || call.find("condition") != nullptr) {
      return;
    }
    const std::string package = reading_.document.text().substr(span->begin, span->end - span->begin);
    if (!package.empty() && !is_package(package)) {
      add(*span, Finding::kMissingPackage, fmt::format("package '{}' was not found", package), package,
          workspace_.packages());
    }
  }

  bool is_package(const std::string& name) {
    const auto [known, is_new] = packages_.try_emplace(name, false);
    if (is_new) {
      known->second = !workspace_.share(name).empty();
    }
    return known->second;
  }

  const Workspace& workspace_;
  const Reading& reading_;
  PythonFileText file_;
  std::map<std::string, bool> packages_;  // whether there is one of this name
  Json found_ = Json::array();
};

}  // namespace

Json python_findings(const Workspace& workspace, const Reading& reading) {
  return PythonFindings(workspace, reading).find();
}

void prepare_python_findings() {
  static const bool is_prepared = [] {
    PythonNames::of_installation();
    python_syntax_error("");
    return true;
  }();
  static_cast<void>(is_prepared);
}

}  // namespace launch::lsp
