// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "base/text/names.hpp"
#include "launcher/process/spawn/program_search.hpp"
#include "launcher/substitution/unrun_commands.hpp"
#include "programs/launch/check/finders.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

using Report = std::function<void(Diagnostic)>;

void find_missing_program(const ProcessSpec& spec, bool left_out, const Report& report) {
  std::error_code ignored;
  const bool is_known = spec.argv.front().find(kUnknownOutput) == std::string::npos &&
                        spec.working_directory.find(kUnknownOutput) == std::string::npos;
  if (spec.shell || !is_known || !spec.machine.empty() ||
      (!spec.working_directory.empty() && !fs::is_directory(spec.working_directory, ignored))) {
    return;
  }
  try {
    fs::path program = find_program(spec);
    if (program.is_relative() && !spec.working_directory.empty()) {
      program = spec.working_directory / program;
    }
    if (::access(program.c_str(), X_OK) != 0) {
      throw std::system_error(errno, std::generic_category());
    }
  } catch (const std::system_error& error) {
    report({left_out ? Severity::kWarning : Severity::kError,
            fmt::format("program '{}' can't be run: {}", spec.argv.front(), error.code().message()), spec.origin,
            left_out ? "a condition leaves this out with the arguments given" : "", Finding::kMissingProgram});
  }
}

// Those that stand in the arguments; the others are found where they stand in the launch file.
void find_missing_parameter_files(const ProcessSpec& spec, const Report& report) {
  if (!spec.machine.empty()) {
    return;  // they are there
  }
  for (std::size_t i = 1; i < spec.argv.size(); ++i) {
    const bool generated = std::any_of(spec.files.begin(), spec.files.end(),
                                       [&](const GeneratedFile& file) { return file.argument == i; });
    if (spec.argv[i - 1] != "--params-file" || generated || spec.argv[i].find(kUnknownOutput) != std::string::npos) {
      continue;
    }
    std::error_code ignored;
    if (!fs::is_regular_file(fs::path(spec.working_directory) / spec.argv[i], ignored)) {
      report({Severity::kError,
              fmt::format("parameter file '{}' does not exist", spec.argv[i]),
              spec.origin,
              {},
              Finding::kMissingParameterFile});
    }
  }
}

// `-r [node:]from:=to`
void find_useless_remaps(const ProcessSpec& spec, const Report& report) {
  std::string node;
  for (std::size_t i = 1; i < spec.argv.size(); ++i) {
    if (spec.argv[i - 1] == "-r" && spec.argv[i].rfind("__node:=", 0) == 0) {
      node = spec.argv[i].substr(8);
    }
  }
  const auto warn = [&](const std::string& message) {
    report({Severity::kWarning, message, spec.origin, {}, Finding::kUselessRemap});
  };
  for (std::size_t i = 1; i < spec.argv.size(); ++i) {
    const std::size_t separator = spec.argv[i].find(":=");
    if (spec.argv[i - 1] != "-r" || separator == std::string::npos) {
      continue;
    }
    std::string from(without_scheme(std::string_view(spec.argv[i]).substr(0, separator)));
    if (const std::size_t colon = from.find(':'); colon != std::string::npos) {
      if (!node.empty() && from.substr(0, colon) != node) {
        warn(fmt::format("remap '{}' matches nothing: this node is named '{}'", spec.argv[i], node));
      }
      from.erase(0, colon + 1);
    }
    if (from == spec.argv[i].substr(separator + 2)) {
      warn(fmt::format("remap '{}' changes nothing", spec.argv[i]));
    }
  }
}

}  // namespace

void find_faults_of_process(const ProcessSpec& spec, bool left_out, const std::function<void(Diagnostic)>& report) {
  find_missing_program(spec, left_out, report);
  if (!left_out) {
    find_missing_parameter_files(spec, report);
    find_useless_remaps(spec, report);
  }
}

}  // namespace launch
