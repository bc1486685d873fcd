// SPDX-License-Identifier: Apache-2.0
// Takes whole lines of children and of the launcher to the screen and to log files.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "launcher/process/output/journal.hpp"
#include "launcher/process/output/message_format.hpp"
#include "launcher/process/output/screen.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

enum class OutputStream { kOut, kErr };

// Levels of launcher messages, by their ROS 2 names.
enum class LogLevel { kDebug, kInfo, kWarning, kError, kCritical };

// One run's log directory BASE/YYYY-MM-DD-HH-MM-SS-ffffff-HOST-PID with launch.log, and BASE/latest as a link to it.
struct LogDirectory {
  std::string path;
  std::string warning;  // why BASE/latest was not updated; empty when it was
  UniqueFd running;     // as long as it is open, no other launch removes the directory (old_logs.hpp)

  // A path that is not there yet: launch files may read it before the launch begins. BASE by ROS_LOG_DIR, else
  // ROS_HOME/log, else ~/.ros/log.
  static std::string choose(const std::map<std::string, std::string>& environment);
  // Makes `chosen`, or another one if that is there by now. Throws std::system_error.
  static LogDirectory create(const std::string& chosen);
};

// Single-threaded. Lines are handed to the kernel before a call returns, all lines of one write() with one system call
// for each destination. A screen that takes no lines, because nobody reads it, holds up nothing (screen.hpp); lines
// that it does not show are in launch.log, whatever their targets. Ignores SIGPIPE in this process unless a handler is
// installed.
class OutputRouter {
 public:
  struct Rotation {
    std::uint64_t size = 0;  // bytes of a log file; 0: no limit
    int files = 5;           // of each log, the current one included: launch.log, launch.log.1, …
  };
  struct Options {
    int screen_fd = 1;            // children's lines and launcher messages, as ROS 2 does
    std::string log_directory{};  // empty: no files are written
    LogLevel screen_level = LogLevel::kInfo;
    bool colour = false;
    bool timestamps = false;                       // in front of each line of the screen, as in launch.log
    std::optional<MessageFormat> screen_format{};  // of messages; none: "[INFO] [logger]: text"
    std::optional<MessageFormat> log_format{};     // none: the same behind a time stamp
    std::string log_name = "launch.log";
    Rotation rotation{};
    std::shared_ptr<const Journal> journal{};  // in place of the screen
    int error_fd = -1;                         // for error(); negative: the screen
    EventLoop* loop = nullptr;                 // writes what a screen has not taken at once; must outlive the router
    Screen::Limits screen_limits{};
  };

  explicit OutputRouter(Options options);
  ~OutputRouter();  // waits for a screen that has lines left to take, but not long

  // Takes bytes read from a child. Complete lines are written at once; a rest waits for its end or for close_stream().
  // Invalid UTF-8 becomes U+FFFD.
  void write(ProcessId process, const std::string& label, OutputStream stream, const OutputTargets& targets,
             std::string_view bytes);
  // The stream has ended: writes the rest as a line.
  void close_stream(ProcessId process, const std::string& label, OutputStream stream, const OutputTargets& targets);

  // Tells the journal where processes come from. Without a journal it is not called.
  void describe_processes(std::function<Journal::Origin(ProcessId process)> origin_of);

  // Called for each line before it is written, whatever its targets. Invalid UTF-8 is U+FFFD here, too. A very long
  // line comes in parts. Null: no observer.
  using LineObserver = std::function<void(ProcessId process, OutputStream stream, std::string_view line)>;
  void observe_lines(LineObserver observer);

  // A launcher message: "[INFO] [logger]: text" on the screen, with a time stamp in front in launch.log.
  void message(LogLevel level, std::string_view logger, std::string_view text);

  // The status line of the screen, see screen.hpp.
  void show_status(std::string_view text);
  bool can_show_status() const;

  // Shows lines on standard error as they are.
  void error(std::string_view text);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace launch
