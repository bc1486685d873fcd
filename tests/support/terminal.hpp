// SPDX-License-Identifier: Apache-2.0
// A pseudo-terminal that a program runs in, and what its screen shows.
#pragma once

#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <vector>

namespace test_support {

inline constexpr std::chrono::seconds kTerminalPatience{60};

// It knows no more than to move, to clear and to write.
class Terminal {
 public:
  // Starts the program as the leader of a session in a terminal of 24 lines of 80 columns.
  Terminal(std::vector<std::string> words, const std::map<std::string, std::string>& environment,
           const std::filesystem::path& directory = ".") {
    std::vector<char*> argv;
    for (std::string& word : words) {
      argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    winsize size{24, 80, 0, 0};
    pid_ = ::forkpty(&fd_, nullptr, nullptr, &size);
    if (pid_ == 0) {
      for (const auto& [name, value] : environment) {
        ::setenv(name.c_str(), value.c_str(), 1);
      }
      std::error_code ignored;
      std::filesystem::current_path(directory, ignored);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
  }
  ~Terminal() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    if (fd_ >= 0) {
      ::close(fd_);
    }
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& keys) { static_cast<void>(!::write(fd_, keys.data(), keys.size())); }
  void resize(unsigned short lines, unsigned short columns) {
    const winsize size{lines, columns, 0, 0};
    ::ioctl(fd_, TIOCSWINSZ, &size);
  }

  // As when a window is closed. Returns the exit code of the program, -1 after a signal.
  int close() {
    ::close(fd_);
    fd_ = -1;
    return reap();
  }
  pid_t pid() const { return pid_; }
  // Echo, line editing and the like.
  tcflag_t local_modes() const {
    termios modes{};
    ::tcgetattr(fd_, &modes);
    return modes.c_lflag;
  }

  // The line of the screen that holds `text`, or "".
  std::string line_with(const std::string& text) const {
    for (const std::string& line : screen_) {
      if (line.find(text) != std::string::npos) {
        return line;
      }
    }
    return "";
  }
  std::string screen() const {
    std::string all;
    for (const std::string& line : screen_) {
      const std::size_t last = line.find_last_not_of(' ');
      all += last == std::string::npos ? "" : line.substr(0, last + 1) + "\n";
    }
    return all;
  }

  // Reads until a line of the screen holds both texts.
  bool shows(const std::string& text, const std::string& also = {}) {
    return read_until([&] {
      for (const std::string& line : screen_) {
        if (line.find(text) != std::string::npos && line.find(also) != std::string::npos) {
          return true;
        }
      }
      return false;
    });
  }
  // Reads until a line of the screen is this text and nothing else.
  bool shows_line(const std::string& text) {
    return read_until([&] { return ("\n" + screen()).find("\n" + text + "\n") != std::string::npos; });
  }
  bool hides(const std::string& text) {
    return read_until([&] { return line_with(text).empty(); });
  }
  // Reads to the end of the program. Returns its exit code, -1 after a signal.
  int wait() {
    read_until([] { return false; });
    return reap();
  }
  const std::string& everything() const { return everything_; }

 private:
  int reap() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  template <typename Done>
  bool read_until(Done done) {
    const auto end = std::chrono::steady_clock::now() + kTerminalPatience;
    while (!done()) {
      pollfd readable{fd_, POLLIN, 0};
      std::array<char, 4096> bytes{};
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
      if (left <= 0 || ::poll(&readable, 1, static_cast<int>(left)) != 1) {
        return false;
      }
      const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
      if (count <= 0) {
        return false;
      }
      for (ssize_t i = 0; i < count; ++i) {
        take(bytes[static_cast<std::size_t>(i)]);
      }
    }
    return true;
  }

  void take(char byte) {
    everything_ += byte;
    if (!escape_.empty() || byte == '\033') {
      escape_ += byte;
      if (escape_.size() > 2 && byte >= '@') {
        obey();
        escape_.clear();
      }
    } else if (byte == '\r') {
      column_ = 0;
    } else if (byte == '\n') {
      ++line_;
    } else if (byte == '\b') {
      column_ -= column_ > 0 ? 1 : 0;
    } else {
      if (column_ >= 200) {
        column_ = 0;
      }
      if (line_ < screen_.size()) {
        screen_[line_][column_] = byte;
      }
      ++column_;
    }
  }

  // A sequence that the terminal's description has.
  void obey() {
    const char what = escape_.back();
    if (what == 'H') {
      const std::size_t semicolon = escape_.find(';');
      line_ = semicolon == std::string::npos ? 0 : std::stoul(escape_.substr(2)) - 1;
      column_ = semicolon == std::string::npos ? 0 : std::stoul(escape_.substr(semicolon + 1)) - 1;
    } else if (what == 'K' && line_ < screen_.size()) {
      screen_[line_].replace(column_, std::string::npos, std::string(200 - column_, ' '));
    } else if (what == 'J') {
      for (std::size_t line = escape_ == "\033[2J" ? 0 : line_; line < screen_.size(); ++line) {
        screen_[line].assign(200, ' ');
      }
    }
  }

  pid_t pid_ = -1;
  int fd_ = -1;
  std::vector<std::string> screen_ = std::vector<std::string>(60, std::string(200, ' '));
  std::size_t line_ = 0;
  std::size_t column_ = 0;
  std::string escape_;
  std::string everything_;
};

}  // namespace test_support
