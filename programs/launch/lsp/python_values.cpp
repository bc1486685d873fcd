// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/python_values.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace launch::lsp {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 20;  // a variable can name itself

// Functions of Python that launch files use for paths.
constexpr std::array<std::string_view, 5> kPathFunctions = {"join", "dirname", "abspath", "realpath", "str"};

bool is_source(std::string_view name) {
  return name.ends_with("LaunchDescriptionSource");
}

std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escapes =
        text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == '\\' || text[i + 1] == '\'' || text[i + 1] == '"');
    plain += text[escapes ? ++i : i];
  }
  return plain;
}

}  // namespace

std::string PythonFileText::short_name(const PythonBrackets& call) const {
  if (call.callee.empty()) {
    return {};
  }
  const std::string full = source.full_name(call.callee);
  const bool is_known = full.starts_with("launch") || full.starts_with("ament_index_python.");
  return is_known ? full.substr(full.rfind('.') + 1) : std::string();
}

std::optional<Span> PythonFileText::literal(const PythonArgument* argument) const {
  if (argument == nullptr || argument->last != argument->first + 1 ||
      source.tokens[argument->first].kind != PythonToken::Kind::kString || source.tokens[argument->first].is_format) {
    return std::nullopt;
  }
  return source.tokens[argument->first].content;
}

std::optional<std::string> PythonFileText::value(const PythonArgument* argument, int depth) const {
  return argument == nullptr ? std::nullopt : value(argument->first, argument->last, depth);
}

std::optional<std::string> PythonFileText::value(std::size_t first, std::size_t last, int depth) const {
  std::string whole;
  bool expects_operand = true;
  std::string join;  // what stands between this operand and the one before
  if (depth > kDeepest || first >= last) {
    return std::nullopt;
  }
  for (std::size_t i = first; i < last; ++i) {
    const PythonToken& token = source.tokens[i];
    const std::string_view word = text.substr(token.span.begin, token.span.end - token.span.begin);
    if (token.kind == PythonToken::Kind::kLineEnd) {
      continue;
    }
    if (token.kind == PythonToken::Kind::kOperator && (word == "+" || word == "/")) {
      if (expects_operand) {
        return std::nullopt;
      }
      join = word == "/" ? "/" : "";
      expects_operand = true;
      continue;
    }
    if (!expects_operand && token.kind != PythonToken::Kind::kString) {
      return std::nullopt;  // a method, an index, another operator
    }
    std::optional<std::string> operand;
    if (token.kind == PythonToken::Kind::kString && !token.is_format) {
      operand = unescaped(text.substr(token.content.begin, token.content.end - token.content.begin));
    } else if (token.kind == PythonToken::Kind::kName) {
      std::size_t open = i;
      while (open + 1 < last && text.substr(source.tokens[open + 1].span.begin, 1) == "." &&
             source.tokens[open + 1].kind == PythonToken::Kind::kOperator) {
        open += 2;
      }
      const int call = open + 1 < last ? source.brackets_from(open + 1) : -1;
      if (call >= 0) {
        operand = value_of_call(source.brackets[static_cast<std::size_t>(call)], depth + 1);
        i = source.brackets[static_cast<std::size_t>(call)].last;
      } else if (word == "__file__") {
        operand = path;
      } else if (const auto known = source.values.find(std::string(word)); known != source.values.end()) {
        operand = value(known->second.first, known->second.second, depth + 1);
      }
    } else if (word == "[" || word == "(") {
      const int list = source.brackets_from(i);
      operand = list < 0 ? std::nullopt : joined(source.brackets[static_cast<std::size_t>(list)], "", depth + 1);
      i = list < 0 ? i : source.brackets[static_cast<std::size_t>(list)].last;
    }
    if (!operand) {
      return std::nullopt;
    }
    whole += join + *operand;
    join.clear();
    expects_operand = false;
  }
  return expects_operand ? std::nullopt : std::optional(whole);
}

std::optional<std::string> PythonFileText::joined(const PythonBrackets& brackets, std::string_view separator,
                                                  int depth) const {
  std::string whole;
  for (std::size_t i = 0; i < brackets.arguments.size(); ++i) {
    const std::optional<std::string> part = value(&brackets.arguments[i], depth);
    if (!part) {
      return std::nullopt;
    }
    const bool separates = i > 0 && !separator.empty() && !whole.ends_with(separator);
    whole += (separates ? std::string(separator) : std::string()) + *part;
  }
  return whole;
}

