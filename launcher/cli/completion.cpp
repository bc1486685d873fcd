// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/completion.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>

#include "launcher/base/own_prefix.hpp"
#include "launcher/cli/check/finding_table.hpp"
#include "launcher/cli/control/control_command.hpp"
#include "launcher/cli/find_launch_file.hpp"
#include "launcher/cli/further_commands.hpp"
#include "launcher/cli/run_program.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

const Words kOptions = {"--crash-dir",
                        "--debug",
                        "--dry-run",
                        "--dry-run=json",
                        "--dry-run=shell",
                        "--help",
                        "--ignore-failures",
                        "--launch-prefix",
                        "--launch-prefix-filter",
                        "--log-files",
                        "--log-level",
                        "--log-size",
                        "--print",
                        "--report",
                        "--show-args",
                        "--strict-args",
                        "--timestamps",
                        "--timing",
                        "--top",
                        "--trace",
                        "--version"};
const Words kCheckOptions = {"--disable", "--format", "--from-trace", "--help", "--strict-ros2", "--werror"};
const Words kGraphOptions = {"--format", "--from-trace", "--help", "--live", "--output", "--seconds"};

const Words kTestOptions = {"--directory", "--engine",  "--github", "--help", "--jobs",
                            "--json",      "--junit",   "--keep",   "--list", "--name",
                            "--repeat",    "--retries", "--shard",  "--tap",  "--until-failure"};

class Completer {
 public:
  Completer(const Registry& registry, const Environment& environment, const CompleteTrace& trace_words)
      : registry_(registry), trace_words_(trace_words) {
    scope_.environment = environment;
    scope_.packages = std::make_shared<PackageIndex>(own_prefix());
  }

  Words candidates(const Words& words) {
    const std::string& current = words.back();
    const std::string command = words.size() > 1 ? words.front() : "";
    if (command == "trace") {
      return trace_words_({words.begin() + 1, words.end()});
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
    if (command == "run") {
      return run_program_completions({words.begin() + 1, words.end()}, scope_.environment);
    }
    if (command == "build" || command == "report" || command == "reference") {
      return {};
    }
    const bool is_run = command != "check" && command != "graph" && command != "test";
    if (current.starts_with("-")) {
      return is_run ? kOptions : command == "check" ? kCheckOptions : command == "test" ? kTestOptions : kGraphOptions;
    }
    Words target;  // the words before the current one that name launch files
    for (std::size_t i = is_run ? 0 : 1; i + 1 < words.size(); ++i) {
      if (!words[i].starts_with("-") && words[i].find(":=") == std::string::npos) {
        target.push_back(words[i]);
      }
    }
    if (target.empty()) {
      Words all = scope_.packages->packages(scope_.environment);
      if (is_run) {
        const Words commands = further_command_names();
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
