// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/unit/unit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace launch {
namespace {

constexpr std::array<std::string_view, 12> kPrefixes = {"ROS_",        "RMW_",   "AMENT_",    "COLCON_",
                                                        "RCUTILS_",    "RCL_",   "FASTRTPS_", "FASTDDS_",
                                                        "CYCLONEDDS_", "ZENOH_", "LTTNG_",    "OVERRIDE_LAUNCH_"};
constexpr std::array<std::string_view, 7> kNames = {
    "PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH", "PKG_CONFIG_PATH", "PYTHONUNBUFFERED", "LANG"};

// In quotes, as systemd reads them. "%" begins a specifier everywhere, "$" a variable in a command.
std::string quoted(std::string_view text, bool in_command) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      all += '\\';
    } else if (c == '%' || (c == '$' && in_command)) {
      all += c;
    } else if (c == '\n') {
      all += "\\n";
      continue;
    }
    all += c;
  }
  return all + '"';
}

}  // namespace

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
    text += (&word == &unit.command.front() ? "" : " ") + quoted(word, true);
  }
  // The file as it is then. `systemctl reload` fails, and nothing changes, if the file has an error.
  text += fmt::format("\nExecReload={} reload --launch $MAINPID", quoted(unit.command.front(), true));
  text += fmt::format("\nWorkingDirectory={}\n", unit.directory);
  if (!unit.user.empty()) {
    text += fmt::format("User={}\n", unit.user);
  }
  for (const auto& [name, value] : unit.variables) {
    text += fmt::format("Environment={}\n", quoted(name + "=" + value, false));
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
    const std::string_view text = name;
    const bool known =
        std::any_of(kPrefixes.begin(), kPrefixes.end(), [&](auto prefix) { return text.starts_with(prefix); }) ||
        std::find(kNames.begin(), kNames.end(), text) != kNames.end();
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
  for (char& c : name) {
    const bool allowed =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':';
    c = allowed ? c : '-';
  }
  return "launch-" + name;
}

}  // namespace launch
