// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/process_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <string.h>

#include <chrono>
#include <string>

#include "base/processes/outside_number.hpp"

namespace launch {

namespace {

std::string signal_name(int signal) {
  const char* name = ::sigabbrev_np(signal);
  return name == nullptr ? fmt::format("{}", signal) : fmt::format("SIG{}", name);
}

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

// " (system.launch.xml:4:3)", or nothing for a process that no file asked for.
std::string place(const ProcessSpec& spec) {
  return spec.origin ? fmt::format(" ({})", to_string(spec.origin)) : std::string();
}

class Messages {
 public:
  Messages(OutputRouter& output, const ProcessEvent& event) : output_(output), event_(event) {}

  void operator()(const ProcessStarted& started) const {
    say(LogLevel::kInfo, fmt::format("process started with pid [{}]", shown(started.pid)));
    if (started.lacks_terminal) {
      say(LogLevel::kWarning,
          fmt::format("process has nothing to read, because standard input of the launch is no terminal{}",
                      place(event_.spec)));
    }
  }

  void operator()(const ProcessStartFailed& failed) const {
    say(LogLevel::kError,
        fmt::format("exception occurred while executing process: {}{}", failed.reason, place(event_.spec)));
  }

  void operator()(const ProcessExited& exited) const {
    if (exited.exit.lost) {
      say(LogLevel::kError, fmt::format("process is lost with machine '{}' [pid {}]{}", event_.spec.machine, exited.pid,
                                        place(event_.spec)));
    } else if (exited.exit.code == 0) {
      say(LogLevel::kInfo, fmt::format("process has finished cleanly [pid {}]", shown(exited.pid)));
    } else if (event_.spec.allowed_exits.contains(exited.exit.code)) {
      say(LogLevel::kInfo, fmt::format("process has finished with exit code {}, which is allowed [pid {}]",
                                       exited.exit.code, shown(exited.pid)));
    } else {
      say(LogLevel::kError, fmt::format("process has died [pid {}, exit code {}, cmd '{}'].{}", shown(exited.pid),
                                        exited.exit.code, fmt::join(event_.spec.argv, " "), place(event_.spec)));
    }
  }

  void operator()(const SignalSent& sent) const {
    if (sent.escalated_from != 0) {
      say(LogLevel::kError,
          fmt::format("process[{}] failed to terminate '{}' seconds after receiving '{}', "
                      "escalating to '{}'",
                      event_.label, waited(sent), signal_name(sent.escalated_from), signal_name(sent.signal)));
    }
    say(LogLevel::kInfo, fmt::format("sending signal '{}' to process[{}]", signal_name(sent.signal), event_.label));
  }

  void operator()(const SchedulingChanged& change) const {
    if (!change.failure.empty()) {
      return say(LogLevel::kError,
                 fmt::format("its scheduling {}: {}{}", change.to.empty() ? "is not what it was" : "has not changed",
                             change.failure, place(event_.spec)));
    }
    say(LogLevel::kInfo, change.to.empty() ? "its scheduling is what it was"
                                           : fmt::format("its scheduling is {} now", fmt::join(change.to, ", ")));
  }

  void operator()(const ProcessLeft& left) const {
    say(LogLevel::kError,
        fmt::format("process[{}] cannot be ended: pid {} {}{}", event_.label, shown(left.pid),
                    left.foreign ? "belongs to another user" : "has not ended after SIGKILL", place(event_.spec)));
  }

  void operator()(const RespawnSlowed& slowed) const {
    say(LogLevel::kWarning, fmt::format("process has ended {} times in a row less than a second after its start; it is "
                                        "started again more slowly, at last every 5 seconds{}",
                                        slowed.runs, place(event_.spec)));
  }

  void operator()(const ProcessWaitsForTerminal& waits) const {
    const char* const help = waits.has_terminal ? "it goes on when the launch is in the foreground again"
                                                : "stdin=\"terminal\" lets it have the terminal";
    say(LogLevel::kWarning,
        fmt::format("process waits for {}; {}{}", waits.reads ? "terminal input" : "the terminal, to set its modes",
                    help, place(event_.spec)));
  }

  void operator()(const HealthChanged& change) const {
    if (change.health == Health::kUnhealthy) {
      say(LogLevel::kError, fmt::format("process is unhealthy: {}{}", change.reason,
                                        change.where ? fmt::format(" ({})", to_string(change.where)) : std::string()));
    } else if (change.before == Health::kUnhealthy) {
      say(LogLevel::kInfo, "process is healthy again");
    }
  }

  void operator()(const StartLimitReached& reached) const {
    const std::string next = reached.cool_down ? fmt::format("it is started again in {} s", seconds(*reached.cool_down))
                                               : std::string("it is not started again");
    say(LogLevel::kError, fmt::format("process has been started {} times in {} s; {}{}", reached.starts,
                                      seconds(reached.within), next, place(event_.spec)));
  }

  void operator()(const ProcessDone&) const {}

 private:
  // ROS 2 counts the time before SIGKILL from the first signal on, and prints it as Python prints a float.
  std::string waited(const SignalSent& sent) const {
    if (sent.signal != SIGKILL) {
      return fmt::format("{}", seconds(sent.waited));
    }
    const std::string sum = fmt::format("{}", seconds(event_.spec.sigterm_timeout + event_.spec.sigkill_timeout));
    return sum.find_first_of(".e") == std::string::npos ? sum + ".0" : sum;
  }

  // A number of another machine is told as it is.
  pid_t shown(pid_t pid) const { return event_.spec.machine.empty() ? number_outside(pid) : pid; }

  void say(LogLevel level, const std::string& text) const {
    output_.message(level, shown_label_of(event_.label, event_.spec), text);
  }

  OutputRouter& output_;
  const ProcessEvent& event_;
};

}  // namespace

ProcessSupervisor::Observer process_messages(OutputRouter& output) {
  return [&output](const ProcessEvent& event) { std::visit(Messages(output, event), event.what); };
}

const char* name_of(Health health) {
  switch (health) {
    case Health::kUnwatched:
      return "unwatched";
    case Health::kStarting:
      return "starting";
    case Health::kHealthy:
      return "healthy";
    case Health::kUnhealthy:
      return "unhealthy";
  }
  return "";
}

namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

std::string end_of(const ProcessExit& exit) {
  if (exit.code >= 0) {
    return fmt::format("exit code {}", exit.code);
  }
  const char* const name = ::sigabbrev_np(-exit.code);
  return (name == nullptr ? fmt::format("signal {}", -exit.code) : fmt::format("SIG{}", name)) +
         (exit.core_dumped     ? ", core dumped,"
          : exit.out_of_memory ? " by the kernel, for want of memory,"
                               : "");
}

std::string describe(const ProcessExit& exit) {
  if (exit.lost) {
    return fmt::format("lost with its machine after {:.2f} s", std::chrono::duration<double>(exit.ran_for).count());
  }
  constexpr double kKibPerMib = 1024.0;
  return fmt::format("{} after {:.2f} s, with {:.2f} s of processor time and {:.1f} MiB", end_of(exit),
                     std::chrono::duration<double>(exit.ran_for).count(),
                     seconds(exit.usage.ru_utime) + seconds(exit.usage.ru_stime),
                     static_cast<double>(exit.usage.ru_maxrss) / kKibPerMib);
}

}  // namespace launch
