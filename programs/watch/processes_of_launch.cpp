// SPDX-License-Identifier: Apache-2.0
#include "programs/watch/processes_of_launch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/files/small_file.hpp"
#include "base/processes/process_mark.hpp"

namespace launch {
namespace {

// The label in a mark "ID:SIGTERM_TIMEOUT:SIGKILL_TIMEOUT:SCREEN:LABEL" of the launch; nullopt: of another one.
std::optional<std::string> label_in(std::string_view mark, std::string_view launch) {
  constexpr int kPartsBefore = 4;
  if (!mark.starts_with(launch) || !mark.substr(launch.size()).starts_with(':')) {
    return std::nullopt;
  }
  for (int i = 0; i < kPartsBefore; ++i) {
    const std::size_t colon = mark.find(':');
    if (colon == std::string_view::npos) {
      return std::nullopt;
    }
    mark.remove_prefix(colon + 1);
  }
  return std::string(mark);
}

bool has_ended(const UniqueFd& pidfd) {
  pollfd ended{pidfd.get(), POLLIN, 0};
  return !pidfd || poll(&ended, 1, 0) > 0;
}

}  // namespace

ProcessesOfLaunch::Process& ProcessesOfLaunch::find(std::int64_t vpid) {
  Process& process = processes_[vpid];
  if (process.pidfd && !has_ended(process.pidfd)) {
    return process;
  }
  // A process that has ended keeps its label until another one has its number.
  UniqueFd pidfd(static_cast<int>(syscall(SYS_pidfd_open, static_cast<pid_t>(vpid), 0)));
  if (!pidfd || has_ended(pidfd)) {
    return process;
  }
  const std::string environment = read_small_file(fmt::format("/proc/{}/environ", vpid)).value_or("");
  process = {std::nullopt, std::move(pidfd)};
  const std::string variable = std::string(kMarkVariable) + "=";
  for (std::string_view rest = environment; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find('\0'));
    if (entry.starts_with(variable)) {
      process.label = label_in(entry.substr(variable.size()), launch_);
    }
    rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
  }
  return process;
}

std::optional<std::string> ProcessesOfLaunch::label(std::int64_t vpid) {
  return find(vpid).label;
}

bool ProcessesOfLaunch::lives(std::int64_t vpid) {
  const auto known = processes_.find(vpid);
  return known != processes_.end() && !has_ended(known->second.pidfd);
}

}  // namespace launch
