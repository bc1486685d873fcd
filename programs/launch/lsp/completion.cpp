// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "programs/launch/lsp/completion_item.hpp"
#include "programs/launch/lsp/features.hpp"
#include "programs/launch/lsp/language.hpp"

namespace launch::lsp {

namespace {

namespace fs = std::filesystem;

constexpr int kSnippet = 2;  // InsertTextFormat

class Completion {
 public:
  Completion(const Workspace& workspace, const Reading& reading, std::size_t offset)
      : workspace_(workspace), reading_(reading), offset_(offset), text_(reading.document.text()) {}

  Json items() {
    const int number = element_around();
    if (number >= 0) {
      in_element(number);
    } else {
      tags(-1, offset_);
    }
    return {{"isIncomplete", false}, {"items", std::move(items_)}};
  }

 private:
  const OutlineElement& element(int number) const {
    return reading_.outline.elements[static_cast<std::size_t>(number)];
  }

  // The last element whose head holds the place, or else the innermost one around it.
  int element_around() const {
    int found = -1;
    for (std::size_t i = 0; i < reading_.outline.elements.size(); ++i) {
      if (reading_.outline.elements[i].head.holds(offset_)) {
        found = static_cast<int>(i);
      }
    }
    return found >= 0 ? found : reading_.outline.element_at(offset_);
  }

  void in_element(int number) {
    const OutlineElement& at = element(number);
    if (at.tag_span.holds(offset_) && at.tag_span.begin != at.tag_span.end) {
      tags(at.parent, at.tag_span.begin);
      return;
    }
    if (!reading_.outline.yaml && at.tag_span.begin == offset_) {
      tags(at.parent, offset_);
      return;
    }
    for (const OutlineAttribute& attribute : at.attributes) {
      if (attribute.value && attribute.value->holds(offset_)) {
        value(number, attribute);
        return;
      }
      if (attribute.name_span.holds(offset_)) {
        attributes(number, attribute.name_span.begin);
        return;
      }
    }
    if (at.head.holds(offset_) || reading_.outline.yaml) {
      attributes(number, offset_);
    }
    if (!at.head.holds(offset_) && !reading_.outline.yaml) {
      tags(number, offset_);
    }
  }

  Json& add(const std::string& label, int kind, std::size_t begin, const std::string& documentation = {},
            const std::string& insert = {}) {
    items_.push_back(completion_item(reading_, {begin, offset_}, label, kind, documentation, insert));
    return items_.back();
  }

  void tags(int parent, std::size_t begin) {
    if (parent < 0) {
      add("launch", kClassItem, begin, "the root of a launch file");
      return;
    }
    const Declared around = declared(reading_.outline, parent, workspace_.registry());
    const bool in_tag = begin > 0 && text_[begin - 1] == '<';
    const std::string open = reading_.outline.yaml || in_tag ? "" : "<";
    const std::string close = reading_.outline.yaml && text_[std::min(offset_, text_.size() - 1)] != ':' ? ":" : "";
    std::set<std::string> seen;
    for (const ItemSpec& item : around.items()) {
      seen.insert(item.tag);
      add(item.tag, kClassItem, begin, item.help, open + item.tag + close);
    }
    if (around.holds_actions()) {
      for (const auto& [tag, type] : workspace_.registry().types()) {
        if (!seen.contains(tag)) {
          add(tag, kClassItem, begin, type.help + (type.extension ? " (Not known to ros2 launch.)" : ""),
              open + tag + close);
        }
      }
    }
  }

  void attributes(int number, std::size_t begin) {
    const OutlineElement& of = element(number);
    const Declared what = declared(reading_.outline, number, workspace_.registry());
    for (const AttributeSpec& attribute : what.attributes()) {
      const OutlineAttribute* const there = of.find(attribute.name);
      if (there != nullptr && there->name_span.begin != begin) {
        continue;
      }
      const bool has_value = there != nullptr && there->value;
      Json& item = add(attribute.name, kPropertyItem, begin, attribute.help,
                       has_value ? attribute.name : attribute.name + (reading_.outline.yaml ? ": " : "=\"$1\""));
      if (!has_value && !reading_.outline.yaml) {
        item["insertTextFormat"] = kSnippet;
      }
      item["sortText"] = (attribute.required ? "0" : "1") + attribute.name;
    }
    if (reading_.outline.yaml) {
      for (const ItemSpec& item : what.items()) {
        add(item.tag, kClassItem, begin, item.help, item.tag + ":");
      }
    }
  }

