// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "launcher/invocation/find_launch_file.hpp"
#include "programs/launch/lsp/completion_item.hpp"
#include "programs/launch/lsp/language.hpp"
#include "programs/launch/lsp/python_features.hpp"
#include "programs/launch/lsp/python_names.hpp"

namespace launch::lsp {

namespace {

namespace fs = std::filesystem;

class PythonCompletion {
 public:
  PythonCompletion(const Workspace& workspace, const Reading& reading, std::size_t offset)
      : workspace_(workspace),
        reading_(reading),
        offset_(offset),
        text_(reading.document.text()),
        source_(reading.python),
        file_(python_file(workspace, reading)) {}

  Json items() {
    const PythonToken* const token = source_.token_at(offset_);
    if (token != nullptr && token->kind == PythonToken::Kind::kString) {
      if (token->content.holds(offset_)) {
        text_value(*token);
      }
    } else if (!in_comment() && !in_import()) {
      name();
    }
    return {{"isIncomplete", false}, {"items", std::move(items_)}};
  }

 private:
  Json& add(const std::string& label, int kind, std::size_t begin, const std::string& documentation = {},
            const std::string& insert = {}) {
    items_.push_back(completion_item(reading_, {begin, offset_}, label, kind, documentation, insert));
    return items_.back();
  }

  static int kind_of(const PythonName& name) {
    return name.kind == "class" ? kClassItem : name.kind == "function" ? kFunctionItem : kVariableItem;
  }

  // Its own help, or that of the tag which means the same.
  std::string help_of(const PythonName& name) const {
    const auto found = workspace_.registry().types().find(name.tag);
    return !name.help.empty() || found == workspace_.registry().types().end() ? name.help : found->second.help;
  }

  std::size_t line_begin() const { return offset_ == 0 ? 0 : text_.rfind('\n', offset_ - 1) + 1; }

  bool in_comment() const {
    const std::size_t sharp = text_.find('#', line_begin());
    return sharp < offset_ && source_.token_at(sharp) == nullptr;
  }

  // Where the dotted word before the cursor begins.
  std::size_t word_begin(bool with_dots) const {
    std::size_t begin = offset_;
    while (begin > 0 && (std::isalnum(static_cast<unsigned char>(text_[begin - 1])) != 0 || text_[begin - 1] == '_' ||
                         (with_dots && text_[begin - 1] == '.'))) {
      --begin;
    }
    return begin;
  }

  // `from launch.actions import Node, …` and `import launch.…`
  bool in_import() {
    const std::string_view line = std::string_view(text_).substr(line_begin(), offset_ - line_begin());
    const std::size_t word = std::min(line.find_first_not_of(' '), line.size());
    const std::string_view begun = line.substr(word);
    if (begun.starts_with("import ") || (begun.starts_with("from ") && begun.find(" import") == begun.npos)) {
      modules();
      return true;
    }
    for (const PythonImport& import : source_.imports) {
      const std::size_t end = std::min(text_.find('\n', import.module_span.end), text_.size());
      const std::size_t bracket = text_.find('(', import.module_span.end);
      const std::size_t close = bracket < end ? std::min(text_.find(')', bracket), text_.size()) : end;
      if (import.module_span.end < offset_ && offset_ <= close && import.module_span.end > 0) {
        names_of(import.module, word_begin(false));
        return true;
      }
    }
    return false;
  }

  void modules() {
    for (const auto& [module, names] : PythonNames::of_installation().modules()) {
      add(module, kModuleItem, word_begin(true));
    }
  }

  void names_of(const std::string& module, std::size_t begin) {
    const auto* const names = PythonNames::of_installation().module(module);
    for (const auto& [name, known] : names == nullptr ? PythonNames::Module() : *names) {
      add(name, kind_of(known), begin, help_of(known));
    }
  }

  void name() {
    const std::size_t dotted = word_begin(true);
    const std::string before = text_.substr(dotted, word_begin(false) - dotted);
    if (before.size() > 1) {  // "actions."
      const std::string written = before.substr(0, before.size() - 1);
      const std::string full = source_.full_name(written);
      names_of(full.empty() ? written : full, word_begin(false));
      return;
    }
    arguments();
    names();
  }

