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

// The place that an editor asks for. `token` is null where nothing stands.
struct AskedPlace {
  AskedPlace(const Workspace& workspace, const Reading& reading, const Json& position)
      : offset(reading.document.offset(position)),
        file(python_file(workspace, reading)),
        token(reading.python.token_at(offset)) {}

  std::size_t offset;
  PythonFileText file;
  const PythonToken* token;
};

// The text of a literal.
std::string content(std::string_view text, const PythonToken& token) {
  return std::string(text.substr(token.content.begin, token.content.end - token.content.begin));
}

}  // namespace

Json describe_python(const Workspace& workspace, const Reading& reading, const Json& position) {
  const AskedPlace asked(workspace, reading, position);
  const PythonFileText& file = asked.file;
  const PythonToken* const token = asked.token;
  if (token == nullptr) {
    return {};
  }
  const std::string& text = reading.document.text();
  const PythonSource& source = reading.python;
  const auto answer = [&](const std::string& markdown) {
    return Json{{"contents", {{"kind", "markdown"}, {"value", markdown}}},
                {"range", reading.document.range(token->span.begin, token->span.end)}};
  };
  if (const auto argument = argument_at(reading, workspace, asked.offset);
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
    const std::string package = content(text, *token);
    const std::string share = workspace.share(package);
    return share.empty() ? Json() : answer(fmt::format("package **{}**: `{}`", package, share));
  }
  return {};
}

Json definition_in_python(const Workspace& workspace, const Reading& reading, const Json& position) {
  const AskedPlace asked(workspace, reading, position);
  const PythonFileText& file = asked.file;
  const PythonToken* const token = asked.token;
  if (token == nullptr) {
    return {};
  }
  const std::string& text = reading.document.text();
  const PythonSource& source = reading.python;
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
      const std::string share = workspace.share(content(text, *token));
      const std::string found = share.empty() ? "" : regular(fs::path(share) / "package.xml");
      return found.empty() ? Json() : beginning_of(found);
    }
    const PythonArgument* const executable = call.find("executable");
    if (executable != nullptr && executable->whole.holds(asked.offset)) {
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
        if (argument.whole.holds(asked.offset)) {
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

class PythonOutline {
 public:
  PythonOutline(const Reading& reading, const PythonFileText& file)
      : reading_(reading), file_(file), inner_(reading.python.brackets.size() + 1) {
    for (std::size_t i = 0; i < reading.python.brackets.size(); ++i) {
      inner_[static_cast<std::size_t>(reading.python.brackets[i].parent + 1)].push_back(i);
    }
  }

  // The classes in these brackets; -1: of the file.
  Json in(int parent) const {
    Json list = Json::array();
    for (const std::size_t number : inner_[static_cast<std::size_t>(parent + 1)]) {
      Json inner = in(static_cast<int>(number));
      const PythonBrackets& call = reading_.python.brackets[number];
      const PythonName* const known = PythonNames::of_installation().find(reading_.python.full_name(call.callee));
      if (known != nullptr && known->kind == "class") {
        list.push_back(symbol(call, std::move(inner)));
      } else {
        list.insert(list.end(), inner.begin(), inner.end());
      }
    }
    return list;
  }

 private:
  Json symbol(const PythonBrackets& call, Json inner) const {
    std::string detail;
    for (const char* const keyword : {"name", "executable", "plugin", "package"}) {
      detail = detail.empty() ? file_.value(call.find(keyword)).value_or("") : detail;
    }
    detail = detail.empty() && !call.arguments.empty() && file_.literal(&call.arguments.front())
                 ? file_.value(&call.arguments.front()).value_or("")
                 : detail;
    const std::string name = call.callee.substr(call.callee.rfind('.') + 1);
    const Document& document = reading_.document;
    return {{"name", detail.empty() ? name : name + " " + detail},
            {"kind", name == "DeclareLaunchArgument" ? kVariableSymbolOfPython : kClassSymbolOfPython},
            {"range", document.range(call.callee_span.begin, call.inside.end + (call.closed ? 1 : 0))},
            {"selectionRange", document.range(call.callee_span.begin, call.callee_span.end)},
            {"children", std::move(inner)}};
  }

  const Reading& reading_;
  const PythonFileText& file_;
  std::vector<std::vector<std::size_t>> inner_;  // brackets in brackets; the first ones are those of the file
};

}  // namespace

Json python_symbols(const Workspace& workspace, const Reading& reading) {
  const PythonFileText file = python_file(workspace, reading);
  return PythonOutline(reading, file).in(-1);
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
