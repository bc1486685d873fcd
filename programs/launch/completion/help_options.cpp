// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/completion/help_options.hpp"

#include <sstream>
#include <system_error>
#include <utility>

#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"

namespace launch {

namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

std::vector<HelpOption> options_in_help(std::string_view help) {
  std::vector<HelpOption> options;
  std::istringstream lines{std::string(help)};
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  -")) {
      continue;
    }
    std::istringstream words(line);
    std::string names;
    std::string value;
    words >> names >> value;
    HelpOption option{split(names.substr(0, names.find('{'))), {}};  // "--dry-run{text}" has a value by default
    // CLI11 writes "TEXT:{dot,svg}=dot".
    const std::size_t begin = value.find(":{");
    const std::size_t end = value.find('}');
    if (begin < end && end != std::string::npos) {
      option.choices = split(value.substr(begin + 2, end - begin - 2));
    }
    options.push_back(std::move(option));
  }
  return options;
}

std::string output_of(const std::string& program, std::vector<std::string> argv) {
  try {
    Pipe pipe = make_pipe();
    const pid_t pid = spawn({.program = program,
                             .argv = std::move(argv),
                             .descriptors = {{0, kDevNull}, {1, pipe.write.get()}, {2, kDevNull}},
                             .only_given_descriptors = true});
    pipe.write.reset();
    std::string text = read_to_end(pipe.read);
    wait_for(pid);
    return text;
  } catch (const std::system_error&) {
    return "";
  }
}

std::vector<HelpOption> options_of_command(std::vector<std::string> words) {
  words.insert(words.begin(), "launch");
  words.emplace_back("--help");
  return options_in_help(output_of(own_prefix() + "/bin/launch", std::move(words)));
}

}  // namespace launch