  // The arguments of the call around the cursor, where one begins.
  void arguments() {
    const int number = source_.brackets_at(offset_);
    const PythonBrackets* const call = number < 0 ? nullptr : &source_.brackets[static_cast<std::size_t>(number)];
    const PythonName* const known =
        call == nullptr ? nullptr : PythonNames::of_installation().find(source_.full_name(call->callee));
    if (known == nullptr) {
      return;
    }
    const std::size_t begin = word_begin(false);
    const std::string_view before = std::string_view(text_).substr(call->inside.begin, begin - call->inside.begin);
    const std::size_t last = before.find_last_not_of(" \t\r\n");
    if (last != std::string_view::npos && before[last] != ',') {
      return;
    }
    for (const PythonNameArgument& argument : known->arguments) {
      const PythonArgument* const given = call->find(argument.name);
      if (given == nullptr || given->whole.holds(offset_)) {
        Json& item = add(argument.name + "=", kPropertyItem, begin, argument_help(known->tag, argument.name));
        item["sortText"] = (argument.required ? "0" : "1") + argument.name;
      }
    }
  }

  std::string argument_help(const std::string& tag, const std::string& argument) const {
    const auto type = workspace_.registry().types().find(tag);
    if (type == workspace_.registry().types().end()) {
      return {};
    }
    const std::map<std::string, std::string> others = {
        {"package", "pkg"},           {"executable", "exec"}, {"arguments", "args"},      {"ros_arguments", "ros_args"},
        {"default_value", "default"}, {"condition", "if"},    {"prefix", "launch-prefix"}};
    const auto other = others.find(argument);
    const AttributeSpec* const attribute =
        find_attribute(type->second.attributes, other == others.end() ? argument : other->second);
    return attribute == nullptr ? std::string() : attribute->help;
  }

  // Names of the file, and all classes; those that are not imported bring their import along.
  void names() {
    const std::size_t begin = word_begin(false);
    const PythonNames& table = PythonNames::of_installation();
    std::set<std::string> seen;
    for (const PythonImport& import : source_.imports) {
      const PythonNames::Module* const all = import.name == "*" ? table.module(import.module) : nullptr;
      for (const auto& [name, known] : all == nullptr ? PythonNames::Module() : *all) {
        if (seen.insert(name).second) {
          add(name, kind_of(known), begin, help_of(known));
        }
      }
      if (import.name != "*" && !import.as.empty() && seen.insert(import.as).second) {
        const PythonName* const known = table.find(import.module + "." + import.name);
        add(import.as, known == nullptr ? kModuleItem : kind_of(*known), begin,
            known == nullptr ? "" : help_of(*known));
      }
    }
    for (const auto& [name, span] : source_.definitions) {
      if (!span.holds(offset_) && seen.insert(name).second) {
        add(name, kVariableItem, begin);
      }
    }
    if (begin == offset_) {
      return;  // nothing is written yet: all classes would be noise
    }
    for (const auto& [module, names] : table.modules()) {
      for (const auto& [name, known] : names) {
        const std::vector<std::string> homes =
            known.kind == "class" ? table.homes_of(name) : std::vector<std::string>();
        if (homes.empty() || homes.front() != module || !seen.insert(name).second) {
          continue;
        }
        Json& item = add(name, kClassItem, begin, help_of(known));
        item["detail"] = "from " + module;
        item["sortText"] = "2" + name;
        item["additionalTextEdits"] = Json::array({import_edit(module, name)});
      }
    }
  }

  // Behind the last import, or at the beginning.
  Json import_edit(const std::string& module, const std::string& name) const {
    std::size_t at = 0;
    for (const PythonImport& import : source_.imports) {
      const bool in_brackets =
          text_.compare(std::min(text_.find_first_not_of(" \n\\", import.module_span.end + 8), text_.size()), 1, "(") ==
          0;
      const std::size_t end = in_brackets ? text_.find(')', import.module_span.end) : import.module_span.end;
      at = std::max(at, std::min(text_.find('\n', end), text_.size() - 1) + 1);
    }
    return {{"range", reading_.document.range(at, at)}, {"newText", fmt::format("from {} import {}\n", module, name)}};
  }

