// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/kernel_recorder.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "base/environment/own_environment.hpp"
#include "base/files/pipe.hpp"
#include "base/files/replace_file.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/process_mark.hpp"
#include "base/processes/process_stat.hpp"
#include "base/processes/spawn.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = "kernel";
constexpr int kLongestEnd = 30'000;  // ms

std::vector<std::string> arguments_of(const fs::path& program, const std::string& session, const fs::path& recording,
                                      const std::vector<ChannelPlan>& plans, KernelRecording what,
                                      const std::vector<pid_t>& left_out) {
  std::vector<std::string> arguments = {program.string(), "launch-" + session, (recording / kFolder).string()};
  if (what == KernelRecording::kSnapshots) {
    arguments.emplace_back("snapshots");
  }
  for (const pid_t process : left_out) {
    arguments.insert(arguments.end(), {"leave-out", std::to_string(process)});
  }
  std::set<std::string> fields;  // the fields of all channels, because there is one trace for all of them
  for (const ChannelPlan& plan : plans) {
    if (plan.domain != LTTNG_DOMAIN_KERNEL) {
      continue;
    }
    for (const EventRule& rule : plan.events) {
      arguments.insert(arguments.end(), {"event", rule.pattern, rule.filter});
    }
    for (const std::string& name : plan.syscalls) {
      arguments.insert(arguments.end(), {"syscall", name});
    }
    for (const std::string& field : plan.context_fields) {
      fields.insert(field);
    }
  }
  for (const std::string& field : fields) {
    arguments.insert(arguments.end(), {"context", field});
  }
  return arguments;
}

// Starts the program and returns what it prints until it closes its output. The program then goes on in a session of
// its own, so a Ctrl-C does not reach it.
std::string start_and_listen(const std::vector<std::string>& arguments) {
  try {
    launch::Pipe pipe = launch::make_pipe();
    launch::Environment environment = launch::own_environment();
    environment.insert_or_assign(launch::kLeaveRunningVariable, "1");  // it ends with the session
    const pid_t pid = launch::spawn({
        .program = arguments[0],
        .argv = arguments,
        .environment = &environment.variables(),
        .descriptors = {{STDIN_FILENO, launch::kDevNull},
                        {STDOUT_FILENO, pipe.write.get()},
                        {STDERR_FILENO, launch::kDevNull}},
        .only_given_descriptors = true,
        .group = launch::ChildGroup::kOwnSession,
    });
    pipe.write.reset();
    std::string said = launch::read_to_end(pipe.read);
    if (!said.starts_with("ready")) {
      launch::wait_for(pid);
    }
    return said;
  } catch (const std::system_error& error) {
    throw TraceError(fmt::format("cannot start {}: {}", arguments[0], error.code().message()));
  }
}

// The rest of the line that begins with `key`.
std::string line_after(const std::string& text, const std::string& key) {
  const std::size_t found = text.find(key);
  if (found == std::string::npos) {
    return {};
  }
  const std::size_t begin = found + key.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

constexpr std::array<std::string_view, 5> kFields = {"procname", "pid", "tid", "vpid", "vtid"};  // ctf_writer.hpp

struct Recorder {
  pid_t pid = 0;  // 0: none
  std::uint64_t started = 0;
  std::string state;
  std::string reason;  // of state "failed"
};

Recorder recorder_of(const fs::path& recording) {
  Recorder recorder;
  std::ifstream file(recording / "kernel-recorder.pid");
  file >> recorder.pid >> recorder.started >> recorder.state >> std::ws;
  std::getline(file, recorder.reason);
  return recorder;
}

// A descriptor of the recorder's process (pidfd). None if the recorder has ended, also if another process has its
// number.
launch::UniqueFd process_of(const Recorder& recorder) {
  launch::UniqueFd process(static_cast<int>(syscall(SYS_pidfd_open, recorder.pid, 0)));
  if (process && launch::read_process_stat(recorder.pid).started != recorder.started) {
    process.reset();
  }
  return process;
}

bool send_signal(const launch::UniqueFd& process, int signal) {
  return process && syscall(SYS_pidfd_send_signal, process.get(), signal, nullptr, 0) == 0;
}

// Sends the signal and waits until the recorder reports that state.
void bring_to(const std::string& state, int signal, const fs::path& recording) {
  const Recorder recorder = recorder_of(recording);
  if (recorder.pid <= 0 || recorder.state == state) {
    return;
  }
  const launch::UniqueFd changes(inotify_init1(IN_CLOEXEC));
  inotify_add_watch(changes.get(), recording.c_str(), IN_MOVED_TO);
  if (!send_signal(process_of(recorder), signal)) {
    throw TraceError(fmt::format("the kernel recorder (process {}) is gone", recorder.pid),
                     "kernel events are recorded again by another session");
  }
  pollfd change{changes.get(), POLLIN, 0};
  for (Recorder now; (now = recorder_of(recording)).state != state;) {
    if (now.state == "failed" && now.reason != recorder.reason) {
      throw TraceError(fmt::format("the kernel recorder cannot write a snapshot: {}", now.reason));
    }
    const int ready = poll(&change, 1, kLongestEnd);
    std::array<char, 4096> event{};
    if (ready > 0 && read(changes.get(), event.data(), event.size()) > 0) {
      continue;
    }
    if (ready < 0 && errno == EINTR) {
      continue;
    }
    throw TraceError(fmt::format("the kernel recorder (process {}) does not answer", recorder.pid),
                     "kernel events go on as they were");
  }
}

}  // namespace

