// SPDX-License-Identifier: Apache-2.0
// The lines of a control socket (docs/control.md): one JSON object a line, both ways.
#pragma once

#include <chrono>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/terminal/terminal.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/run/handlers/condition_handlers.hpp"
#include "launcher/run/user/steering.hpp"

namespace launch {

// Raised when a client of an older version could misunderstand something. New keys don't raise it.
constexpr int kControlVersion = 1;

// What is known about the launch from its start on.
struct LaunchFacts {
  pid_t pid = 0;                     // of the process that the user has started
  std::vector<std::string> command;  // the words of its command line
  std::vector<std::string> files;    // launch files
  std::string directory;             // in which it was started
  std::string log_directory;
  std::string log_file;  // its path
  double started = 0;    // seconds since 1970
  // When it was started, by a clock that nobody sets.
  std::chrono::steady_clock::time_point started_at = std::chrono::steady_clock::now();
  std::string isolation{};  // "namespaces", "ROS_DOMAIN_ID=29", or empty
};

struct ControlRequest {
  enum class Kind {
    kInfo,
    kPs,
    kStop,
    kStart,
    kRestart,
    kSignal,
    kShutdown,
    kEvents,
    kOutput,
    kReload,
    kScale,
    kAttach,
    kInput,
    kResize
  };

  Kind kind = Kind::kInfo;
  Steering::Patterns processes;
  std::vector<std::string> groups;  // of kPs, kStop, kStart, kRestart and kSignal
  int signal = 0;
  std::size_t count = 0;   // of kScale
  bool dry_run = false;    // of kReload
  bool restart = false;    // of kReload: not by setting parameters
  TerminalSize size{};     // of kAttach and kResize: of the client's terminal; none if it has none
  bool read_only = false;  // of kAttach: the client types nothing
  std::string text;        // of kInput: what is typed
};

// Throws std::runtime_error, with a sentence for the client, for any other text.
ControlRequest parse_control_request(std::string_view line);

// Each returns a line without its end.
std::string error_line(std::string_view error, std::string_view help = {});
std::string info_line(const LaunchFacts& facts, bool ending);
std::string ps_line(const LaunchFacts& facts, bool ending, const std::vector<SteeredProcess>& processes,
                    const ProcessSupervisor& supervisor);
std::string outcome_line(const SteeringOutcome& outcome);
std::string done_line();
// `log_size` is the size of launch.log: what stands behind it comes as lines.
std::string follow_line(std::size_t log_size);

std::string event_line(const ProcessEvent& event);
std::string ending_line(const std::string& reason);
std::string condition_line(const ConditionEvent& event);
std::string output_line(const std::string& process, OutputStream stream, std::string_view text);
// The client has read too slowly.
std::string dropped_line(std::size_t lines);

// For those who are attached to the terminal of a process, a path. `clients` are so already.
std::string attached_line(const std::string& process, const std::string& terminal, std::size_t clients);
// The terminal has taken what was typed.
std::string taken_line(std::size_t bytes);
std::string terminal_line(std::string_view bytes);
std::string terminal_dropped_line(std::size_t bytes);
// Null: it is not known how the process has ended.
std::string terminal_ended_line(const std::string& process, const ProcessExited* exited);

}  // namespace launch
