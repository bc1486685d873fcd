// SPDX-License-Identifier: Apache-2.0
// `launch doctor`: what stands on this machine in the way of real time, of tracing and of limits, and which nodes
// cannot hear each other.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "base/diagnostics/command_error.hpp"
#include "launcher/process/resource_limits.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/doctor/machine.hpp"

namespace launch {
namespace {

constexpr int kDoctorVersion = 1;

std::string as_json(const std::vector<MachineCheck>& checks) {
  using DoctorJson = nlohmann::ordered_json;
  DoctorJson list = DoctorJson::array();
  for (const MachineCheck& check : checks) {
    DoctorJson entry = {
        {"area", check.area}, {"name", check.name}, {"verdict", check.ok ? "ok" : "warn"}, {"found", check.found}};
    if (!check.advice.empty()) {
      entry["advice"] = check.advice;
    }
    list.push_back(std::move(entry));
  }
  return DoctorJson{{"version", kDoctorVersion}, {"checks", list}}.dump(2) + "\n";
}

std::string as_text(const std::vector<MachineCheck>& checks) {
  std::string text;
  std::string area;
  for (const MachineCheck& check : checks) {
    if (check.area != area) {
      text += fmt::format("{}{}\n", area.empty() ? "" : "\n", check.area);
      area = check.area;
    }
    text += fmt::format("  {:<5} {:<15} {}\n", check.ok ? "ok" : "warn", check.name, check.found);
    if (!check.advice.empty()) {
      text += fmt::format("{:24}do: {}\n", "", check.advice);
    }
  }
  return text;
}

}  // namespace

int doctor_command(const Words& words) {
  std::string cpus;
  std::string root = "/";
  bool json = false;
  Subcommand command(
      "launch doctor",
      "Tells what stands on this machine in the way of real time, of tracing and of limits, and which of "
      "the nodes that run cannot hear each other. The exit "
      "status is 0 if nothing does, 1 if there is a warning, 2 after a wrong command line.");
  command.take_text("--cpus", cpus, "the CPUs for real time, such as 2-3; without it the isolated ones");
  command.take_text("--root", root, "a directory with the proc, sys, etc, run and dev of another machine");
  command.take_flag("--json", json, "print JSON");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  const std::optional<std::vector<int>> chosen = parse_cpu_list(cpus);
  if (!chosen && !cpus.empty()) {
    fmt::print(stderr, "{}",
               command_error("launch doctor", fmt::format("'{}' is no list of CPUs", cpus),
                             "write numbers and ranges, such as 0,2-3"));
    return kWrongCommandLine;
  }
  if (std::error_code error; !std::filesystem::is_directory(root, error)) {
    fmt::print(stderr, "{}", usage_error("launch doctor", fmt::format("--root: there is no directory '{}'", root)));
    return kWrongCommandLine;
  }
  const Machine machine(root);
  std::vector<MachineCheck> checks = check_real_time(machine, chosen.value_or(std::vector<int>()));
  for (const std::vector<MachineCheck>& more :
       {check_tracing(machine), check_limits(machine, ::geteuid() == 0), check_nodes(machine)}) {
    checks.insert(checks.end(), more.begin(), more.end());
  }
  ResultOutput output("launch doctor");
  output.print(json ? as_json(checks) : as_text(checks));
  if (!output.finish()) {
    return 1;
  }
  return std::all_of(checks.begin(), checks.end(), [](const MachineCheck& check) { return check.ok; }) ? 0 : 1;
}

}  // namespace launch
