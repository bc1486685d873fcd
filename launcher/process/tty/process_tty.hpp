// SPDX-License-Identifier: Apache-2.0
// The terminal of a process with a tty of its own, for those who look at it and type there.
//
// Nobody holds the process up: what it prints is read at once, whether or not somebody looks.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "base/terminal/terminal.hpp"
#include "base/terminal/terminal_modes.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/tty/recent_output.hpp"

namespace launch {

class ProcessTty {
 public:
  explicit ProcessTty(EventLoop& loop) : loop_(loop) {}

  // A run of the process begins, with the end of its terminal that is ours; or it has ended. What was printed before is
  // forgotten at the next beginning.
  void begin(int master);
  void end();
  bool is_open() const { return static_cast<bool>(master_); }
  // "/dev/pts/5", as the process sees it.
  std::string path() const;

  // What the process prints. The observer gets it, too; one at most, null for none.
  void add_output(std::string_view bytes);
  void observe(std::function<void(std::string_view bytes)> observer) { observer_ = std::move(observer); }

  // What a terminal of so many lines needs to show what this one shows: modes, and the last lines. A program on the
  // alternate screen has to draw it again.
  std::string picture(std::size_t lines) const;
  // The lines alone, for what is no terminal.
  std::string_view last_lines(std::size_t most) const { return recent_.last_lines(most); }

  // Sets the size. The process gets SIGWINCH, also when the size is the same: then it draws again for somebody new.
  void resize(const TerminalSize& size);

  // Types a text, as much of it as the terminal takes now. Returns how much that was.
  std::size_t type(std::string_view text);
  // Calls back once when the terminal takes more, or has ended.
  void when_room(EventLoop::Callback callback);

 private:
  EventLoop& loop_;
  UniqueFd master_;
  EventLoop::SourcePtr room_;
  EventLoop::Callback on_room_;
  RecentOutput recent_;
  TerminalModes modes_;
  std::function<void(std::string_view)> observer_;
};

}  // namespace launch
