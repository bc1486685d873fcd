// SPDX-License-Identifier: Apache-2.0
// The language server: answers an editor's requests, and checks its documents in processes of their own.
#pragma once

#include <sys/types.h>

#include <deque>
#include <optional>
#include <string>

#include "base/files/unique_fd.hpp"
#include "programs/launch/lsp/message_stream.hpp"
#include "programs/launch/lsp/workspace.hpp"

namespace launch::lsp {

struct ServerOptions {
  bool runs_python = false;  // may run Python launch files, in a process of their own; an editor can ask for it, too
};

class Server {
 public:
  // Reads from `in` and writes to `out`, which stay open.
  Server(ServerOptions options, int in, int out);
  ~Server();

  // Until the editor ends the connection. The exit code of the protocol: 0 after "shutdown", otherwise 1.
  int run();

 private:
  // A check of one document, by a child that writes the diagnostics into a pipe.
  struct Check {
    std::string path;
    pid_t process;
    UniqueFd result;
    std::string text;
  };

  void take(const Json& message);
  Json answer(const std::string& method, const Json& parameters);
  void notice(const std::string& method, const Json& parameters);
  Json initialize(const Json& parameters);

  void send(const Json& message);
  void answer_with(const Json& id, Json result);
  void answer_with_error(const Json& id, int code, const std::string& message);

  void check_later(const std::string& path);
  void begin_check();
  void read_check();
  void end_check();
  void publish(const std::string& path, Json diagnostics);

  ServerOptions options_;
  int in_;
  int out_;
  MessageReader reader_;
  std::optional<Workspace> workspace_;  // from "initialize" on
  std::string folder_;
  std::deque<std::string> to_check_;
  std::optional<Check> check_;
  bool initialized_ = false;
  bool shut_down_ = false;
  bool ended_ = false;
};

}  // namespace launch::lsp