  void value(int number, const OutlineAttribute& attribute) {
    const std::string_view written =
        std::string_view(text_).substr(attribute.value->begin, offset_ - attribute.value->begin);
    if (const std::optional<OpenSubstitution> open = open_substitution(written)) {
      substitution(*open, attribute.value->begin + open->begin);
      return;
    }
    const OutlineElement& of = element(number);
    const Declared what = declared(reading_.outline, number, workspace_.registry());
    const std::vector<AttributeSpec> known = what.attributes();
    const AttributeSpec* const spec = find_attribute(known, attribute.name);
    const std::size_t begin = attribute.value->begin;
    const auto add_all = [&](const std::vector<std::string>& names, int kind) {
      for (const std::string& name : names) {
        add(name, kind, begin);
      }
    };
    if (spec != nullptr && spec->type == AttributeType::kBoolean) {
      add_all({"true", "false"}, kValueItem);
    }
    if (attribute.name == "pkg") {
      add_all(workspace_.packages(), kModuleItem);
    } else if (attribute.name == "exec") {
      add_all(workspace_.executables(performed(value_of(of, "pkg", text_))), kFileItem);
    } else if (attribute.name == "plugin") {
      add_all(workspace_.components(), kClassItem);
    } else if (attribute.name == "file" && of.tag == "include") {
      files(written, begin);
    } else if (attribute.name == "name" && (of.tag == "arg" || of.tag == "let") && of.parent >= 0 &&
               element(of.parent).tag == "include") {
      arguments_of_include(element(of.parent), begin);
    } else if (attribute.name == "value" && of.tag == "arg" && of.parent >= 0 && element(of.parent).tag == "include") {
      for (const Workspace::Argument& argument : arguments_of(element(of.parent))) {
        add_all(argument.name == value_of(of, "name", text_) ? argument.choices : std::vector<std::string>{},
                kValueItem);
      }
    } else if (attribute.name == "node" || attribute.name == "target" || attribute.name == "topic" ||
               (of.tag == "remap" && (attribute.name == "from" || attribute.name == "to"))) {
      recorded_names(attribute.name == "node" || attribute.name == "target", begin);
    } else if (spec != nullptr) {
      words_of_help(spec->help, begin);
    }
    if (spec != nullptr && spec->type != AttributeType::kLiteral && written.ends_with('$')) {
      for (const SubstitutionType& type : substitution_types()) {
        add(type.usage, kFunctionItem, offset_ - 1, type.help, "$(" + type.name);
      }
    }
  }

  // Of nodes, or of their topics and services, in the recorded run.
  void recorded_names(bool of_nodes, std::size_t begin) {
    std::set<std::string> names;
    for (const RecordedNode& node : workspace_.recorded()) {
      if (of_nodes) {
        names.insert(node.name);
      } else {
        names.insert(node.names.begin(), node.names.end());
      }
    }
    for (const std::string& name : names) {
      add(name, kValueItem, begin);
    }
  }

  std::string performed(std::string_view text) const {
    return workspace_.performed(reading_.path, reading_.outline, text).value_or(std::string());
  }

  // Help that begins with the values: "debug, info or error".
  void words_of_help(const std::string& help, std::size_t begin) {
    static const std::regex list("^([a-z0-9_-]+)((?:, [a-z0-9_-]+)*) or ([a-z0-9_-]+)(?:[:;,.( ].*)?$");
    std::smatch match;
    if (!std::regex_match(help, match, list)) {
      return;
    }
    std::istringstream words(match.str(1) + match.str(2) + ", " + match.str(3));
    for (std::string word; std::getline(words >> std::ws, word, ',');) {
      add(word, kValueItem, begin);
    }
  }

  void files(std::string_view written, std::size_t begin) {
    const std::size_t slash = written.rfind('/');
    const std::string folder = slash == std::string_view::npos ? fs::path(reading_.path).parent_path().string()
                                                               : performed(written.substr(0, slash));
    const std::size_t at = slash == std::string_view::npos ? begin : begin + slash + 1;
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "/" : folder, unreadable)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with('.')) {
        continue;
      }
      const bool here = slash == std::string_view::npos;
      if (entry.is_directory(unreadable)) {
        add(name + "/", kFolderItem, at, {}, here ? "$(dirname)/" + name + "/" : name + "/");
      } else if (is_launch_file(entry.path())) {
        add(name, kFileItem, at, {}, here ? "$(dirname)/" + name : name);
      }
    }
  }

  std::vector<Workspace::Argument> arguments_of(const OutlineElement& include) const {
    return workspace_.arguments_of(
        (fs::path(reading_.path).parent_path() / performed(value_of(include, "file", text_))).string());
  }

  void arguments_of_include(const OutlineElement& include, std::size_t begin) {
    for (const Workspace::Argument& argument : arguments_of(include)) {
      Json& item = add(argument.name, kVariableItem, begin, argument.description);
      item["detail"] = argument.default_value ? "default: " + *argument.default_value : "required";
    }
  }

  void substitution(const OpenSubstitution& open, std::size_t begin) {
    if (open.in_name) {
      for (const SubstitutionType& type : substitution_types()) {
        add(type.name, kFunctionItem, begin, type.usage + ": " + type.help);
      }
      return;
    }
    const std::size_t place = open.arguments.size();
    if (open.name == "var" && place == 1) {
      std::set<std::string> names;
      for (const OutlineElement& one : reading_.outline.elements) {
        const bool given = one.parent >= 0 && element(one.parent).tag == "include";
        if ((one.tag == "arg" || one.tag == "let") && !given) {
          names.emplace(value_of(one, "name", text_));
        }
      }
      names.erase("");
      for (const std::string& name : names) {
        add(name, kVariableItem, begin);
      }
    } else if (open.name == "env" || open.name == "optenv") {
      for (const auto& [name, content] : workspace_.environment()) {
        if (place == 1) {
          add(name, kVariableItem, begin);
        }
      }
    } else if ((open.name == "find-pkg-share" || open.name == "find-pkg-prefix") && place == 1) {
      for (const std::string& name : workspace_.packages()) {
        add(name, kModuleItem, begin);
      }
    } else if (open.name == "exec-in-pkg") {
      for (const std::string& name : place == 2 ? workspace_.packages() : std::vector<std::string>{}) {
        add(name, kModuleItem, begin);
      }
    }
  }

  const Workspace& workspace_;
  const Reading& reading_;
  std::size_t offset_;
  const std::string& text_;
  Json items_ = Json::array();
};

}  // namespace

Json complete(const Workspace& workspace, const Reading& reading, const Json& position) {
  return Completion(workspace, reading, reading.document.offset(position)).items();
}

}  // namespace launch::lsp
