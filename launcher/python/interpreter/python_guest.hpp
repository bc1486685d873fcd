// SPDX-License-Identifier: Apache-2.0
// Commands that only look at launch files run Python as a guest: in a process of its own, which can end without them.
//
// The first use of Python forks. The child goes on with the command in place of the parent, and the parent passes its
// exit code on. If Python ends the child (`os.abort()`, `os._exit()`, a null pointer) or reaches a limit, the parent
// forks again, from where it was, with the launch file refused: loading it is an error at the line that Python was at.
// So every command tells of it as it tells of other errors, and goes on with other files. A run has no guest
// (python_watch.hpp).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "launcher/python/interpreter/python_watch.hpp"

namespace launch {

// What a guest may take for one call of Python.
struct GuestLimits {
  std::chrono::seconds time{60};
  std::uint64_t memory = 2ULL << 30U;  // bytes, beyond what the command itself has
};

// Why Python is not called any more for a file, or for an expression.
struct GuestRefusal {
  std::string reason;
  std::uint32_t line = 0;  // of the file, from 1; 0 when it is unknown
  std::string help;
};

// From now on the first use of Python makes a guest. The process must have one thread then.
void run_python_in_a_guest(const GuestLimits& limits);

// Makes the guest now, if one is wanted and this process is none. Returns in the guest, and in a process that needs
// none. `report_deaths` is called in the guest, with a descriptor for the place where Python is when it dies.
void become_guest(void (*report_deaths)(int descriptor));

// The command has its result, or the run has ended. Unless this was called, the end of the process is Python's doing.
void end_of_guest();

// Whether this process is a guest, and with which limits.
std::optional<GuestLimits> guest_limits();

// nullopt while Python may be called for it. `name` is the path of a launch file, or an expression.
std::optional<GuestRefusal> guest_refusal(const std::string& name);

// How long a $(command …) may take; nullopt: as long as it likes.
std::optional<std::chrono::seconds> command_limit();

// For the time of its life Python runs for `name`, in a guest or in a run. Calls nest. `place` is that of an
// expression. A process that Python has forked ends here if it gets so far.
class GuestCall {
 public:
  explicit GuestCall(const std::string& name);
  GuestCall(const std::string& name, PythonPlace place);
  GuestCall(const GuestCall&) = delete;
  GuestCall& operator=(const GuestCall&) = delete;
  ~GuestCall();

 private:
  std::string outer_;
  pid_t process_;
  WatchedCall watched_;
};

}  // namespace launch
