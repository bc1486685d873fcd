// SPDX-License-Identifier: Apache-2.0
// Substitutions that look beyond the launch files: at commands, files, Python, and the name of this run.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <random>
#include <sstream>

#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/python/interpreter/python_module.hpp"
#include "launcher/substitution/command_output.hpp"
#include "launcher/substitution/machine_view.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/substitution_call.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "launcher/substitution/unrun_commands.hpp"

namespace launch {

namespace {

// The end of a text without its line ends, for a message.
std::string last_line(std::string text) {
  text.erase(text.find_last_not_of("\r\n") + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

PythonPlace python_place(const SourceRange& where) {
  if (where.file == nullptr) {
    return {};
  }
  const SourceFile::Position position = where.file->position(where.begin);
  return {where.file->path(), position.line, position.column};
}

}  // namespace

bool Scope::command_was_left_out() const {
  return unrun_commands != nullptr && unrun_commands->left_out;
}

void Scope::forget_left_out_command() {
  if (unrun_commands != nullptr) {
    unrun_commands->left_out = false;
  }
}

std::string command(const SubstitutionCall& call) {
  const std::string line = call.text(0);
  const std::string on_stderr = call.has(1) ? call.text(1) : "fail";
  const std::vector<std::string> policies = {"fail", "warn", "ignore", "capture"};
  if (std::find(policies.begin(), policies.end(), on_stderr) == policies.end()) {
    throw LaunchError(
        fmt::format("'{}' is not what to do with standard error, expected fail, warn, ignore or capture", on_stderr),
        call.where(1), did_you_mean(on_stderr, policies));
  }
  const std::vector<std::string> words = split_shell_words(line, call.where(0));
  if (words.empty()) {
    throw LaunchError("the command is empty", call.where(0));
  }
  MachineView* const machine = call.scope().machine.get();
  if (machine != nullptr && !machine->is_connected()) {
    return unknown_there("output of " + words.front(), *machine);
  }
  std::string program;
  try {
    program = call.scope().packages->find_program(words.front(), call.scope().environment);
  } catch (const std::runtime_error& error) {
    call.fail(error.what(), {}, Finding::kExpression);  // of another machine
  }
  if (program.empty()) {
    call.fail(fmt::format("executing command '{}' failed: '{}' was not found", line, words.front()),
              words.front().find(' ') != std::string::npos ? "one quoted word is one program name; quote less"
                                                           : "install it, or extend the PATH",
              Finding::kExpression);
  }
  if (UnrunCommands* const unrun = call.scope().unrun_commands.get()) {
    unrun->left_out = true;
    return std::string(kUnknownOutput);
  }
  CommandOutput output;
  try {
    output = machine != nullptr ? machine->run(program, words, call.scope().environment, on_stderr == "capture")
                                : capture_command(program, words, call.scope().environment,
                                                  {.merge_error = on_stderr == "capture", .limit = command_limit()});
  } catch (const std::runtime_error& error) {
    call.fail(fmt::format("executing command '{}' failed: {}", line, error.what()), {}, Finding::kExpression);
  }
  const std::string said = output.error.empty() ? std::string() : fmt::format("it wrote: {}", last_line(output.error));
  if (output.given_up != CommandOutput::GivenUp::kNot) {
    const bool took_too_long = output.given_up == CommandOutput::GivenUp::kTookTooLong;
    call.fail(took_too_long ? fmt::format("executing command '{}' failed: it runs for more than {} s, and was ended",
                                          line, command_limit()->count())
                            : fmt::format("executing command '{}' failed: it wrote more than {} MiB, and was ended",
                                          line, kLargestCommandOutput >> 20U),
              took_too_long ? "--python-seconds gives it more time" : "", Finding::kExpression);
  }
  if (output.status != 0) {
    call.fail(fmt::format("executing command '{}' failed: {}", line, describe_status(output.status)),
              said.empty() ? "it wrote nothing to standard error" : said, Finding::kExpression);
  }
  if (!output.error.empty() && on_stderr == "fail") {
    call.fail(fmt::format("executing command '{}' failed: it wrote to standard error", line),
              fmt::format("{}; to accept that: $(command '…' warn), or ignore, or capture", said),
              Finding::kExpression);
  }
  if (!output.error.empty() && on_stderr == "warn" && call.scope().warn) {
    call.scope().warn(call.where(),
                      fmt::format("command '{}' wrote to standard error: {}", line, last_line(output.error)));
  }
  return output.text;
}

std::string eval(const SubstitutionCall& call) {
  const std::string expression = call.text(0);
  try {
    return evaluate_python(expression, call.has(1) ? call.text(1) : "math", python_place(call.where(0)));
  } catch (const EvaluationError& error) {
    std::string help = error.help;
    for (const char* const word : {"true", "false"}) {
      if (std::string_view(error.what()).find(fmt::format("name '{}' is not defined", word)) !=
          std::string_view::npos) {
        help = fmt::format("Python writes booleans True and False; compare the text: \"$(var x)\" == \"{}\"", word);
      }
    }
    call.fail(
        fmt::format("failed to evaluate the Python expression '{}': {}", expression, error.what()),
        help.empty() ? "substitutions are pasted in as text: put quotes around what is to be a text" : std::move(help),
        Finding::kExpression);
  }
}

std::string file_content(const SubstitutionCall& call) {
  const std::string path = call.text(0);
  if (MachineView* const machine = call.scope().machine.get()) {
    try {
      return machine->read_file(path);
    } catch (const std::runtime_error& error) {
      call.fail(error.what(), {}, Finding::kMissingFile);
    }
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (!file || !(content << file.rdbuf())) {
    call.fail(fmt::format("file not found: '{}'", path),
              path.starts_with('/')
                  ? ""
                  : "a relative path is relative to the launcher's working directory; use $(dirname)/…",
              Finding::kMissingFile);
  }
  return std::move(content).str();
}

// Keeps the name as a configuration, so that it is the same everywhere in the scope.
std::string anon(const SubstitutionCall& call) {
  const std::string name = call.text(0);
  const std::string key = "anon" + name;
  auto& configurations = call.scope().configurations;
  if (const auto found = configurations.find(key); found != configurations.end()) {
    return found->second;
  }
  AnonymousNames* const names = call.scope().anonymous_names.get();
  if (names != nullptr) {
    const std::vector<std::string>& made = names->made[name];
    if (const std::size_t used = names->used[name]++; used < made.size()) {
      return configurations.emplace(key, made[used]).first->second;
    }
  }
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  std::random_device random;
  std::string unique = fmt::format("{}_{}_{}_{}", name, host.data(), ::getpid(), random());
  for (char& character : unique) {
    if (character == '.' || character == '-' || character == ':') {
      character = '_';
    }
  }
  if (names != nullptr) {
    names->made[name].push_back(unique);
  }
  return configurations.emplace(key, unique).first->second;
}

}  // namespace launch
