// SPDX-License-Identifier: Apache-2.0
#include "programs/twin/twin_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>

#include "base/diagnostics/command_error.hpp"

namespace twin_program {

namespace {

// "/scan=16000"
void add_size(const std::string& text, Arguments& arguments) {
  const std::size_t sign = text.find('=');
  std::uint64_t bytes = 0;
  if (sign != std::string::npos && sign > 0) {
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data() + sign + 1, end, bytes);
    if (error == std::errc() && behind == end && bytes <= 100'000'000) {
      arguments.sizes[text.substr(0, sign)] = bytes;
      return;
    }
  }
  throw CLI::ValidationError("--size", fmt::format("'{}' is no size; write /topic=BYTES", text));
}

}  // namespace

std::optional<int> parse_arguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app("Makes a system of stand-ins from a trace, and tells how it would run if something were different.",
               "launch twin");
  std::string directory;
  std::string folder;
  std::vector<std::string> sizes;
  app.add_option("directory", directory, "Directory of a trace")->required();
  app.add_option("-o,--output", folder, "Folder that gets twin.xml and twin.json; without it, nothing is written")
      ->type_name("FOLDER");
  app.add_option("--what-if", arguments.what_ifs,
                 "A change: executor=/node:multi:4, groups=/node:separate, cpus=4, priority=/node:50, rate=/node:20Hz, "
                 "rate(/node)*2, duration=/node:5ms, duration(/node)*0.5; several with commas")
      ->option_text("CHANGE")
      ->allow_extra_args(false);
  app.add_flag("--run", arguments.run, "Run the twin, with the changes, and compare what is recorded of it");
  app.add_option("--duration", arguments.duration_s, "Seconds that the twin runs; default: as long as the recording")
      ->option_text("SECONDS")
      ->check(CLI::Range(1.0, 86400.0));
  app.add_option("--calibration", arguments.calibration_s,
                 "Seconds that --run runs the twin without changes before, to see what the stand-ins need beside their "
                 "work; 0: not at all; default: 3")
      ->option_text("SECONDS")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--cpus", arguments.cpus, "Processors of the recorded machine; default: as the trace tells")
      ->option_text("N")
      ->check(CLI::Range(1, 1024));
  app.add_option("--bytes", arguments.bytes, "Bytes of each message")
      ->option_text("N")
      ->check(CLI::Range(0, 100000000));
  app.add_option("--size", sizes, "Bytes of the messages of a topic")->option_text("TOPIC=N")->allow_extra_args(false);
  app.add_option("--seed", arguments.seed, "What is drawn at random follows from it")->option_text("N");
  app.add_option("--top", arguments.top, "Rows of the table; 0: all")->option_text("N");
  app.add_flag("--json", arguments.json, "Print one JSON object instead of text");
  app.footer(
      "Exit code: 0, 1 when the trace can't be read, the files can't be written or the twin doesn't run, 2 for wrong "
      "arguments.");
  try {
    app.parse(argc, argv);
    for (const std::string& size : sizes) {
      add_size(size, arguments);
    }
    if (arguments.run && folder.empty()) {
      throw CLI::ValidationError("--run", "needs a folder: -o FOLDER");
    }
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help
    }
    fmt::print(stderr, "{}", launch::usage_error_of(app, error));
    return launch::kWrongCommandLine;
  }
  arguments.directory = directory;
  arguments.folder = folder;
  return std::nullopt;
}

}  // namespace twin_program
