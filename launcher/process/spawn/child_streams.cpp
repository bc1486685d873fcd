// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/spawn/child_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/files/pipe.hpp"
#include "base/processes/process_mark.hpp"

namespace launch {
namespace {

[[noreturn]] void fail_to_make(const char* what) {
  throw std::system_error(errno, std::system_category(), what);
}

// Reads must not block, but the flag must not reach the child: the two ends of a pipe have flags of their own.
void set_nonblocking(const UniqueFd& fd) {
  if (::fcntl(fd.get(), F_SETFL, O_NONBLOCK) != 0) {
    fail_to_make("cannot make a pipe non-blocking");
  }
}

// The process can read its pipe itself. So the pipe has a reader as long as it has a writer, and when the launcher has
// been killed, the process does not die of SIGPIPE before it has cleaned up: the guardian opens the pipe and reads on.
ChildStream make_output_pipe() {
  Pipe pipe = make_pipe();
  set_nonblocking(pipe.read);
  UniqueFd both(::open(fmt::format("/proc/self/fd/{}", pipe.write.get()).c_str(), O_RDWR | O_CLOEXEC));
  return {std::move(pipe.read), both ? std::move(both) : std::move(pipe.write)};
}

// For a process whose descendants may go on after the launch: a full pipe without a reader would stop them.
ChildStream make_plain_pipe() {
  Pipe pipe = make_pipe();
  set_nonblocking(pipe.read);
  return {std::move(pipe.read), std::move(pipe.write)};
}

ChildStream make_pseudo_terminal() {
  ChildStream stream;
  stream.parent.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  if (!stream.parent || ::grantpt(stream.parent.get()) != 0 || ::unlockpt(stream.parent.get()) != 0) {
    fail_to_make("cannot create a pseudo-terminal");
  }
  stream.child.reset(::ioctl(stream.parent.get(), TIOCGPTPEER, O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (!stream.child) {
    fail_to_make("cannot open a pseudo-terminal");
  }
  return stream;
}

UniqueFd copy_of(const UniqueFd& fd) {
  UniqueFd copy(::fcntl(fd.get(), F_DUPFD_CLOEXEC, 0));
  if (!copy) {
    fail_to_make("cannot copy a descriptor");
  }
  return copy;
}

// A program that asks for the size before anybody is attached gets the usual one.
ChildStreams make_own_terminal() {
  const winsize usual{24, 80, 0, 0};
  ChildStreams streams;
  streams.out = make_pseudo_terminal();
  ::ioctl(streams.out.parent.get(), TIOCSWINSZ, &usual);
  streams.in = {copy_of(streams.out.parent), copy_of(streams.out.child)};
  streams.err.child = copy_of(streams.out.child);
  return streams;
}

ChildStream make_output(const ProcessSpec& spec) {
  return spec.emulate_tty                                   ? make_pseudo_terminal()
         : spec.environment.contains(kLeaveRunningVariable) ? make_plain_pipe()
                                                            : make_output_pipe();
}

}  // namespace

ChildStreams make_child_streams(const ProcessSpec& spec, bool has_terminal) {
  if (spec.tty) {
    return make_own_terminal();
  }
  ChildStreams streams;
  if (!has_terminal) {
    Pipe pipe = make_pipe();
    streams.in = {std::move(pipe.write), std::move(pipe.read)};
  }
  streams.out = make_output(spec);
  streams.err = make_output(spec);
  return streams;
}

}  // namespace launch
