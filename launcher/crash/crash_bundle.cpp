// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/crash_bundle.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <optional>
#include <string_view>

#include "base/text/quoted_text.hpp"
#include "launcher/crash/core_file.hpp"
#include "launcher/crash/core_search.hpp"
#include "launcher/crash/timed_command.hpp"
#include "launcher/process/process_messages.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kDebuggerWithin(60);

void write(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

// The signals by which the kernel writes a core.
bool leaves_core(int signal) {
  constexpr std::array<int, 10> kWithCore = {SIGQUIT, SIGILL, SIGABRT, SIGFPE,  SIGSEGV,
                                             SIGBUS,  SIGSYS, SIGTRAP, SIGXCPU, SIGXFSZ};
  return std::find(kWithCore.begin(), kWithCore.end(), signal) != kWithCore.end();
}

// Why a process that has ended like this can have no core; empty: it may have one.
std::string reason_for_no_core(const ProcessExit& exit) {
  if (exit.code >= 0) {
    return fmt::format("The process has ended by itself with exit code {}, so there is no core.", exit.code);
  }
  if (!leaves_core(-exit.code)) {
    const std::string advice = exit.code == -SIGKILL ? " The kernel sends it when memory is short; `dmesg` tells." : "";
    return fmt::format("{} leaves no core.{}", end_of(exit), advice);
  }
  if (!exit.core_dumped) {
    return "The kernel has written no core: the hard limit of core files is 0 (ulimit -Hc), the process may not write "
           "to its directory, the disk is full, or the program changes its user.";
  }
  return "";
}

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code other_disk;
  fs::rename(from, to, other_disk);
  if (other_disk) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
    fs::remove(from, other_disk);
  }
}

std::string maps(const CoreFile& core) {
  std::string text;
  for (const MappedFile& file : core.files) {
    text += fmt::format("{:016x}-{:016x} {:08x} {}\n", file.begin, file.end, file.offset, file.path);
  }
  return text;
}

// "SIGSEGV at address 0x10, which no file is mapped at"
std::string cause(const CoreFile& core) {
  const std::string signal = fmt::format("SIG{}", ::sigabbrev_np(core.signal));
  if (core.sender != 0) {
    return core.sender == core.pid ? fmt::format("the process has sent itself {}", signal)
                                   : fmt::format("{} was sent by process {}", signal, core.sender);
  }
  if (!core.has_address) {
    return signal;
  }
  const MappedFile* const file = core.file_at(core.address);
  return fmt::format("{} at address {:#x}, {}", signal, core.address,
                     file == nullptr ? "where no file is mapped" : "in " + file->path);
}

// Writes backtrace.txt, and returns what it holds in a few words.
std::string write_backtrace(const fs::path& bundle, const CoreFile& core, const std::atomic<bool>& hurry) {
  const fs::path text = bundle / "backtrace.txt";
  const std::string by_hand = fmt::format("gdb {} core", shell_quoted(core.program));
  const TimedCommand debugger =
      run_timed({"gdb", "--batch", "--nx", "-iex", "set debuginfod enabled off", "-ex", "set pagination off", "-ex",
                 "set print thread-events off", "-ex", "thread apply all -ascending backtrace", "-ex",
                 "info sharedlibrary", core.program, (bundle / "core").string()},
                text.string(), kDebuggerWithin, &hurry);
  if (!debugger.started) {
    write(text, fmt::format("gdb is not installed. Where it is, this shows all threads:\n  {}\n", by_hand));
    return "none, gdb is not installed";
  }
  if (!debugger.in_time) {
    std::ofstream(text, std::ios::app) << fmt::format("gdb was ended before it was done. By hand:\n  {}\n", by_hand);
    return "incomplete, gdb was ended before it was done";
  }
  return "backtrace.txt";
}

// Copies the files after --params-file, and returns the command with the paths of the copies.
std::vector<std::string> with_copied_parameters(const Crash& crash, const fs::path& bundle) {
  std::vector<std::string> words = crash.argv;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i - 1] != "--params-file") {
      continue;
    }
    const fs::path file = fs::path(crash.directory) / words[i];
    const fs::path copy = fmt::format("parameters/{}-{}", i, file.filename().string());
    std::error_code failed;
    fs::create_directories(bundle / "parameters", failed);
    if (fs::copy_file(file, bundle / copy, failed)) {
      words[i] = (bundle / copy).string();
    }
  }
  return words;
}

std::string script(const Crash& crash, const std::vector<std::string>& words) {
  std::string text = "#!/bin/sh\n# Runs the process again, in its directory and environment.\n";
  text += fmt::format("cd {} || exit 1\nexec env -i \\\n", shell_quoted(crash.directory));
  for (const auto& [name, value] : crash.environment) {
    if (name != "LAUNCH_PROCESS") {
      text += fmt::format("  {}={} \\\n", shell_quoted(name), shell_quoted(value));
    }
  }
  std::vector<std::string> quoted;
  for (const std::string& word : words) {
    quoted.push_back(shell_quoted(word));
  }
  const std::string command = crash.shell ? "/bin/sh -c " + shell_quoted(fmt::format("{}", fmt::join(words, " ")))
                                          : fmt::format("{}", fmt::join(quoted, " "));
  return text + "  " + command + "\n";
}

