// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/python_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "launcher/process/spawn/program_search.hpp"
#include "launcher/traced/words_of_text.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& prefix) {
  return fs::path(prefix) / "lib/launch/python_nodes";
}

bool is_python(const std::string& program) {
  return fs::path(program).filename().string().starts_with("python");
}

// The words of the first line of a script, behind its #!. None of another file.
std::vector<std::string> interpreter_of(const fs::path& program) {
  std::ifstream file(program);
  std::string line;
  if (file.get() != '#' || file.get() != '!' || !std::getline(file, line)) {
    return {};
  }
  return words_of_text(line);
}

// The command of Python that the process is, with the interpreter at its beginning. None of another program.
std::vector<std::string> python_command(const ProcessSpec& spec) {
  if (spec.shell) {
    return {};
  }
  std::vector<std::string> words = spec.argv;
  if (!is_python(words.front())) {
    try {
      words = interpreter_of(find_program(spec));
    } catch (const std::system_error&) {
      return {};  // the start of the process will tell
    }
    if (!words.empty() && fs::path(words.front()).filename() == "env") {
      words.erase(words.begin());
    }
  }
  return !words.empty() && is_python(words.front()) ? words : std::vector<std::string>();
}

// The option by which Python takes no modules from PYTHONPATH, or has no sitecustomize. "" if there is none.
std::string isolating_option(const std::vector<std::string>& command) {
  for (std::size_t i = 1; i < command.size() && command[i].starts_with('-') && command[i] != "-"; ++i) {
    for (const char letter : command[i].substr(1)) {
      if (letter == 'S' || letter == 'I' || letter == 'E') {
        return fmt::format("-{}", letter);
      }
      if (letter == 'c' || letter == 'm' || letter == '-') {
        return {};  // what follows is the program's
      }
      if (letter == 'W' || letter == 'X') {
        i += command[i].back() == letter ? 1 : 0;  // the value is the rest, or the next word
        break;
      }
    }
  }
  return {};
}

}  // namespace

void give_python_nodes_events(const std::string& prefix, Environment& environment) {
  const std::string folder = folder_of(prefix).string();
  std::string& variable = environment["PYTHONPATH"];
  if (variable == folder || variable.starts_with(folder + ":")) {
    return;
  }
  variable = variable.empty() ? folder : folder + ":" + variable;
}

std::string python_nodes_without_events(const std::vector<ProcessSpec>& processes, const std::string& prefix) {
  if (!fs::exists(folder_of(prefix) / "_launch_rclpy_events.abi3.so")) {
    return "python-nodes has no effect: this installation was built without python3-dev";
  }
  std::vector<std::string> without;
  for (const ProcessSpec& spec : processes) {
    if (const std::string option = isolating_option(python_command(spec)); !option.empty()) {
      without.push_back(fmt::format("{} (its Python has the option {})", spec.name, option));
    }
  }
  return without.empty() ? std::string()
                         : fmt::format("python-nodes has no effect on these processes: {}", fmt::join(without, ", "));
}

}  // namespace launch