std::optional<std::string> PythonFileText::value_of_call(const PythonBrackets& call, int depth) const {
  const std::string name = short_name(call);
  const PythonArgument* const first = call.arguments.empty() ? nullptr : &call.arguments.front();
  if (name == "FindPackageShare" || name == "get_package_share_directory" || name == "get_package_share_path") {
    const std::optional<std::string> package = value(first, depth);
    std::string directory = package ? share(*package) : std::string();
    return directory.empty() ? std::nullopt : std::optional(std::move(directory));
  }
  if (name == "PathJoinSubstitution") {
    const bool is_list = first != nullptr && first->first < first->last && source.brackets_from(first->first) >= 0;
    return is_list ? joined(source.brackets[static_cast<std::size_t>(source.brackets_from(first->first))], "/", depth)
                   : std::nullopt;
  }
  if (name == "ThisLaunchFileDir") {
    return fs::path(path).parent_path().string();
  }
  if (name == "ThisLaunchFile") {
    return path;
  }
  if (name == "TextSubstitution") {
    return value(call.find("text", 0), depth);
  }
  if (is_source(name)) {
    return value(call.find("launch_file_path", 0), depth);
  }
  if (name == "LaunchConfiguration") {
    const std::optional<std::string> configuration = value(call.find("variable_name", 0), depth);
    for (const PythonBrackets& other : source.brackets) {
      const std::optional<Span> text_of_default = literal(other.find("default_value"));
      if (configuration && text_of_default && short_name(other) == "DeclareLaunchArgument" &&
          value(other.find("name", 0), kDeepest) == configuration) {
        return std::string(text.substr(text_of_default->begin, text_of_default->end - text_of_default->begin));
      }
    }
    return std::nullopt;
  }
  const std::string last = call.callee.substr(call.callee.rfind('.') + 1);
  if (!name.empty() || std::find(kPathFunctions.begin(), kPathFunctions.end(), last) == kPathFunctions.end()) {
    return std::nullopt;
  }
  if (last == "join") {
    return joined(call, "/", depth);
  }
  std::optional<std::string> given = value(first, depth);
  return given && last == "dirname" ? std::optional(fs::path(*given).parent_path().string()) : given;
}

std::string PythonFileText::included(const PythonBrackets& include) const {
  const std::optional<std::string> file = value(include.find("launch_description_source", 0));
  return file ? (fs::path(path).parent_path() / *file).lexically_normal().string() : std::string();
}

std::vector<ArgumentPlace> python_argument_places(const PythonFileText& file) {
  std::vector<ArgumentPlace> places;
  const auto add = [&](ArgumentPlace::Kind kind, const PythonArgument* argument, int include = -1) {
    if (const std::optional<Span> span = file.literal(argument)) {
      places.push_back({kind, std::string(file.text.substr(span->begin, span->end - span->begin)), *span, include});
    }
  };
  const std::vector<PythonBrackets>& all = file.source.brackets;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string name = file.short_name(all[i]);
    if (name == "DeclareLaunchArgument" || name == "DeclareBooleanLaunchArgument" || name == "SetLaunchConfiguration") {
      add(ArgumentPlace::Kind::kDeclared, all[i].find("name", 0));
    } else if (name == "LaunchConfiguration") {
      add(ArgumentPlace::Kind::kRead, all[i].find("variable_name", 0));
    } else if (name == "LaunchConfigurationEquals" || name == "LaunchConfigurationNotEquals") {
      add(ArgumentPlace::Kind::kRead, all[i].find("launch_configuration_name", 0));
    }
    // {'name': …}.items(), or [('name', …), …]
    const PythonArgument* const given =
        name == "IncludeLaunchDescription" ? all[i].find("launch_arguments", 1) : nullptr;
    const int pairs = given == nullptr || given->first >= given->last ? -1 : file.source.brackets_from(given->first);
    if (pairs < 0) {
      continue;
    }
    for (const PythonArgument& pair : all[static_cast<std::size_t>(pairs)].arguments) {
      if (pair.first >= pair.last) {
        continue;
      }
      if (all[static_cast<std::size_t>(pairs)].open == '{') {
        PythonArgument key = pair;
        key.last = key.first + 1;
        add(ArgumentPlace::Kind::kGiven, &key, static_cast<int>(i));
      } else if (const int tuple = file.source.brackets_from(pair.first); tuple >= 0) {
        add(ArgumentPlace::Kind::kGiven, &all[static_cast<std::size_t>(tuple)].arguments.front(), static_cast<int>(i));
      }
    }
  }
  return places;
}

std::vector<DeclaredArgument> python_arguments(const PythonFileText& file) {
  std::vector<DeclaredArgument> arguments;
  for (const PythonBrackets& call : file.source.brackets) {
    const std::string name = file.short_name(call);
    if (name != "DeclareLaunchArgument" && name != "DeclareBooleanLaunchArgument") {
      continue;
    }
    const std::optional<Span> span = file.literal(call.find("name", 0));
    if (!span) {
      continue;
    }
    DeclaredArgument argument;
    argument.name = file.text.substr(span->begin, span->end - span->begin);
    argument.description = file.value(call.find("description"), kDeepest).value_or("");
    const PythonArgument* const value = call.find("default_value");
    if (value != nullptr && value->first < value->last) {
      const Span written = file.literal(value).value_or(
          Span{file.source.tokens[value->first].span.begin, file.source.tokens[value->last - 1].span.end});
      argument.default_value = file.text.substr(written.begin, written.end - written.begin);
    }
    const PythonArgument* const choices = call.find("choices");
    const int list =
        choices == nullptr || choices->first >= choices->last ? -1 : file.source.brackets_from(choices->first);
    for (const PythonArgument& choice :
         list < 0 ? std::vector<PythonArgument>() : file.source.brackets[static_cast<std::size_t>(list)].arguments) {
      if (const std::optional<std::string> text = file.value(&choice, kDeepest)) {
        argument.choices.push_back(*text);
      }
    }
    arguments.push_back(std::move(argument));
  }
  return arguments;
}

}  // namespace launch::lsp
