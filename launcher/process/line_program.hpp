// SPDX-License-Identifier: Apache-2.0
// The launcher's end of a program of its own that speaks in lines over a socket, such as launch-ros-client.
//
// The program has a session of its own, so that Ctrl-C does not reach it. It ends when its socket closes, and so also
// when the launcher is killed.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class LineProgram : public std::enable_shared_from_this<LineProgram> {
 public:
  // Stands in the descriptors of a program for its end of the socket.
  static constexpr int kSocket = -3;

  struct Observer {
    std::function<void(std::string_view)> line;       // without its end
    std::function<void(const std::string& how)> end;  // of the program, unasked: "was ended by SIGKILL"
  };

  // `longest_end`: from close() on the program has so long until it is killed. The loop must outlive the object.
  LineProgram(EventLoop& loop, std::chrono::milliseconds longest_end) : loop_(loop), longest_end_(longest_end) {}
  // Waits for the program.
  ~LineProgram();
  LineProgram(const LineProgram&) = delete;
  LineProgram& operator=(const LineProgram&) = delete;

  // Once. Throws std::system_error.
  void start(ChildProgram child, Observer observer);

  // Never waits: a program that hangs must not stop the launcher.
  void write(const std::string& line);
  // After it the program ends by itself, and nobody is told of it.
  void close();
  bool is_open() const { return static_cast<bool>(socket_); }

 private:
  void flush();
  void on_readable();
  int reap();

  EventLoop& loop_;
  std::chrono::milliseconds longest_end_;
  Observer observer_;
  UniqueFd socket_;
  pid_t pid_ = -1;
  EventLoop::SourcePtr readable_;
  EventLoop::SourcePtr retry_;
  std::string unwritten_;
  std::string unread_;  // the beginning of a line
};

}  // namespace launch