void check_kernel_recorder_fields(const std::vector<ChannelPlan>& plans) {
  for (const ChannelPlan& plan : plans) {
    for (const std::string& field : plan.context_fields) {
      if (plan.domain != LTTNG_DOMAIN_KERNEL || std::find(kFields.begin(), kFields.end(), field) != kFields.end()) {
        continue;
      }
      throw TraceError(
          fmt::format("context field '{}' of kernel events cannot be recorded without LTTng's kernel modules", field),
          "give context-fields-kernel some of procname, pid, tid, vpid and vtid; or install lttng-modules-dkms");
    }
  }
}

void pause_kernel_recorder(const fs::path& recording) {
  bring_to("paused", SIGUSR1, recording);
}

void resume_kernel_recorder(const fs::path& recording) {
  bring_to("recording", SIGUSR2, recording);
}

void take_kernel_snapshot(const fs::path& recording, const fs::path& snapshot, bool clear) {
  if (recorder_of(recording).pid <= 0) {
    return;
  }
  const fs::path request = recording / "kernel-recorder.request";
  try {
    launch::replace_file(request, snapshot.string() + "\n" + (clear ? "clear\n" : "keep\n"));
  } catch (const std::system_error& error) {
    throw TraceError(fmt::format("cannot write {}: {}", request.string(), error.code().message()));
  }
  bring_to(snapshot.filename(), SIGRTMIN, recording);
}

std::string start_kernel_recorder(const fs::path& program, const std::string& session, const fs::path& recording,
                                  const std::vector<ChannelPlan>& plans, KernelRecording what,
                                  const std::vector<pid_t>& left_out) {
  const std::string said = start_and_listen(arguments_of(program, session, recording, plans, what, left_out));
  if (said.starts_with("ready")) {
    return line_after(said, "warning: ");
  }
  const std::string reason = line_after(said, "error: ");
  throw TraceError(
      fmt::format("kernel events cannot be recorded: {}", reason.empty() ? "their recorder ended at once" : reason),
      line_after(said, "hint: "));
}

pid_t kernel_recorder_process(const fs::path& recording) {
  const Recorder recorder = recorder_of(recording);
  return process_of(recorder) ? recorder.pid : 0;
}

std::optional<std::uint64_t> finish_kernel_recorder(const fs::path& recording) {
  const Recorder recorder = recorder_of(recording);
  if (recorder.pid <= 0) {
    return std::nullopt;
  }
  if (const launch::UniqueFd process = process_of(recorder); send_signal(process, SIGTERM)) {
    pollfd end{process.get(), POLLIN, 0};
    while (poll(&end, 1, kLongestEnd) < 0 && errno == EINTR) {
    }
    waitpid(recorder.pid, nullptr, WNOHANG);  // reaps it if it is our child
  }
  const fs::path result = recording / "kernel-recorder.json";
  std::ifstream file(result);
  const auto said = nlohmann::json::parse(file, nullptr, false);
  std::error_code ignored;
  fs::remove(result, ignored);
  if (said.is_discarded()) {
    throw TraceError("the kernel recorder has not ended as it should: kernel events of this trace are lost");
  }
  return said.value("lost_events", std::uint64_t{0});
}

}  // namespace tracing
