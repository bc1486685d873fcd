// SPDX-License-Identifier: Apache-2.0
// What the two sides of `--on COMMAND` say to each other, through the standard input and output of the connecting
// command. The other side begins with a line of text, so that whatever a login prints before can be passed over:
//
//   launch-remote 1 0.1.0        the version of this protocol, and that of launch there
//
// Behind it stand messages, both ways: a byte for the kind, four for the length, the highest first, and the content.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/terminal/terminal.hpp"

namespace launch {

inline constexpr std::string_view kRemoteGreeting = "launch-remote ";
inline constexpr int kRemoteVersion = 1;

enum class RemoteKind : char {
  kRequest = 'R',  // to the other side, first and once: a RemoteRequest
  kInput = 'I',    // to the other side: keys for the terminal of the command, or its standard input; empty: the end
  kSize = 'S',     // to the other side: "LINES COLUMNS", the terminal has another size
  kSignal = 'K',   // to the other side: the number of a signal for the command
  kOutput = 'O',   // from the other side: bytes of its standard output, or of its terminal
  kError = 'E',    // from the other side: bytes of its standard error
  kExit = 'X'      // from the other side, last: the exit code
};

struct RemoteMessage {
  RemoteKind kind;
  std::string content;
};

// What is to be run.
struct RemoteRequest {
  std::vector<std::string> words;                  // those after `launch`
  std::map<std::string, std::string> environment;  // variables that say what this terminal can show
  std::optional<TerminalSize> terminal;            // the command gets a terminal of this size
  bool input = false;                              // without a terminal: it gets what is read here
};

std::string to_text(const RemoteRequest& request);
// Throws std::runtime_error.
RemoteRequest parse_remote_request(std::string_view text);

std::string to_text(const TerminalSize& size);
// 24 lines of 80 columns if the text says no size.
TerminalSize parse_size(std::string_view text);

// "launch-remote 1 0.1.0", with the end of the line.
std::string greeting_line(std::string_view launch_version);
struct Greeting {
  int version = 0;
  std::string launch_version;
};
// Nothing for another line. The line has no end, but may have a carriage return.
std::optional<Greeting> parse_greeting(std::string_view line);

std::string encode(RemoteKind kind, std::string_view content);

// Writes to a blocking descriptor. False when nobody reads any more; SIGPIPE must be ignored.
bool write_all(int fd, std::string_view bytes);

// Takes bytes as they come, and gives the messages in them.
class RemoteMessages {
 public:
  static constexpr std::size_t kLongest = std::size_t{1024} * 1024;

  void add(std::string_view bytes) { buffer_ += bytes; }
  // Nothing until a message is complete. Throws std::runtime_error for a message that is too long: what comes is no
  // message.
  std::optional<RemoteMessage> take();

 private:
  std::string buffer_;
};

}  // namespace launch
