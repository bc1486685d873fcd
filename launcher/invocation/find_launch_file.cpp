// SPDX-License-Identifier: Apache-2.0
#include "launcher/invocation/find_launch_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <system_error>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/names.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/visit/joined_description.hpp"

namespace launch {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kStandardInput = "-";

std::string did_you_mean_command(const std::string& word, const std::vector<std::string>& commands) {
  const std::string nearest = nearest_name(word, commands);
  return nearest.empty() ? nearest : fmt::format("did you mean the command 'launch {}'?", nearest);
}

std::string find_in_package(const std::string& package, const std::string& name, const Scope& scope,
                            const std::vector<std::string>& commands) {
  std::string share;
  try {
    share = scope.packages->share(package, scope.environment);
  } catch (const std::runtime_error& error) {
    std::string help = did_you_mean(package, scope.packages->packages(scope.environment));
    if (help.empty()) {
      help = did_you_mean_command(package, commands);
    }
    throw LaunchError(error.what(), {}, std::move(help));
  }
  std::vector<std::string> found;
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(share, unreadable)) {
    if (!entry.is_regular_file()) {
      continue;
    }
    names.push_back(entry.path().filename().string());
    if (names.back() == name) {
      found.push_back(entry.path().string());
    }
  }
  if (found.empty()) {
    throw LaunchError(fmt::format("file '{}' was not found in the share directory of package '{}' which is at '{}'",
                                  name, package, share),
                      {}, did_you_mean(name, names));
  }
  if (found.size() > 1) {
    std::sort(found.begin(), found.end());
    throw LaunchError(fmt::format("file '{}' was found more than once in the share directory of package '{}': ['{}']",
                                  name, package, fmt::join(found, "', '")),
                      {}, "give the path of the one you mean");
  }
  return found.front();
}

// The error for a path that no launch file has. `path` may be that of a directory.
LaunchError no_launch_file(const std::string& path, const std::vector<std::string>& commands) {
  std::error_code unreadable;
  if (fs::is_directory(path, unreadable)) {
    return LaunchError(fmt::format("'{}' is a directory, not a launch file", path), {}, "give one of its files");
  }
  // Names are compared without ".launch.xml", which would make any two of them look alike.
  const fs::path directory = fs::path(path).parent_path();
  const std::string name = fs::path(path).filename();
  const std::string ending = name.substr(std::min(name.find('.'), name.size()));
  const std::string beginning = name.substr(0, name.size() - ending.size());
  std::vector<std::string> names;
  std::vector<std::string> endings;  // of launch files with this beginning
  for (const fs::directory_entry& entry : fs::directory_iterator(directory.empty() ? "." : directory, unreadable)) {
    const std::string other = entry.path().filename();
    if (other.ends_with(ending) && !entry.is_directory(unreadable)) {
      names.push_back(other.substr(0, other.size() - ending.size()));
    }
    if (!beginning.empty() && other.starts_with(beginning + ".") && is_launch_file(entry.path())) {
      endings.push_back(other.substr(beginning.size()));
    }
  }
  std::string nearest = nearest_name(beginning, names);
  if (!nearest.empty()) {
    nearest += ending;
  } else if (const std::string other = nearest_name(ending, endings); !other.empty()) {
    nearest = beginning + other;
  }
  std::string help = nearest.empty() ? did_you_mean_command(path, commands)
                                     : fmt::format("did you mean '{}'?", (directory / nearest).string());
  if (help.empty()) {
    help = "a file of a package is named by two words: launch PACKAGE FILE";
  }
  return LaunchError(fmt::format("launch file '{}' does not exist", path), {}, std::move(help));
}

// Whether the text is a Python launch file. XML begins with "<", and no key of a YAML launch file begins a line so.
bool is_python(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (line.starts_with('<')) {
      return false;
    }
    for (const std::string_view start : {"def generate_launch_description", "import ", "from "}) {
      if (line.starts_with(start)) {
        return true;
      }
    }
    begin = end + 1;
  }
  return false;
}

std::shared_ptr<const LaunchDescription> load_standard_input(const Registry& registry, const Scope& scope) {
  std::string text(std::istreambuf_iterator<char>(std::cin), {});
  const LaunchFileLoader* const python = is_python(text) ? registry.find_loader(".py") : nullptr;
  auto file = std::make_shared<SourceFile>("standard input", std::move(text));
  return python != nullptr ? (*python)(std::move(file), registry, scope)
                           : parse_launch_description(std::move(file), registry, scope);
}

}  // namespace

bool is_launch_file(const fs::path& path) {
  const std::string name = path.filename().string();
  const auto ends_name = [&](const char* end) { return name.ends_with(end); };
  constexpr std::array kEnds = {"launch.xml", "launch.yaml", "launch.yml", "launch.py"};
  return std::any_of(kEnds.begin(), kEnds.end(), ends_name);
}

std::vector<std::string> find_launch_files(const std::vector<std::string>& words, const Scope& scope,
                                           const std::vector<std::string>& commands) {
  const auto is_file = [](const std::string& word) {
    std::error_code ignored;
    return word == kStandardInput || (fs::exists(word, ignored) && !fs::is_directory(word, ignored));
  };
  if (words.size() == 2 && !is_file(words[0])) {
    return {find_in_package(words[0], words[1], scope, commands)};
  }
  if (!is_file(words[0])) {
    throw no_launch_file(words[0], commands);
  }
  for (const std::string& word : words) {
    if (!is_file(word)) {
      throw LaunchError(fmt::format("malformed launch argument '{}', expected format '<name>:=<value>'", word), {},
                        "nor is it a further launch file: no such file");
    }
  }
  if (std::count(words.begin(), words.end(), kStandardInput) > 1) {
    throw LaunchError("standard input can be read only once", {});
  }
  return words;
}

std::shared_ptr<const LaunchDescription> load_launch_files(const std::vector<std::string>& paths,
                                                           const Registry& registry, const Scope& scope) {
  std::vector<std::shared_ptr<const LaunchDescription>> descriptions;
  for (const std::string& path : paths) {
    if (path == kStandardInput) {
      descriptions.push_back(load_standard_input(registry, scope));
    } else {
      descriptions.push_back(load_launch_description(path, registry, scope));
    }
  }
  return descriptions.size() == 1 ? descriptions.front() : join_launch_descriptions(std::move(descriptions));
}

}  // namespace launch
