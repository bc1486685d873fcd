// SPDX-License-Identifier: Apache-2.0
// The checks of the server's documents, each in a process of its own.
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "launcher/python/interpreter/python_guest.hpp"
#include "programs/launch/lsp/features.hpp"
#include "programs/launch/lsp/python_features.hpp"
#include "programs/launch/lsp/server.hpp"

namespace launch::lsp {

void Server::check_folder() {
  const std::set<std::string> before = std::exchange(folder_files_, files_below(folder_, {}, false));
  for (const std::string& path : before) {
    if (!folder_files_.contains(path) && workspace_->find(path) == nullptr) {
      publish(path, Json::array());
    }
  }
  for (const std::string& path : folder_files_) {
    check_later(path);
  }
}

// Files of the folder that may include this one.
void Server::check_those_that_name(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  for (const std::string& other : folder_files_) {
    const std::optional<Document> document =
        other == path || workspace_->find(other) != nullptr ? std::nullopt : workspace_->document(other);
    if (document && document->text().find(name) != std::string::npos) {
      check_later(other);
    }
  }
}

void Server::check_later(const std::string& path) {
  if (path.empty()) {
    return;
  }
  if (check_ && std::find(check_->paths.begin(), check_->paths.end(), path) != check_->paths.end()) {
    for (const std::string& other : check_->paths) {
      if (other != path) {
        to_check_.push_back(other);
      }
    }
    end_check();
  }
  std::erase(to_check_, path);
  to_check_.push_back(path);
}

// One open document, which somebody looks at, or several files of the folder.
std::deque<std::string> Server::next_to_check() {
  constexpr std::size_t kMost = 32;
  const auto is_open = [&](const std::string& path) { return workspace_->find(path) != nullptr; };
  std::erase_if(to_check_, [&](const std::string& path) { return !is_open(path) && !folder_files_.contains(path); });
  std::deque<std::string> paths;
  if (const auto open = std::find_if(to_check_.begin(), to_check_.end(), is_open); open != to_check_.end()) {
    paths.push_back(std::move(*open));
    to_check_.erase(open);
  }
  while (!to_check_.empty() && paths.size() < kMost && (paths.empty() || !is_open(paths.front()))) {
    paths.push_back(std::move(to_check_.front()));
    to_check_.pop_front();
  }
  return paths;
}

void Server::begin_check() {
  std::deque<std::string> paths = next_to_check();
  std::array<int, 2> ends{};
  if (paths.empty() || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return;
  }
  if (std::any_of(paths.begin(), paths.end(), is_python)) {
    prepare_python_findings();
  }
  UniqueFd result(ends[0]);
  const UniqueFd write_end(ends[1]);
  const pid_t server = ::getpid();
  const pid_t process = ::fork();
  if (process == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != server) {
      ::_exit(EXIT_FAILURE);
    }
    run_check(paths, write_end.get());
  }
  if (process > 0) {
    check_.emplace(Check{std::move(paths), process, std::move(result), {}});
  }
}

// In the child.
void Server::run_check(const std::deque<std::string>& paths, int result) {
  // What a launch file prints must not get among the messages.
  const UniqueFd nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
  ::dup2(nowhere.get(), STDIN_FILENO);
  ::dup2(nowhere.get(), STDOUT_FILENO);
  bool written = true;
  for (const std::string& path : paths) {
    const Document document = workspace_->document(path).value_or(Document(""));
    const bool only_reads = is_python(path) && !(options_.runs_python && run_next_.contains(path));
    if (!only_reads) {
      run_python_in_a_guest({std::chrono::seconds(20)});
    }
    const Json found = only_reads ? Json{{"diagnostics", python_findings(*workspace_, reading_of(path, document))}}
                                  : check_document(*workspace_, {path, document, {}});
    written = written && write_all(result, found.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  }
  end_of_guest();
  ::_exit(written ? EXIT_SUCCESS : EXIT_FAILURE);
}

void Server::read_check() {
  std::array<char, 64UL << 10U> bytes{};
  const ssize_t count = ::read(check_->result.get(), bytes.data(), bytes.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) {
    return;
  }
  if (count > 0) {
    check_->text.append(bytes.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end = check_->text.find('\n'); end != std::string::npos; end = check_->text.find('\n', begin)) {
      take_result(check_->text.substr(begin, end - begin));
      begin = end + 1;
    }
    check_->text.erase(0, begin);
    return;
  }
  // A file that has ended the child has no result; those behind it have their turn.
  std::deque<std::string> rest = std::move(check_->paths);
  end_check();
  if (!rest.empty()) {
    rest.pop_front();
    to_check_.insert(to_check_.begin(), rest.begin(), rest.end());
  }
}

void Server::take_result(const std::string& line) {
  if (check_->paths.empty()) {
    return;
  }
  const std::string path = std::move(check_->paths.front());
  check_->paths.pop_front();
  Json found = Json::parse(line, nullptr, false);
  if (found.is_discarded()) {
    return;
  }
  publish(path, std::move(found["diagnostics"]));
  const auto known = processes_.find(path);
  const auto processes = found.find("processes");
  if (processes == found.end() || (known != processes_.end() && known->second == processes->get<std::size_t>())) {
    return;
  }
  processes_[path] = processes->get<std::size_t>();
  if (refreshes_lenses_ && workspace_->find(path) != nullptr) {
    send({{"jsonrpc", "2.0"}, {"id", "lenses"}, {"method", "workspace/codeLens/refresh"}});
  }
}

void Server::end_check() {
  if (check_) {
    ::kill(check_->process, SIGKILL);
    while (::waitpid(check_->process, nullptr, 0) < 0 && errno == EINTR) {
    }
    check_.reset();
  }
}

}  // namespace launch::lsp
