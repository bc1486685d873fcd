// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/unit/unit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "launcher/deploy/shell_variables.hpp"
#include "launcher/deploy/systemd_text.hpp"

namespace launch {

std::string unit_text(const UnitFile& unit) {
  std::string text =
      fmt::format("{}\n[Unit]\nDescription={}\nDocumentation=man:launch(1)\n", kUnitMark, unit.description);
  // A robot without a network starts, too.
  text += unit.of_user ? "" : "After=network.target\n";
  text += "\n[Service]\n";
  // The launcher tells when everything has started, what it waits for, and that it still lives.
  text += "Type=notify\nNotifyAccess=all\nTimeoutStartSec=infinity\nWatchdogSec=30\n";
  text += "ExecStart=";
  for (const std::string& word : unit.command) {
    text += (&word == &unit.command.front() ? "" : " ") + systemd_quoted(word, true);
  }
  // The file as it is then. `systemctl reload` fails, and nothing changes, if the file has an error.
  text += fmt::format("\nExecReload={} reload --launch $MAINPID", systemd_quoted(unit.command.front(), true));
  text += fmt::format("\nWorkingDirectory={}\n", unit.directory);
  if (!unit.user.empty()) {
    text += fmt::format("User={}\n", unit.user);
  }
  for (const auto& [name, value] : unit.variables) {
    text += fmt::format("Environment={}\n", systemd_quoted(name + "=" + value, false));
  }
  // SIGTERM for the launch alone, which gives each process its signals; SIGKILL for all that is left then.
  text += fmt::format("KillMode=mixed\nTimeoutStopSec={}\n", unit.stop_timeout.count());
  text += "Restart=on-failure\nRestartSec=2\nRestartPreventExitStatus=2\n";
  text += "Delegate=yes\nOOMPolicy=continue\n";
  if (unit.realtime) {
    text += "LimitRTPRIO=99\nLimitMEMLOCK=infinity\nLimitNICE=-20\n";
  }
  if (unit.hardened) {
    // Not PrivateTmp: commands find a launch by its socket in /tmp. Not PrivateDevices and the like: a robot has
    // devices.
    text += "NoNewPrivileges=yes\nProtectSystem=full\nProtectHostname=yes\nRestrictSUIDSGID=yes\n";
    text += "LockPersonality=yes\nSystemCallArchitectures=native\n";
  }
  text += fmt::format("\n[Install]\nWantedBy={}\n", unit.of_user ? "default.target" : "multi-user.target");
  return text;
}

std::vector<std::pair<std::string, std::string>> variables_for_unit(const Environment& environment,
                                                                    const std::vector<std::string>& also) {
  std::vector<std::pair<std::string, std::string>> found;
  for (const auto& [name, value] : environment.variables()) {
    const bool known = is_setting_variable(name) || is_path_variable(name);
    if (known || std::find(also.begin(), also.end(), name) != also.end()) {
      found.emplace_back(name, value);
    }
  }
  return found;
}

std::string unit_name_of(const std::string& launch_file) {
  std::string name = std::filesystem::path(launch_file).filename().string();
  for (const std::string_view end : {".launch.xml", ".launch.yaml", ".launch.yml", ".launch.py", "_launch.xml",
                                     "_launch.yaml", "_launch.py", ".xml", ".yaml", ".py", ".launch"}) {
    if (name.size() > end.size() && name.ends_with(end)) {
      name.resize(name.size() - end.size());
      break;
    }
  }
  return "launch-" + unit_name(name);
}

}  // namespace launch
