// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/completion.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>

#include "base/environment/own_prefix.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/substitution/package_index.hpp"
#include "programs/launch/check/finding_table.hpp"
#include "programs/launch/further_commands.hpp"
#include "programs/launch/help_options.hpp"
#include "programs/launch/run/find_launch_file.hpp"
#include "programs/launch/run/run_program.hpp"
#include "programs/launch/steer/control_command.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

// The commands that take launch files as `launch` itself does.
bool takes_launch_files(const std::string& command) {
  return command == "check" || command == "graph" || command == "test";
}

// "demo/" and "demo/system.launch.xml": directories and launch files that begin with the word.
Words paths(const std::string& word) {
  const std::size_t end = word.rfind('/');
  const std::string folder = end == std::string::npos ? "" : word.substr(0, end + 1);
  Words found;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, unreadable)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && !word.substr(folder.size()).starts_with('.')) {
      continue;
    }
    if (entry.is_directory(unreadable)) {
      found.push_back(folder + name + "/");
    } else if (is_launch_file(entry.path())) {
      found.push_back(folder + name);
    }
  }
  return found;
}

// The names of options if the last word begins like one, or the values of the option before it if its help lists them.
std::optional<Words> of_option(const Words& command, const Words& words) {
  if (words.back().starts_with('-')) {
    Words names = command.empty() ? Words{"--dry-run=json", "--dry-run=shell"} : Words{};
    for (const HelpOption& option : options_of_command(command)) {
      std::copy_if(option.names.begin(), option.names.end(), std::back_inserter(names),
                   [](const std::string& name) { return name.starts_with("--"); });
    }
    return names;
  }
  if (words.size() < 2 || !words[words.size() - 2].starts_with("--")) {
    return std::nullopt;
  }
  for (const HelpOption& option : options_of_command(command)) {
    const auto& names = option.names;
    if (!option.choices.empty() && std::find(names.begin(), names.end(), words[words.size() - 2]) != names.end()) {
      return option.choices;
    }
  }
  return std::nullopt;
}

class Completer {
 public:
  Completer(const Registry& registry, const Environment& environment, const CompleteTrace& trace_words)
      : registry_(registry), trace_words_(trace_words) {
    scope_.environment = environment;
    scope_.packages = std::make_shared<PackageIndex>(own_prefix());
  }

  Words candidates(const Words& words) {
    const std::string& current = words.back();
    const Words commands = further_command_names();
    const bool is_run =
        words.size() < 2 || std::find(commands.begin(), commands.end(), words.front()) == commands.end();
    const std::string command = is_run ? "" : words.front();
    const bool reads_trace = command == "trace" && words.size() > 2 && words[1] == "read";
    if (command == "trace" && !reads_trace) {
      return trace_words_({words.begin() + 1, words.end()});
    }
    if (command == "run") {
      return run_program_completions({words.begin() + 1, words.end()}, scope_.environment);
    }
    const Words named = is_run ? Words{} : reads_trace ? Words{"trace", "read"} : Words{command};
    if (std::optional<Words> found = of_option(named, words)) {
      return std::move(*found);
    }
    if (command == "schema") {
      return {"dry-run", "json", "xsd"};
    }
    if (command == "explain") {
      Words ids;
      for (const FindingInfo& info : finding_table()) {
        ids.push_back(finding_id(info.finding));
      }
      return ids;
    }
    if (is_control_command(command)) {
      return control_completions(command, words.size() - 1, scope_.environment);
    }
    if (!is_run && !takes_launch_files(command)) {
      return {};  // the shell offers files
    }
    Words target;  // the words before the current one that name launch files
    for (std::size_t i = is_run ? 0 : 1; i + 1 < words.size(); ++i) {
      if (!words[i].starts_with("-") && words[i].find(":=") == std::string::npos) {
        target.push_back(words[i]);
      }
    }
    if (target.empty()) {
      Words all = scope_.packages->packages(scope_.environment);
      const Words files = paths(current);
      all.insert(all.end(), files.begin(), files.end());
      if (is_run && words.size() == 1) {
        all.insert(all.end(), commands.begin(), commands.end());
      }
      return all;
    }
    std::error_code ignored;
    if (target.size() == 1 && !fs::is_regular_file(target.front(), ignored)) {
      return launch_files_of(target.front());
    }
    return arguments_of(target, current);
  }

 private:
  Words launch_files_of(const std::string& package) {
    std::set<std::string> names;
    std::error_code unreadable;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(scope_.packages->share(package, scope_.environment), unreadable)) {
      if (is_launch_file(entry.path())) {
        names.insert(entry.path().filename().string());
      }
    }
    return {names.begin(), names.end()};
  }

  // "name:=", and after that the choices of the argument.
  Words arguments_of(const Words& target, const std::string& current) {
    const auto description = load_launch_files(find_launch_files(target, scope_), registry_, scope_);
    Words words;
    for (const ArgumentInfo& info : find_arguments(*description, registry_, scope_).arguments) {
      const std::string begin = info.declaration->name + ":=";
      if (!current.starts_with(begin)) {
        words.push_back(begin);
        continue;
      }
      for (const std::string& choice : info.declaration->choices) {
        words.push_back(begin + choice);
      }
    }
    return words;
  }

  const Registry& registry_;
  const CompleteTrace& trace_words_;
  Scope scope_;
};

}  // namespace

std::vector<std::string> completions(const std::vector<std::string>& words, const Registry& registry,
                                     const Environment& environment, const CompleteTrace& trace_words) {
  if (words.empty()) {
    return {};
  }
  Words candidates;
  try {
    candidates = Completer(registry, environment, trace_words).candidates(words);
  } catch (const std::runtime_error&) {
    return {};  // the file has errors, or there is no such package: nothing to offer
  }
  std::erase_if(candidates, [&](const std::string& candidate) { return !candidate.starts_with(words.back()); });
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

}  // namespace launch
