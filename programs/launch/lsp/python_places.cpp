// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "programs/launch/lsp/language.hpp"
#include "programs/launch/lsp/python_features.hpp"
#include "programs/launch/lsp/python_names.hpp"

namespace launch::lsp {

namespace {

namespace fs = std::filesystem;

// SymbolKind
constexpr int kFunctionSymbol = 12;
constexpr int kClassSymbolOfPython = 5;
constexpr int kVariableSymbolOfPython = 13;

Json place_in(const std::string& path, const Json& range) {
  return {{"uri", uri_of(path)}, {"range", range}};
}

Json beginning_of(const std::string& path) {
  const Json start = {{"line", 0}, {"character", 0}};
  return place_in(path, {{"start", start}, {"end", start}});
}

std::string regular(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) ? fs::weakly_canonical(path, ignored).string() : std::string();
}

// The dotted name that ends with the token.
std::string written_name(const PythonSource& source, std::string_view text, const PythonToken& token) {
  std::size_t first = static_cast<std::size_t>(&token - source.tokens.data());
  const std::size_t last = first;
  while (first >= 2 && text.substr(source.tokens[first - 1].span.begin, 1) == "." &&
         source.tokens[first - 2].kind == PythonToken::Kind::kName) {
    first -= 2;
  }
  return std::string(
      text.substr(source.tokens[first].span.begin, source.tokens[last].span.end - source.tokens[first].span.begin));
}

std::string signature_of(const std::string& name, const PythonName& known) {
  std::string arguments;
  for (const PythonNameArgument& argument : known.arguments) {
    arguments += (arguments.empty() ? "" : ", ") + argument.name + (argument.required ? "" : "=…");
  }
  return known.kind == "value" ? name : fmt::format("{}({})", name, arguments);
}

bool names_package(const PythonFileText& file, const PythonBrackets& call, const PythonToken& token) {
  const std::string name = file.short_name(call);
  const bool finds = name == "FindPackageShare" || name == "FindPackagePrefix" || name == "FindPackage" ||
                     name.starts_with("get_package_");
  const PythonArgument* const package = finds ? call.find("package", 0) : call.find("package");
  return package != nullptr && package->whole.holds(token.span.begin);
}

}  // namespace

Json describe_python(const Workspace& workspace, const Reading& reading, const Json& position) {
  const std::size_t offset = reading.document.offset(position);
  const std::string& text = reading.document.text();
  const PythonSource& source = reading.python;
  const PythonFileText file = python_file(workspace, reading);
  const PythonToken* const token = source.token_at(offset);
  if (token == nullptr) {
    return {};
  }
  const auto answer = [&](const std::string& markdown) {
    return Json{{"contents", {{"kind", "markdown"}, {"value", markdown}}},
                {"range", reading.document.range(token->span.begin, token->span.end)}};
  };
  if (const auto argument = argument_at(reading, workspace, offset);
      argument && argument->kind != ArgumentPlace::Kind::kGiven) {
    for (const DeclaredArgument& declared : python_arguments(file)) {
      if (declared.name == argument->name) {
        return answer(fmt::format(
            "argument **{}**{}{}", declared.name, declared.description.empty() ? "" : ": " + declared.description,
            declared.default_value ? fmt::format("\n\ndefault: `{}`", *declared.default_value) : "\n\nrequired"));
      }
    }
    return {};
  }
  if (token->kind == PythonToken::Kind::kName) {
    const std::string written = written_name(source, text, *token);
    std::string full = source.full_name(written);
    for (const PythonImport& import : source.imports) {
      full = import.name_span.begin == token->span.begin && !import.name.empty() ? import.module + "." + import.name
                                                                                 : full;
    }
    const PythonName* const known = PythonNames::of_installation().find(full);
    if (known == nullptr) {
      return {};
    }
    const auto tag = workspace.registry().types().find(known->tag);
    const std::string help = !known->help.empty()                        ? known->help
                             : tag == workspace.registry().types().end() ? std::string()
                                                                         : tag->second.help;
    return answer(fmt::format("```python\n{}\n```\n{}", signature_of(full.substr(full.rfind('.') + 1), *known), help));
  }
  const int number = source.brackets_at(token->span.begin);
  if (token->kind == PythonToken::Kind::kString && number >= 0 &&
      names_package(file, source.brackets[static_cast<std::size_t>(number)], *token)) {
    const std::string package(text.substr(token->content.begin, token->content.end - token->content.begin));
    const std::string share = workspace.share(package);
    return share.empty() ? Json() : answer(fmt::format("package **{}**: `{}`", package, share));
  }
  return {};
}

