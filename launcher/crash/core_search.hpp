// SPDX-License-Identifier: Apache-2.0
// Where the kernel has put the core file of a process: /proc/sys/kernel/core_pattern, see core(5).
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace launch {

struct CoreSetting {
  std::string pattern;    // "core", "/var/cores/%e.%p", "|/usr/lib/systemd/systemd-coredump %P %u …"
  bool adds_pid = false;  // core_uses_pid: ".PID" follows if the pattern has no %p

  static CoreSetting of_kernel();

  bool is_program() const { return pattern.starts_with('|'); }
  // The program that gets the cores, "/usr/lib/systemd/systemd-coredump".
  std::string program() const;
  // The pattern of the shell for the paths of cores of this process. What is not known of it is a `*`.
  std::string glob(pid_t pid, const std::string& directory) const;
};

// A core file, or why there is none.
struct FoundCore {
  std::string path;
  bool temporary = false;  // it was made for the search, nobody else needs it
  std::string missing;     // a sentence if there is no path
};

// The core of a process that has been reported as dead. `directory` was its working directory. `scratch` is a directory
// in which a core may be written that is kept compressed elsewhere. Waits some seconds for a service that stores cores.
FoundCore find_core(const CoreSetting& setting, pid_t pid, const std::string& directory, const std::string& scratch);

}  // namespace launch
