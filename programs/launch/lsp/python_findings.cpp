// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/finding.hpp"
#include "launcher/python/interpreter/python_module.hpp"
#include "programs/launch/check/finding_table.hpp"
#include "programs/launch/lsp/python_features.hpp"
#include "programs/launch/lsp/python_names.hpp"

namespace launch::lsp {

namespace {

constexpr const char* kParse = R"(
import ast, json
found = ''
try:
    ast.parse(text)
except SyntaxError as error:
    line, column = error.lineno or 1, error.offset or 1
    last, end = error.end_lineno or line, error.end_offset or column + 1
    end = end if (last, end) > (line, column) else column + 1
    place = lambda line, column: {'line': line - 1, 'character': max(column - 1, 0)}
    found = json.dumps({'message': type(error).__name__ + ': ' + error.msg,
                        'range': {'start': place(line, column), 'end': place(last, end)}})
except (ValueError, RecursionError, MemoryError) as error:
    zero = {'line': 0, 'character': 0}
    found = json.dumps({'message': type(error).__name__ + ': ' + str(error), 'range': {'start': zero, 'end': zero}})
)";

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

  // Python's own parser finds it. It runs nothing of the file.
  void check_syntax() {
    const Json text = reading_.document.text();
    const std::string expression =
        fmt::format("(lambda names: exec({}, names) or names['found'])({{'text': {}}})", Json(kParse).dump(),
                    text.dump(-1, ' ', false, Json::error_handler_t::replace));
    try {
      const Json error = Json::parse(evaluate_python(expression, "", {}), nullptr, false);
      if (error.is_object()) {
        found_.push_back({{"range", error.at("range")},
                          {"severity", 1},
                          {"code", finding_id(Finding::kPython)},
                          {"source", "launch"},
                          {"message", error.at("message")}});
      }
    } catch (const EvaluationError&) {
      // There is no Python here.
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
    const std::vector<std::string> known = packages();
    if (!package.empty() && std::find(known.begin(), known.end(), package) == known.end()) {
      add(*span, Finding::kMissingPackage, fmt::format("package '{}' was not found", package), package, known);
    }
  }

  const std::vector<std::string>& packages() {
    if (packages_.empty()) {
      packages_ = workspace_.packages();
    }
    return packages_;
  }

  const Workspace& workspace_;
  const Reading& reading_;
  PythonFileText file_;
  std::vector<std::string> packages_;
  Json found_ = Json::array();
};

}  // namespace

Json python_findings(const Workspace& workspace, const Reading& reading) {
  return PythonFindings(workspace, reading).find();
}

}  // namespace launch::lsp
