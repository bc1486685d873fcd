// SPDX-License-Identifier: Apache-2.0
// `launch reload`: lets a launch read its launch file again, shows the difference, and waits until it is there.
#include <fmt/format.h>

#include <cstdio>

#include "base/environment/own_environment.hpp"
#include "launcher/control/control_client.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/steer/process_text.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

constexpr const char* kReloadDescription =
    "Reads the launch file of a running launch again, starts what is new, ends what is gone, and restarts what has "
    "changed. The rest goes on. A file with an error changes nothing.";

void print_lines(const Json& lines, char sign, const char* what) {
  for (const Json& line : lines) {
    fmt::print("{} {:<20} {}", sign, line["process"].get<std::string>(), what);
    if (line.contains("place")) {
      fmt::print("  {}", place_text(line["place"]));
    }
    fmt::print("\n");
    for (const Json& change : line.value("changes", Json::array())) {
      fmt::print("    {}\n", change.get<std::string>());
    }
  }
}

void print_difference(const Json& report) {
  print_lines(report["ends"], '-', "ends");
  print_lines(report["starts"], '+', "starts");
  print_lines(report["restarts"], '~', "restarts");
  print_lines(report["sets"], '~', "gets parameters while it runs");
  print_lines(report["takes_over"], '~', "goes on with other settings");
  const auto stays = report["stays"].get<std::size_t>();
  const bool others_go_on = !report["sets"].empty() || !report["takes_over"].empty();  // but not as they were
  fmt::print("= {} {}{}\n", stays, stays == 1 ? "process goes on" : "processes go on",
             !others_go_on ? ""
             : stays == 1  ? " as it was"
                           : " as they were");
  for (const Json& note : report["notes"]) {
    fmt::print("! {}\n", note.get<std::string>());
  }
}

}  // namespace

int reload_command(const std::vector<std::string>& words) {
  std::string word;
  std::string wanted;
  bool dry_run = false;
  bool restart = false;
  bool no_wait = false;
  Subcommand command("launch reload", kReloadDescription);
  command.take_text("LAUNCH", word, kLaunchHelp);
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  command.take_flag("--dry-run", dry_run, "only show the difference");
  command.take_flag("--restart", restart, "restart nodes whose parameters have changed, don't set them");
  command.take_flag("--no-wait", no_wait, "show the difference, don't wait until it is there");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (!word.empty() && !wanted.empty() && word != wanted) {
    fmt::print(stderr, "{}", usage_error("launch reload", "LAUNCH and --launch name different launches"));
    return kWrongCommandLine;
  }
  ControlClient launch = choose_launch(own_environment(), wanted.empty() ? word : wanted);
  launch.ask("events");
  const Json answer = launch.ask({{"do", "reload"}, {"dry_run", dry_run}, {"restart", restart}});
  while (const std::optional<Json> event = launch.next()) {
    if (event->value("reload", 0U) != answer["reload"]) {
      continue;
    }
    if (event->contains("errors")) {
      fmt::print(stderr, "{}", (*event)["errors"].get<std::string>());
      throw ControlError(dry_run ? "the launch file has an error" : "the launch file has an error; nothing is changed");
    }
    if (event->contains("refused")) {
      throw ControlError((*event)["refused"].get<std::string>());
    }
    if (event->contains("failures")) {
      for (const Json& failure : (*event)["failures"]) {
        fmt::print(stderr, "{}", command_error("launch reload", failure.get<std::string>()));
      }
      return (*event)["failures"].empty() ? 0 : 1;
    }
    print_difference(*event);
    std::fflush(stdout);
    if (dry_run || no_wait) {
      return 0;
    }
  }
  throw ControlError(fmt::format("launch {} has ended", launch.pid()));
}

}  // namespace launch
