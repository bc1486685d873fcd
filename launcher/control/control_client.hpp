// SPDX-License-Identifier: Apache-2.0
// The other side of a control socket: asks a launch and follows what happens in it.
#pragma once

#include <chrono>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "launcher/control/control_socket.hpp"

namespace launch {

// A sentence for the user. The launch can't do what it was asked for, or does not answer.
class ControlError : public std::runtime_error {
 public:
  explicit ControlError(const std::string& what, std::string help = {})
      : std::runtime_error(what), help_(std::move(help)) {}

  const std::string& help() const { return help_; }

 private:
  std::string help_;
};

class ControlClient {
 public:
  using Json = nlohmann::ordered_json;

  explicit ControlClient(FoundLaunch found) : found_(std::move(found)) {}

  pid_t pid() const { return found_.pid; }
  // The owner of the launch if that is another user, else "".
  const std::string& user() const { return found_.user; }
  // Readable when next() has something.
  int fd() const { return found_.socket.get(); }

  // Sends a request and waits for the answer. `request` gets the version. Throws ControlError when the launch refuses,
  // has ended, or does not answer for a while (it may be stopped).
  Json ask(const Json& request);
  Json ask(const char* what) { return ask(Json{{"do", what}}); }
  // As ask(), but returns the line of the answer as it is, also a refusal. Only for a client that follows nothing.
  std::string ask_for_line(const Json& request);

  // Sends a request without waiting: next() gives the answer.
  void tell(const Json& request) { send_request(request); }

  // What the launch tells, after a request for it: waits for the next line. Nothing when the launch has ended, or when
  // the time is over.
  std::optional<Json> next();
  std::optional<Json> next(std::chrono::milliseconds patience);
  // Whether the launch has ended.
  bool ended() const { return ended_; }

 private:
  void send_request(const Json& request);
  // Waits until `has_answer` returns true.
  template <typename HasAnswer>
  void wait_for_answer(const HasAnswer& has_answer);
  std::optional<Json> take(bool answer);
  bool receive(int patience);
  [[noreturn]] void throw_no_answer() const;
  void send(std::string_view text);

  FoundLaunch found_;
  std::string buffer_;
  std::deque<Json> events_;
  bool ended_ = false;
};

// The launch that is meant: the only one of this user that runs, or the one of this number or with a launch file of
// this name or path, for root also of another user. Throws ControlError.
ControlClient choose_launch(const Environment& environment, const std::string& wanted);
// "system.launch.xml, left.launch.xml", of an answer to "info" or "ps".
std::string files_of(const ControlClient::Json& answer);

}  // namespace launch