Json definition_in_python(const Workspace& workspace, const Reading& reading, const Json& position) {
  const std::size_t offset = reading.document.offset(position);
  const std::string& text = reading.document.text();
  const PythonSource& source = reading.python;
  const PythonFileText file = python_file(workspace, reading);
  const PythonToken* const token = source.token_at(offset);
  if (token == nullptr) {
    return {};
  }
  if (token->kind == PythonToken::Kind::kName) {
    const auto found = source.definitions.find(text.substr(token->span.begin, token->span.end - token->span.begin));
    return found == source.definitions.end()
               ? Json()
               : place_in(reading.path, reading.document.range(found->second.begin, found->second.end));
  }
  // The innermost call says what a text is, or else an outer one: os.path.join() in an include.
  for (int number = source.brackets_at(token->span.begin); number >= 0;) {
    const PythonBrackets& call = source.brackets[static_cast<std::size_t>(number)];
    if (token->kind == PythonToken::Kind::kString && names_package(file, call, *token)) {
      const std::string share =
          workspace.share(std::string(text.substr(token->content.begin, token->content.end - token->content.begin)));
      const std::string found = share.empty() ? "" : regular(fs::path(share) / "package.xml");
      return found.empty() ? Json() : beginning_of(found);
    }
    const PythonArgument* const executable = call.find("executable");
    if (executable != nullptr && executable->whole.holds(offset)) {
      const std::string program = regular(
          workspace.executable(file.value(call.find("package")).value_or(""), file.value(executable).value_or("")));
      return program.empty() ? Json() : beginning_of(program);
    }
    const std::string name = file.short_name(call);
    if (name == "IncludeLaunchDescription" || name.ends_with("LaunchDescriptionSource")) {
      const std::string included =
          regular(name == "IncludeLaunchDescription" ? fs::path(file.included(call))
                                                     : fs::path(reading.path).parent_path() /
                                                           file.value(call.find("launch_file_path", 0)).value_or(""));
      return included.empty() ? Json() : beginning_of(included);
    }
    if (call.parent < 0 || (call.callee.ends_with("join") && file.value(&call.arguments.front()))) {
      // A parameter file, or another one.
      for (const PythonArgument& argument : call.arguments) {
        if (argument.whole.holds(offset)) {
          const std::string whole = file.value(&argument).value_or("");
          const std::string found = whole.empty() ? "" : regular(fs::path(reading.path).parent_path() / whole);
          if (!found.empty()) {
            return beginning_of(found);
          }
        }
      }
    }
    number = call.parent;
  }
  return {};
}

namespace {

Json symbols_of_brackets(const Reading& reading, const PythonFileText& file, int parent) {
  Json list = Json::array();
  const PythonSource& source = reading.python;
  for (std::size_t i = 0; i < source.brackets.size(); ++i) {
    const PythonBrackets& call = source.brackets[i];
    if (call.parent != parent) {
      continue;
    }
    Json inner = symbols_of_brackets(reading, file, static_cast<int>(i));
    const PythonName* const known = PythonNames::of_installation().find(source.full_name(call.callee));
    if (known == nullptr || known->kind != "class") {
      list.insert(list.end(), inner.begin(), inner.end());
      continue;
    }
    std::string detail;
    for (const char* const keyword : {"name", "executable", "plugin", "package"}) {
      detail = detail.empty() ? file.value(call.find(keyword)).value_or("") : detail;
    }
    detail = detail.empty() && !call.arguments.empty() && file.literal(&call.arguments.front())
                 ? file.value(&call.arguments.front()).value_or("")
                 : detail;
    const std::string name = call.callee.substr(call.callee.rfind('.') + 1);
    list.push_back({{"name", detail.empty() ? name : name + " " + detail},
                    {"kind", name == "DeclareLaunchArgument" ? kVariableSymbolOfPython : kClassSymbolOfPython},
                    {"range", reading.document.range(call.callee_span.begin, call.inside.end + (call.closed ? 1 : 0))},
                    {"selectionRange", reading.document.range(call.callee_span.begin, call.callee_span.end)},
                    {"children", std::move(inner)}});
  }
  return list;
}

}  // namespace

Json python_symbols(const Workspace& workspace, const Reading& reading) {
  const PythonFileText file = python_file(workspace, reading);
  return symbols_of_brackets(reading, file, -1);
}

Json python_folds(const Reading& reading) {
  Json list = Json::array();
  for (const PythonBrackets& brackets : reading.python.brackets) {
    const Json first = reading.document.position(brackets.inside.begin).at("line");
    const Json last = reading.document.position(brackets.inside.end).at("line");
    if (brackets.closed && last > first && (list.empty() || list.back().at("startLine") != first)) {
      list.push_back({{"startLine", first}, {"endLine", last}});
    }
  }
  return list;
}

}  // namespace launch::lsp
