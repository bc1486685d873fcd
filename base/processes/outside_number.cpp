// SPDX-License-Identifier: Apache-2.0
#include "base/processes/outside_number.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <charconv>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/pipe.hpp"

namespace launch {
namespace {

struct Outside {
  UniqueFd proc;
  std::map<pid_t, pid_t> known;
};

Outside& outside() {
  static Outside only;
  return only;
}

// What /proc says of a descriptor of a process has the number in the namespace of that /proc. 0: it has gone.
pid_t look(const UniqueFd& proc, pid_t pid) {
  const UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  const std::string path = "self/fdinfo/" + std::to_string(process.get());
  const UniqueFd file(process ? ::openat(proc.get(), path.c_str(), O_RDONLY | O_CLOEXEC) : -1);
  if (!file) {
    return 0;
  }
  const std::string text = "\n" + read_to_end(file);
  constexpr std::string_view kName = "\nPid:\t";
  pid_t number = 0;
  if (const std::size_t begin = text.find(kName); begin != std::string::npos) {
    std::from_chars(text.data() + begin + kName.size(), text.data() + text.size(), number);
  }
  return number > 0 ? number : 0;
}

}  // namespace

void keep_proc_of_outside(UniqueFd proc) {
  outside().proc = std::move(proc);
}

pid_t number_outside(pid_t pid) {
  Outside& numbers = outside();
  if (!numbers.proc || pid <= 0) {
    return pid;
  }
  if (const pid_t found = look(numbers.proc, pid); found != 0) {
    return numbers.known[pid] = found;
  }
  const auto known = numbers.known.find(pid);
  return known == numbers.known.end() ? pid : known->second;
}

}  // namespace launch
