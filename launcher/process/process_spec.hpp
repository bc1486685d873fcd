// SPDX-License-Identifier: Apache-2.0
// Three types with different lifetimes: a command that is fully evaluated, a running process, and the end of a process.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/process/control_groups/control_group.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/health_watch.hpp"
#include "launcher/process/resource_limits.hpp"

namespace launch {

// Number of a process in this launch, from 1 in the order of requests; the N of its label "talker-N". Kept by respawns.
using ProcessId = std::uint32_t;

// The destinations of a stream's lines; combine freely.
struct OutputTargets {
  bool screen = false;   // launcher's standard output, "[LABEL] text"
  bool log = false;      // launch.log
  bool own_log = false;  // LABEL-stdout.log or LABEL-stderr.log, and LABEL.log
  bool operator==(const OutputTargets&) const = default;
};

struct OutputRouting {
  OutputTargets out;
  OutputTargets err;
  bool operator==(const OutputRouting&) const = default;

  // The modes of ROS 2: screen, log, both, own_log, full; nullopt for another word.
  static std::optional<OutputRouting> from_mode(std::string_view mode);
};

struct RespawnPolicy {
  bool enabled = false;
  Duration delay{0};
  std::int64_t max_retries = -1;  // negative: no limit
  // Each delay is `backoff` times the one before, up to max_delay. The series begins anew after a run that lasted
  // longer than max_delay. 1: the delay stays as it is, also above max_delay.
  double backoff = 1.0;
  Duration max_delay = std::chrono::seconds(60);
};

// Starts that come too fast: the process is given up, for a time or for ever. Starts that a user asks for do not count.
struct StartLimit {
  std::int64_t starts = 0;  // so many within the time; 0: no limit
  Duration within = std::chrono::seconds(60);
  std::optional<Duration> cool_down;  // then it is started again; nullopt: never
  bool shuts_down = false;            // for observers: the launch ends when the process is given up
};

// Ends of a process that are no failures, beside exit code 0.
struct AllowedExits {
  bool any = false;
  std::vector<int> codes;  // -N: ended by signal N

  bool contains(int code) const {
    return any || code == 0 || std::find(codes.begin(), codes.end(), code) != codes.end();
  }
};

// Text that the process reads from a file of its own. The file is written before the first spawn into the run's private
// directory, its path is put in place of argv[argument], and it is removed when the launch ends.
struct GeneratedFile {
  std::size_t argument = 0;
  std::string name;  // file name hint, "talker-params.yaml"
  std::string content;
};

// Configuration: plain data, all substitutions performed. `launch --dry-run` prints exactly this.
struct ProcessSpec {
  std::string name;           // label without its number; the supervisor appends "-N"
  std::string machine;        // on which it runs; empty: this one
  std::string label;          // "talker-1"; the supervisor sets it
  std::string python_action;  // the name of the action of a Python launch file that asked for it; empty: another file
  std::vector<std::string> other_names;  // further names for it, such as the name of its ROS node
  std::vector<std::string> groups;       // names of the groups of the launch file around it, the outermost first
  std::vector<std::string> argv;  // never empty; argv[0] is searched on PATH of `environment` when it has no slash
  Environment environment;        // complete, not a difference
  std::string working_directory;  // empty: the launcher's
  bool shell = false;             // run argv joined with spaces through /bin/sh -c
  bool emulate_tty = false;       // stdout and stderr are pseudo-terminals
  bool terminal_input = false;    // stdin is that of the launcher, if that is a terminal
  bool tty = false;               // stdin, stdout and stderr are a pseudo-terminal of its own; all output is stdout
  OutputRouting output;
  ResourceLimits limits;
  ControlGroupLimits control_limits;                                // for observers: of limits.control_group
  std::vector<std::shared_ptr<const ControlGroup>> control_groups;  // for observers: around it, the outermost first
  RespawnPolicy respawn;
  StartLimit start_limit;
  std::vector<HealthWatch> watches;  // for observers: how its health is told; empty: it is not watched
  bool shutdown_on_exit = false;     // for observers: the whole system shall end when this process does
  bool scalable = false;             // for observers: several of it may run side by side
  bool required = false;             // the launch ends as this process did
  AllowedExits allowed_exits;
  std::string crash_directory;  // for observers: where a bundle of each crash is made; empty: nowhere
  Duration sigterm_timeout = std::chrono::seconds(5);  // from SIGINT to SIGTERM
  Duration sigkill_timeout = std::chrono::seconds(5);  // from SIGTERM to SIGKILL
  std::vector<GeneratedFile> files;
  bool traced = true;                 // for RunScopes: may be recorded
  bool tells_load_addresses = false;  // for RunScopes: one of them records where the files of the process are loaded
  std::string mark;                   // tells the guardian about it (Guardian::mark); the supervisor sets it
  SourceRange origin;                 // the launch-file line that asked for it
};

// What limits the process, in words: its own limits, then those of its groups.
std::vector<std::string> limits_of(const ProcessSpec& spec);

// Invocation: one running process. The group of the process has the number `pid`, unless the process has the terminal:
// only the group of the launcher may read it.
struct Process {
  pid_t pid = -1;
  bool has_terminal = false;
  std::string mark{};  // of a process that has the terminal: its descendants in the launcher's group have it, too
  UniqueFd pidfd;
  UniqueFd out;  // read end of standard output; of a process with a tty, of its terminal, and then there is no `err`
  UniqueFd err;
  UniqueFd in;                            // write end of standard input, kept open
  std::string control_group{};            // of its own; empty: none
  std::uint64_t out_of_memory_before{0};  // how many processes the kernel had ended there, when it started
  // Of a process on another machine, whose pidfd and streams are stand-ins.
  std::string machine{};
  std::uint32_t run{0};   // its number there
  bool starting = false;  // it is not known yet whether it starts (ProcessRunner::confirm())
};

// The exit code of a process that could not be started.
constexpr int kExitCodeOfFailedStart = 127;

// That of a process whose machine was lost, as of ssh(1): nobody knows how it has ended.
constexpr int kExitCodeOfLost = 255;

// Outcome.
struct ProcessExit {
  int code = 0;  // exit code; -N when ended by signal N, 127 when it could not be started
  Duration ran_for{0};
  rusage usage{};
  bool core_dumped = false;
  bool out_of_memory = false;  // the kernel has ended it, because there was no memory
  bool lost = false;           // the connection to its machine is lost
};

}  // namespace launch
