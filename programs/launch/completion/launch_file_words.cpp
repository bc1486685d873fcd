// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>

#include "actions/builtin_actions.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/substitution/package_index.hpp"
#include "programs/launch/command_functions.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

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

class Completer {
 public:
  Completer() : registry_(builtin_actions()) {
    scope_.environment = own_environment();
    scope_.packages = std::make_shared<PackageIndex>(own_prefix());
  }

  // `words` are those that name launch files and arguments, and options among them.
  Words candidates(const Words& words) {
    Words target;  // the words before the last one that name launch files
    std::copy_if(words.begin(), words.end() - 1, std::back_inserter(target), [](const std::string& word) {
      return !word.starts_with("-") && word.find(":=") == std::string::npos;
    });
    if (target.empty()) {
      Words all = scope_.packages->packages(scope_.environment);
      const Words files = paths(words.back());
      all.insert(all.end(), files.begin(), files.end());
      return all;
    }
    std::error_code ignored;
    if (target.size() == 1 && !fs::is_regular_file(target.front(), ignored)) {
      return launch_files_of(target.front());
    }
    return arguments_of(target, words.back());
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
    run_python_in_a_guest({std::chrono::seconds(5)});
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

  const Registry registry_;
  Scope scope_;
};

}  // namespace

Words launch_file_words(const Words& words) {
  const Words before(words.begin(), words.end() - 1);
  const Command& command = find_command(before);
  const bool has_command = *command.name != 0 && !command.hidden;
  return Completer().candidates({words.begin() + (has_command ? 1 : 0), words.end()});
}

}  // namespace launch
