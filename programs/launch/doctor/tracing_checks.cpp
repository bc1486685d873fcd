// SPDX-License-Identifier: Apache-2.0
// What stands in the way of tracing, and of limits that a cgroup holds.
#include <fmt/format.h>
#include <sys/statvfs.h>

#include <cstdint>
#include <sstream>

#include "launcher/process/control_groups/control_group_tree.hpp"
#include "launcher/process/guardian/own_cgroup.hpp"
#include "programs/launch/doctor/machine.hpp"

namespace launch {
namespace {

constexpr const char* kTracing = "tracing";
constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20U;
// Buffers of traced processes and the shared memory of Fast DDS are there.
constexpr std::uint64_t kRoomForBuffers = 256 * kMebibyte;
constexpr std::uint64_t kFewDescriptors = 4096;  // the daemons of LTTng have some for each buffer

MachineCheck tracing(const char* name, bool ok, std::string found, std::string advice) {
  return {kTracing, name, ok, std::move(found), ok ? "" : std::move(advice)};
}

std::string word_of_status(const Machine& machine, const std::string& row) {
  std::istringstream lines(machine.text("proc/self/status"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(row)) {
      return line.substr(row.size());
    }
  }
  return "";
}

bool is_of_root(const Machine& machine) {
  std::istringstream numbers(word_of_status(machine, "Uid:"));
  long real = -1;
  long effective = -1;
  numbers >> real >> effective;
  return effective == 0;
}

// "tracing:x:984:ada"
MachineCheck check_group(const Machine& machine) {
  if (is_of_root(machine)) {
    return tracing("group", true, "root may record everything", "");
  }
  std::istringstream lines(machine.text("etc/group"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("tracing:")) {
      const std::string number = line.substr(line.find(':', 8) + 1);
      std::istringstream own(word_of_status(machine, "Groups:"));
      for (std::string group; own >> group;) {
        if (group == number.substr(0, number.find(':'))) {
          return tracing("group", true, "this user is in the group tracing", "");
        }
      }
      return tracing("group", false,
                     "this user is not in the group tracing: its own processes can be recorded, not the "
                     "kernel",
                     "adduser YOUR_USER tracing, and log in again");
    }
  }
  return tracing("group", false, "there is no group tracing: the kernel can be recorded by root only",
                 "install lttng-tools");
}

MachineCheck check_daemon(const Machine& machine) {
  const std::string pid = machine.line("run/lttng/lttng-sessiond.pid");
  return pid.empty() || !machine.has("proc/" + pid)
             ? tracing("session daemon", true, "root's does not run; a launch starts one of its own", "")
             : tracing("session daemon", true, fmt::format("root's runs ({})", pid), "");
}

MachineCheck check_modules(const Machine& machine) {
  if (machine.has("sys/module/lttng_tracer")) {
    return tracing("kernel modules", true, "LTTng's are loaded", "");
  }
  const std::string release = machine.line("proc/sys/kernel/osrelease");
  for (const char* const folder : {"updates/dkms", "extra", "updates"}) {
    if (!machine.entries(fmt::format("lib/modules/{}/{}", release, folder), "lttng-tracer.ko").empty()) {
      return tracing("kernel modules", true, "LTTng's are there, and not loaded", "");
    }
  }
  return machine.has("sys/kernel/tracing/events")
             ? tracing("kernel modules", false, "LTTng's are not there: events of the kernel come by tracefs, for root",
                       "install lttng-modules-dkms, if the kernel is to be recorded by others")
             : tracing("kernel modules", false, "LTTng's are not there, nor is tracefs: the kernel can't be recorded",
                       "install lttng-modules-dkms, or mount tracefs at /sys/kernel/tracing");
}

MachineCheck check_descriptors(const Machine& machine) {
  const std::optional<std::uint64_t> limit = machine.soft_limit("Max open files");
  const bool ok = !limit || *limit >= kFewDescriptors;
  return tracing("descriptors", ok, limit ? fmt::format("{} for each process", *limit) : std::string("any number"),
                 fmt::format("many traced processes need more: `YOUR_USER - nofile {}` in a file in "
                             "/etc/security/limits.d",
                             kFewDescriptors * 16));
}

MachineCheck check_shared_memory(const Machine& machine) {
  struct statvfs room {};
  if (::statvfs(machine.path("dev/shm").c_str(), &room) != 0) {
    return tracing("shared memory", false, "there is no /dev/shm", "mount a tmpfs there");
  }
  const std::uint64_t free = std::uint64_t{room.f_bavail} * room.f_frsize;
  return tracing("shared memory", free >= kRoomForBuffers,
                 fmt::format("/dev/shm has room for {} MiB", free / kMebibyte),
                 "mount -o remount,size=1G /dev/shm; in a container --shm-size=1g");
}

}  // namespace

std::vector<MachineCheck> check_tracing(const Machine& machine) {
  return {check_group(machine), check_daemon(machine), check_modules(machine), check_descriptors(machine),
          check_shared_memory(machine)};
}

std::vector<MachineCheck> check_limits(const Machine& machine, bool is_root) {
  const OwnCgroup own = own_cgroup(machine.text("proc/self/cgroup"), machine.text("proc/self/mountinfo"));
  const auto below = [&](const std::string& path) { return machine.path(path.substr(1)).string(); };
  // A launch makes a cgroup of its own below a delegated one.
  const bool delegated = !own.path.empty() && is_delegated(below(own.path));
  const std::string directory = delegated ? own.path : own.mount;
  MachineCheck check{"limits", "cgroups", false, "", ""};
  if (own.path.empty()) {
    check.found = "cgroups of version 2 are not mounted: memory_max and the like have no effect";
    check.advice = "boot with systemd.unified_cgroup_hierarchy=1";
    return {check};
  }
  if (!delegated && !is_root) {
    check.found = "this cgroup is not delegated to this user: memory_max and the like have no effect";
    check.advice = "systemd-run --user --scope -p Delegate=yes launch …, or Delegate=yes in a unit";
    return {check};
  }
  std::istringstream there(machine.line(directory.substr(1) + "/cgroup.controllers"));
  std::string missing;
  std::string all;
  for (std::string controller; there >> controller;) {
    all += " " + controller + " ";
  }
  for (const char* const needed : {"memory", "cpu", "io", "pids"}) {
    if (all.find(fmt::format(" {} ", needed)) == std::string::npos) {
      missing += (missing.empty() ? "" : ", ") + std::string(needed);
    }
  }
  check.ok = missing.empty();
  check.found = missing.empty() ? fmt::format("limits can be set below {}", directory)
                                : fmt::format("the controllers {} are not in version 2", missing);
  check.advice = missing.empty() ? "" : "they belong to version 1: boot with systemd.unified_cgroup_hierarchy=1";
  return {check};
}

}  // namespace launch
