// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "programs/launch/lsp/argument_places.hpp"
#include "programs/launch/lsp/features.hpp"
#include "programs/launch/lsp/python_features.hpp"

namespace launch::lsp {

namespace {

namespace fs = std::filesystem;

Json location(const std::string& path, const Json& range) {
  return {{"uri", uri_of(path)}, {"range", range}};
}

Json beginning(const std::string& path) {
  const Json start = {{"line", 0}, {"character", 0}};
  return location(path, {{"start", start}, {"end", start}});
}

std::string existing(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) ? fs::weakly_canonical(path, ignored).string() : std::string();
}

// The declaration of an argument in a file; null when there is none.
Json declaration_in(const Workspace& workspace, const std::string& path, const std::string& name) {
  const std::optional<Document> document = workspace.document(path);
  if (!document) {
    return {};
  }
  for (const ArgumentPlace& place : argument_places(reading_of(path, *document), workspace)) {
    if (place.kind == ArgumentPlace::Kind::kDeclared && place.name == name) {
      return location(path, document->range(place.span.begin, place.span.end));
    }
  }
  return {};
}

// SymbolKind
constexpr int kModuleSymbol = 2;
constexpr int kClassSymbol = 5;
constexpr int kVariableSymbol = 13;
constexpr int kObjectSymbol = 19;
constexpr int kFileSymbol = 1;

int symbol_kind(const OutlineElement& element) {
  return element.tag == "arg" || element.tag == "let" ? kVariableSymbol
         : element.tag == "include"                   ? kFileSymbol
         : element.tag == "group"                     ? kModuleSymbol
         : element.tag == "launch"                    ? kClassSymbol
                                                      : kObjectSymbol;
}

std::string detail_of(const OutlineElement& element, std::string_view text) {
  for (const char* const attribute : {"name", "exec", "file", "cmd", "ns", "namespace", "from", "message"}) {
    if (const std::string_view value = value_of(element, attribute, text); !value.empty()) {
      return std::string(value);
    }
  }
  return {};
}

// The elements below each one; those of -1 are the outermost.
using Children = std::map<int, std::vector<std::size_t>>;

Json symbols_within(const Reading& reading, const Children& children, int parent) {
  Json list = Json::array();
  const auto found = children.find(parent);
  for (const std::size_t i : found == children.end() ? std::vector<std::size_t>() : found->second) {
    const OutlineElement& element = reading.outline.elements[i];
    const std::string detail = detail_of(element, reading.document.text());
    list.push_back(
        {{"name", detail.empty() ? element.tag : element.tag + " " + detail},
         {"kind", symbol_kind(element)},
         {"range", reading.document.range(std::min(element.whole.begin, element.tag_span.begin), element.whole.end)},
         {"selectionRange", reading.document.range(element.tag_span.begin, element.tag_span.end)},
         {"children", symbols_within(reading, children, static_cast<int>(i))}});
  }
  return list;
}

}  // namespace

Json definition(const Workspace& workspace, const Reading& reading, const Json& position) {
  const std::size_t offset = reading.document.offset(position);
  const std::string& text = reading.document.text();
  const auto performed = [&](std::string_view value) {
    return workspace.performed(reading.path, reading.outline, value).value_or(std::string());
  };
  const auto included = [&](const OutlineElement& include) {
    return existing(fs::path(reading.path).parent_path() / performed(value_of(include, "file", text)));
  };
  if (const auto argument = argument_at(reading, workspace, offset)) {
    const bool given = argument->kind == ArgumentPlace::Kind::kGiven;
    return declaration_in(workspace, given ? included_file(workspace, reading, argument->include) : reading.path,
                          argument->name);
  }
  if (is_python(reading.path)) {
    return definition_in_python(workspace, reading, position);
  }
  for (const OutlineElement& element : reading.outline.elements) {
    for (const OutlineAttribute& attribute : element.attributes) {
      if (!attribute.value || !attribute.value->holds(offset)) {
        continue;
      }
      std::string target;
      const std::string value = performed(value_of(element, attribute.name, text));
      if (attribute.name == "file" && element.tag == "include") {
        target = included(element);
      } else if (attribute.name == "pkg") {
        target = existing(fs::path(workspace.share(value)) / "package.xml");
      } else if (attribute.name == "exec" && element.find("pkg") != nullptr) {
        target = existing(workspace.executable(performed(value_of(element, "pkg", text)), value));
      } else if (!value.empty()) {
        target = existing(fs::path(reading.path).parent_path() / value);  // a parameter file, or another file
      }
      return target.empty() ? Json() : beginning(target);
    }
  }
  return {};
}

Json symbols(const Reading& reading) {
  Children children;
  for (std::size_t i = 0; i < reading.outline.elements.size(); ++i) {
    if (const OutlineElement& element = reading.outline.elements[i]; !element.tag.empty()) {
      children[element.parent].push_back(i);
    }
  }
  return symbols_within(reading, children, -1);
}

Json folds(const Reading& reading) {
  Json list = Json::array();
  for (const OutlineElement& element : reading.outline.elements) {
    const Json first = reading.document.position(element.tag_span.begin).at("line");
    const std::size_t end = element.whole.end > 0 && reading.outline.yaml ? element.whole.end - 1 : element.whole.end;
    const Json last = reading.document.position(end).at("line");
    if (last > first) {
      list.push_back({{"startLine", first}, {"endLine", last}});
    }
  }
  return list;
}

}  // namespace launch::lsp
