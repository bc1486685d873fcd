// SPDX-License-Identifier: Apache-2.0
// A screen (terminal, pipe, socket or file) that takes whole lines and never holds its writer up for long.
//
// The reader of a pipe may have stopped (`launch … | less`), and so may a terminal (Ctrl-S, a connection that hangs).
// What is not taken at once waits in a queue. If the queue is full, a line waits a moment, so that a reader that reads
// loses nothing. After that the screen is stalled: lines are dropped, without waiting, until half of the queue has been
// taken. A notice on the screen says how many lines are missing there.
//
// A terminal can have a status line below all other lines. It is overwritten in place, cut to the width of the
// terminal, and not drawn while the terminal belongs to another job of the shell.
//
// The descriptor belongs to other processes, too, and stays blocking for them: a pipe or terminal is opened a second
// time through /proc. A regular file and any other device is written as it is. SIGPIPE must be ignored.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class Screen {
 public:
  struct Limits {
    std::size_t queue = 4 * 1024 * 1024;              // bytes
    std::chrono::milliseconds wait_for_room{200};     // with a full queue, for each call of print()
    std::chrono::milliseconds wait_at_the_end{5000};  // in which nothing is taken
  };

  // The loop, which must outlive the screen, writes what waits in the queue; null: further calls of print() do.
  Screen(int fd, EventLoop* loop, Limits limits);
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  ~Screen() = default;  // does not write the queue, see finish()

  // Shows lines, each with its end. `logged`: they are in launch.log, too. False if they are not going to be shown,
  // because the screen is stalled or gone.
  bool print(std::string_view lines, bool logged);

  // Replaces the status line; "" removes it. Does nothing on a screen that is no terminal.
  void show_status(std::string_view text);
  bool can_show_status() const { return terminal_; }

  // The screen goes on after `lines` lines were dropped. Returns the lines that say so.
  using Notice = std::function<std::string(std::size_t lines)>;
  void tell_of_dropped(Notice notice) { notice_ = std::move(notice); }

  // Writes the queue while it is read. Returns what was not taken: the lines that are not logged, and how many lines
  // there were in all. Nothing is shown afterwards.
  struct Rest {
    std::string unlogged;
    std::size_t lines = 0;
  };
  Rest finish();

  bool is_gone() const { return gone_; }

 private:
  struct Chunk {
    std::string text;
    bool logged;
  };
  enum class Kind { kFile, kSocket, kOwnDescription, kSharedDescription };

  // Writes a part of the bytes without waiting. Returns their number; 0 if the screen takes none now, or is gone.
  std::size_t write_some(std::string_view bytes);
  void put(std::string_view bytes, bool logged);
  void erase_status();
  void draw_status();
  void append(std::string_view lines, bool logged);
  bool make_room(std::size_t size);
  void write_queue();
  void resume();
  void watch();

  EventLoop* loop_;
  Limits limits_;
  UniqueFd own_;  // the second description
  int fd_;
  Kind kind_ = Kind::kFile;
  Notice notice_;
  std::deque<Chunk> queue_;
  std::size_t written_ = 0;  // of the first chunk
  std::size_t waiting_ = 0;  // bytes in the queue
  bool gone_ = false;
  bool stalled_ = false;
  std::size_t dropped_ = 0;  // lines
  EventLoop::SourcePtr source_;
  bool terminal_ = false;
  std::string status_;
  bool status_shown_ = false;
};

}  // namespace launch
