// SPDX-License-Identifier: Apache-2.0
// `launch migrate`: a launch file of ROS 1, or one with old names, in the words of ROS 2.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "actions/builtin_actions.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/migrate_xml.hpp"
#include "programs/launch/rewrite/rewritten_files.hpp"

namespace launch {

int migrate_command(const Words& words) {
  std::vector<std::string> given;
  std::string output;
  bool print = false;
  Subcommand command(
      "launch migrate",
      "Writes an XML launch file of ROS 1, or one with old names, in the words of ROS 2. Comments stay. What "
      "must be done by hand is told at its place. The new file stands beside robot.launch as "
      "robot.launch.xml; a file with another ending needs --output or --print. Exit code 1 after an error, "
      "and when something is left to be done by hand.");
  command.take_words("FILE", given, true, "a launch file in XML");
  command.take_text("-o,--output", output, "the new file, which may be the given one");
  command.take_flag("--print", print, "print the new text instead of writing it into a file");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  const bool has_name = print || !output.empty() || given.front().ends_with(".launch");
  if (given.size() != 1 || !has_name) {
    fmt::print(stderr, "{}",
               usage_error("launch migrate", given.size() != 1 ? "give one file" : "--output is missing"));
    return kWrongCommandLine;
  }
  ResultOutput result("launch migrate");
  try {
    const auto file = read_source_file(given.front());
    const Migrated made = migrate_xml(file);
    const std::string text = formatted(std::make_shared<SourceFile>(file->path(), made.text), builtin_actions());
    const std::string path = output.empty() ? given.front() + ".xml" : output;
    if (print) {
      result.print(text);
    } else {
      if (output.empty() && std::filesystem::exists(path)) {
        throw LaunchError(fmt::format("'{}' exists", path), {}, "--output names another file, --print writes none");
      }
      if (!std::filesystem::exists(path)) {
        std::ofstream(path, std::ios::binary).close();
      }
      rewrite_file(path, text);
      result.print(path + "\n");
    }
    if (!made.left.empty()) {
      print_errors(LaunchError(made.left), "launch migrate");
    }
    return result.finish() && made.left.empty() ? 0 : 1;
  } catch (const LaunchError& error) {
    print_errors(error, "launch migrate");
    return 1;
  }
}

}  // namespace launch