std::string summary(const Crash& crash, const std::string& what) {
  const std::time_t time = std::chrono::system_clock::to_time_t(crash.time);
  return fmt::format(
      "{}: {}\n\n"
      "time:       {:%Y-%m-%d %H:%M:%S %z}\n"
      "process id: {}\n"
      "asked for:  {}\n"
      "command:    {}\n"
      "directory:  {}\n",
      crash.process, what, fmt::localtime(time), crash.pid, crash.place.empty() ? "by no launch file" : crash.place,
      fmt::join(crash.argv, " "), crash.directory);
}

// The lines about the core, after it has been put into the bundle.
std::string take_core(const Crash& crash, const fs::path& bundle, const std::atomic<bool>& hurry) {
  const std::string impossible = reason_for_no_core(crash.exit);
  FoundCore found;
  if (impossible.empty()) {
    found = find_core(CoreSetting::of_kernel(), crash.pid, crash.directory, bundle.string());
  }
  if (found.path.empty()) {
    const std::string reason = impossible.empty() ? found.missing : impossible;
    write(bundle / "backtrace.txt", "There is no backtrace. " + reason + "\n");
    return fmt::format("backtrace:  none. {}\n", reason);
  }
  if (fs::path(found.path) != bundle / "core") {
    move_file(found.path, bundle / "core");
  }
  const std::optional<CoreFile> core = read_core_file((bundle / "core").string());
  if (!core) {
    return "backtrace:  none, the core can't be read\n";
  }
  write(bundle / "maps.txt", maps(*core));
  return fmt::format("cause:      {}\nprogram:    {}\nbacktrace:  {}\n", cause(*core), core->program,
                     write_backtrace(bundle, *core, hurry));
}

// The first line of /proc/…, or "" for a thread that has ended.
std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

// "4711 planner waits in futex_wait_queue": names and waits are those of the kernel.
std::string threads(pid_t pid) {
  std::string text;
  std::error_code gone;
  for (fs::directory_iterator thread(fmt::format("/proc/{}/task", pid), gone), end; !gone && thread != end;
       thread.increment(gone)) {
    const std::string waits = first_line(thread->path() / "wchan");
    text += fmt::format("{} {} {}\n", thread->path().filename().string(), first_line(thread->path() / "comm"),
                        waits.empty() || waits == "0" ? "runs" : "waits in " + waits);
  }
  return text.empty() ? "The process has ended meanwhile.\n" : text;
}

// What a bundle of a crash and one of a deadline have in common.
void write_common(const Crash& crash, const fs::path& bundle) {
  write(bundle / "output.log",
        fmt::format("{}{}", fmt::join(crash.last_lines, "\n"), crash.last_lines.empty() ? "" : "\n"));
  write(bundle / "command.sh", script(crash, with_copied_parameters(crash, bundle)));
  fs::permissions(bundle / "command.sh", fs::perms::owner_exec, fs::perm_options::add);
}

fs::path make_directory(const Crash& crash, const fs::path& parent) {
  std::string name = crash.process;
  std::replace(name.begin(), name.end(), '/', '_');
  const std::time_t time = std::chrono::system_clock::to_time_t(crash.time);
  const fs::path bundle = parent / fmt::format("{}-{:%Y%m%d-%H%M%S}-{}", name, fmt::localtime(time), crash.pid);
  fs::create_directories(bundle);
  fs::permissions(bundle, fs::perms::owner_all);
  return bundle;
}

}  // namespace

fs::path write_crash_bundle(const Crash& crash, const fs::path& parent, const std::atomic<bool>& hurry) {
  fs::path bundle = make_directory(crash, parent);
  write(bundle / "crash.txt", summary(crash, describe(crash.exit)));
  write_common(crash, bundle);
  std::ofstream(bundle / "crash.txt", std::ios::app) << take_core(crash, bundle, hurry);
  return bundle;
}

fs::path write_deadline_bundle(const Crash& late, const std::vector<std::string>& reasons, const fs::path& parent,
                               const std::string& file) {
  fs::path bundle = make_directory(late, parent);
  write(bundle / file, summary(late, fmt::format("{}", fmt::join(reasons, ", "))));
  write(bundle / "threads.txt", threads(late.pid));
  std::ifstream maps(fmt::format("/proc/{}/maps", late.pid));
  std::ofstream(bundle / "maps.txt") << maps.rdbuf();
  write_common(late, bundle);
  return bundle;
}

void add_snapshot(const fs::path& bundle, const fs::path& snapshot) {
  std::error_code other_disk;
  const auto recursive = fs::copy_options::recursive;
  fs::copy(snapshot, bundle / "snapshot", recursive | fs::copy_options::create_hard_links, other_disk);
  if (other_disk) {
    fs::copy(snapshot, bundle / "snapshot", recursive | fs::copy_options::overwrite_existing);
  }
}

}  // namespace launch
