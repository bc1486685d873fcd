// SPDX-License-Identifier: Apache-2.0
// `launch format`: launch files in the form in which the documentation writes them.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "actions/builtin_actions.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/rewritten_files.hpp"

namespace launch {

int format_command(const Words& words) {
  bool check = false;
  bool print = false;
  std::vector<std::string> given;
  Subcommand command(
      "launch format",
      "Writes XML and YAML launch files anew in the form in which the documentation has them: indentation, "
      "blanks, quotes and the order of attributes in XML. Comments and blank lines stay, and what a file "
      "means stays the same. Of a directory, all XML and YAML launch files below it. Exit code 1 after an "
      "error, and with --check when a file is in another form.");
  command.take_words("FILE", given, true, "XML or YAML launch files, or directories");
  command.take_flag("--check", check, "change nothing; name the files that are in another form");
  command.take_flag("--print", print, "print the new text instead of writing it into the file");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  const Registry registry = builtin_actions();
  ResultOutput result("launch format");
  bool is_right = true;
  for (const std::string& path : launch_files_in(given)) {
    try {
      if (path.ends_with(".py")) {
        throw LaunchError(fmt::format("'{}' is a program: launch format writes XML and YAML", path), {});
      }
      const auto file = read_source_file(path);
      const std::string text = formatted(file, registry);
      if (print) {
        result.print(text);
      } else if (text != file->text()) {
        result.print(path + "\n");
        is_right = is_right && !check;
        if (!check) {
          rewrite_file(path, text);
        }
      }
    } catch (const LaunchError& error) {
      print_errors(error, "launch format");
      is_right = false;
    }
  }
  return result.finish() && is_right ? 0 : 1;
}

}  // namespace launch
