// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/tty/process_tty.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <utility>

namespace launch {
namespace {

unsigned short as_short(std::size_t number) {
  return static_cast<unsigned short>(std::min<std::size_t>(number, std::numeric_limits<unsigned short>::max()));
}

}  // namespace

void ProcessTty::begin(int master) {
  end();
  recent_.clear();
  modes_ = TerminalModes();
  // The other copies belong to those who read it and who write to the standard input of the process.
  master_.reset(::fcntl(master, F_DUPFD_CLOEXEC, 0));
}

void ProcessTty::end() {
  room_.reset();
  master_.reset();
  if (const EventLoop::Callback callback = std::exchange(on_room_, nullptr)) {
    callback();
  }
}

std::string ProcessTty::path() const {
  std::array<char, 64> name{};
  return ::ptsname_r(master_.get(), name.data(), name.size()) == 0 ? name.data() : "";
}

void ProcessTty::add_output(std::string_view bytes) {
  recent_.add(bytes);
  modes_.add(bytes);
  if (observer_) {
    observer_(bytes);
  }
}

std::string ProcessTty::picture(std::size_t lines) const {
  return modes_.entering() + (modes_.on_alternate_screen() ? std::string() : std::string(recent_.last_lines(lines)));
}

void ProcessTty::resize(const TerminalSize& size) {
  if (!master_ || size.lines == 0 || size.columns == 0) {
    return;
  }
  const winsize wanted{as_short(size.lines), as_short(size.columns), 0, 0};
  winsize now{};
  if (::ioctl(master_.get(), TIOCGWINSZ, &now) == 0 && now.ws_row == wanted.ws_row && now.ws_col == wanted.ws_col) {
    // The system sends the signal only after a change.
    pid_t foreground = 0;
    if (::ioctl(master_.get(), TIOCGPGRP, &foreground) == 0 && foreground > 0) {
      ::kill(-foreground, SIGWINCH);
    }
    return;
  }
  ::ioctl(master_.get(), TIOCSWINSZ, &wanted);
}

std::size_t ProcessTty::type(std::string_view text) {
  std::size_t taken = 0;
  while (master_ && taken < text.size()) {
    const ssize_t count = ::write(master_.get(), text.data() + taken, text.size() - taken);
    if (count > 0) {
      taken += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      break;
    }
  }
  return taken;
}

void ProcessTty::when_room(EventLoop::Callback callback) {
  on_room_ = std::move(callback);
  if (!master_ || room_) {
    return;
  }
  room_ = loop_.on_writable(master_.get(), [this] {
    room_.reset();
    if (const EventLoop::Callback then = std::exchange(on_room_, nullptr)) {
      then();
    }
  });
}

}  // namespace launch