  // In the quotes of a literal.
  void text_value(const PythonToken& token) {
    const int number = source_.brackets_at(token.span.begin);
    if (number < 0) {
      return;
    }
    const std::size_t begin = token.content.begin;
    const PythonBrackets& around = source_.brackets[static_cast<std::size_t>(number)];
    const auto argument =
        std::find_if(around.arguments.begin(), around.arguments.end(), [&](const PythonArgument& one) {
          return one.whole.begin <= token.span.begin && token.span.end <= one.whole.end;
        });
    if (argument == around.arguments.end()) {
      return;
    }
    const std::string name = file_.short_name(around);
    const auto is = [&](std::string_view keyword, std::size_t place) {
      return argument->keyword == keyword ||
             (argument->keyword.empty() && argument - around.arguments.begin() == static_cast<std::ptrdiff_t>(place));
    };
    const auto add_all = [&](const std::vector<std::string>& names, int kind) {
      for (const std::string& one : names) {
        add(one, kind, begin);
      }
    };
    const bool finds_package = name == "FindPackageShare" || name == "FindPackagePrefix" || name == "FindPackage" ||
                               name == "get_package_share_directory" || name == "get_package_share_path" ||
                               name == "get_package_prefix";
    if (argument->keyword == "package" || (finds_package && is("package", 0)) ||
        (name == "ExecutableInPackage" && argument - around.arguments.begin() == 1)) {
      add_all(workspace_.packages(), kModuleItem);
    } else if (argument->keyword == "executable") {
      add_all(workspace_.executables(file_.value(around.find("package")).value_or("")), kFileItem);
    } else if (argument->keyword == "plugin") {
      add_all(workspace_.components(), kClassItem);
    } else if (argument->keyword == "output") {
      add_all({"screen", "log", "both", "own_log", "full"}, kValueItem);
    } else if (name == "LaunchConfiguration" || name == "LaunchConfigurationEquals" ||
               name == "LaunchConfigurationNotEquals") {
      configurations(begin);
    } else if (name == "EnvironmentVariable" && is("name", 0)) {
      for (const auto& [variable, content] : workspace_.environment()) {
        add(variable, kVariableItem, begin);
      }
    } else if (!arguments_of_include(number, *argument, token)) {
      part_of_path(around, *argument, token);
    }
  }

  void configurations(std::size_t begin) {
    std::set<std::string> names;
    for (const ArgumentPlace& place : python_argument_places(file_)) {
      if (place.kind == ArgumentPlace::Kind::kDeclared) {
        names.insert(place.name);
      }
    }
    for (const std::string& name : names) {
      add(name, kVariableItem, begin);
    }
  }

  // A key in launch_arguments={…}, or the first of a pair there; or the value behind it.
  bool arguments_of_include(int number, const PythonArgument& argument, const PythonToken& token) {
    const PythonBrackets& around = source_.brackets[static_cast<std::size_t>(number)];
    const bool is_tuple = around.open == '(' && around.callee.empty();
    if (around.open != '{' && !is_tuple) {
      return false;
    }
    for (int outer = around.parent; outer >= 0; outer = source_.brackets[static_cast<std::size_t>(outer)].parent) {
      const PythonBrackets& call = source_.brackets[static_cast<std::size_t>(outer)];
      const PythonArgument* const given =
          file_.short_name(call) == "IncludeLaunchDescription" ? call.find("launch_arguments", 1) : nullptr;
      if (given == nullptr || !given->whole.holds(offset_)) {
        continue;
      }
      const PythonArgument& pair = is_tuple ? around.arguments.front() : argument;
      const PythonToken& key = source_.tokens[pair.first];
      const std::string_view name =
          std::string_view(text_).substr(key.content.begin, key.content.end - key.content.begin);
      for (const DeclaredArgument& known : workspace_.arguments_of(file_.included(call))) {
        if (key.span.begin == token.span.begin) {
          Json& item = add(known.name, kVariableItem, token.content.begin, known.description);
          item["detail"] = known.default_value ? "default: " + *known.default_value : "required";
        } else if (known.name == name) {
          for (const std::string& choice : known.choices) {
            add(choice, kValueItem, token.content.begin);
          }
        }
      }
      return true;
    }
    return false;
  }

  // A part of os.path.join(…) or PathJoinSubstitution([…]): what is in the folder that the parts before it name.
  void part_of_path(const PythonBrackets& around, const PythonArgument& argument, const PythonToken& token) {
    const std::size_t place = static_cast<std::size_t>(&argument - around.arguments.data());
    std::string folder;
    for (std::size_t i = 0; i < place; ++i) {
      const std::optional<std::string> part = file_.value(&around.arguments[i]);
      if (!part) {
        return;
      }
      folder += (folder.empty() ? "" : "/") + *part;
    }
    const std::string_view written = std::string_view(text_).substr(token.content.begin, offset_ - token.content.begin);
    const std::size_t slash = written.rfind('/');
    const std::string inner(slash == std::string_view::npos ? "" : written.substr(0, slash));
    if (!folder.starts_with('/')) {
      return;
    }
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder + "/" + inner, unreadable)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with('.')) {
        add(name, entry.is_directory(unreadable) ? kModuleItem : kFileItem,
            token.content.begin + (slash == std::string_view::npos ? 0 : slash + 1));
      }
    }
  }

  const Workspace& workspace_;
  const Reading& reading_;
  std::size_t offset_;
  const std::string& text_;
  const PythonSource& source_;
  PythonFileText file_;
  Json items_ = Json::array();
};

}  // namespace

Json complete_python(const Workspace& workspace, const Reading& reading, const Json& position) {
  return PythonCompletion(workspace, reading, reading.document.offset(position)).items();
}

}  // namespace launch::lsp
