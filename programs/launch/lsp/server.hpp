// SPDX-License-Identifier: Apache-2.0
// The language server: answers an editor's requests, and checks its documents in processes of their own.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "programs/launch/lsp/message_stream.hpp"
#include "programs/launch/lsp/workspace.hpp"

namespace launch::lsp {

struct ServerOptions {
  // An editor can ask for all of them, too.
  bool runs_python = false;    // may run Python launch files, in a process of their own
  bool checks_folder = false;  // checks all launch files of the folder, also those that are not open
  std::string trace{};         // the directory of a recorded run, whose names are completed and checked; "": none
};

// False if not all could be written.
bool write_all(int fd, std::string_view text);

class Server {
 public:
  // Reads from `in` and writes to `out`, which stay open.
  Server(ServerOptions options, int in, int out);
  ~Server();

  // Until the editor ends the connection. The exit code of the protocol: 0 after "shutdown", otherwise 1.
  int run();

 private:
  // A check of one document, or of several files of the folder, by a child that writes a line for each into a pipe.
  struct Check {
    std::deque<std::string> paths;  // whose lines have not come yet
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
  void check_folder();
  void check_those_that_name(const std::string& path);
  std::deque<std::string> next_to_check();
  void begin_check();
  [[noreturn]] void run_check(const std::deque<std::string>& paths, int result);
  void take_result(const std::string& line);
  void read_check();
  void end_check();
  void publish(const std::string& path, Json diagnostics);

  ServerOptions options_;
  int in_;
  int out_;
  MessageReader reader_;
  std::optional<Workspace> workspace_;  // from "initialize" on
  std::string folder_;
  bool refreshes_lenses_ = false;                 // the editor asks for lenses again when it is told to
  std::set<std::string> folder_files_;            // those that are checked though they are not open
  std::map<std::string, std::int64_t> versions_;  // of open documents, as the editor counts them
  std::map<std::string, std::size_t> processes_;  // that a file starts, from its last check
  std::deque<std::string> to_check_;
  std::set<std::string> run_next_;  // Python files whose text is that of the disk: the next check may run them
  std::optional<Check> check_;
  bool initialized_ = false;
  bool shut_down_ = false;
  bool ended_ = false;
};

}  // namespace launch::lsp
