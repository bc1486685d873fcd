// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_client_process.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/process/isolation/namespaces.hpp"
#include "launcher/ros/ros_program.hpp"
#include "launcher/ros/ros_protocol.hpp"

namespace launch {

namespace {

constexpr const char* kProgram = "launch-ros-client";

constexpr std::chrono::milliseconds kEndLimit{1000};
// Time between tries to write to a client that doesn't read.
constexpr std::chrono::milliseconds kWriteRetry{10};

// Whether the variable chooses a graph, or how Fast DDS reaches it.
bool chooses_graph(const std::string& variable) {
  for (const char* const prefix :
       {"ROS_DOMAIN_ID", "ROS_LOCALHOST_ONLY", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS",
        "ROS_DISCOVERY_SERVER", "ROS_SECURITY_", "ROS_SUPER_CLIENT", "RMW_", "FASTRTPS_", "FASTDDS_"}) {
    if (variable.starts_with(prefix)) {
      return true;
    }
  }
  return false;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("was ended by SIG{}", sigabbrev_np(WTERMSIG(status)));
  }
  return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

// One running program. The destructor closes the socket and waits for the program.
class RosClientProcess::Connection : public std::enable_shared_from_this<Connection> {
 public:
  // Throws std::system_error.
  Connection(EventLoop& loop, const std::string& program, const Namespaces* namespaces, const Environment& environment);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  RosRequestId send(const RosRequest& request, Duration timeout, Done done);
  void cancel(RosRequestId id);
  // Closes the socket, after which the program ends by itself.
  void close();
  bool is_open() const { return static_cast<bool>(socket_); }

 private:
  void write(const std::string& line);
  void flush();
  void on_readable();
  void on_line(std::string_view line);
  void lose();
  // Returns its wait status. Kills the program when it takes too long.
  int reap();

  EventLoop& loop_;
  UniqueFd socket_;
  pid_t pid_ = -1;
  EventLoop::SourcePtr readable_;
  EventLoop::SourcePtr retry_;
  std::string unwritten_;
  std::string unread_;  // the beginning of a line
  RosRequestId last_id_ = 0;
  std::map<RosRequestId, Done> pending_;
};

// The source that ask() returns.
class RosClientProcess::Ticket final : public EventLoop::Source {
 public:
  Ticket(std::weak_ptr<Connection> connection, RosRequestId id) : connection_(std::move(connection)), id_(id) {}
  ~Ticket() override {
    if (const auto connection = connection_.lock()) {
      connection->cancel(id_);
    }
  }

 private:
  std::weak_ptr<Connection> connection_;
  RosRequestId id_;
};

RosClientProcess::Connection::Connection(EventLoop& loop, const std::string& program, const Namespaces* namespaces,
                                         const Environment& environment)
    : loop_(loop) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::system_error(errno, std::system_category(), "cannot create a socket for launch-ros-client");
  }
  socket_.reset(ends[0]);
  const UniqueFd other(ends[1]);

  Environment::Variables variables = environment.variables();
  if (!is_of_companion(program)) {
    // The program has its libraries beside it, and those of another installation of ROS 2 must not come before them.
    variables.erase("LD_LIBRARY_PATH");
  }
  variables.erase("LD_PRELOAD");                  // meant for nodes
  variables["TRACETOOLS_RUNTIME_DISABLE"] = "1";  // the launcher's own messages are no part of a trace
  ChildProgram child{
      .program = program,
      .argv = {kProgram, fmt::format("launch_ros_{}", ::getpid())},
      .environment = &variables,
      .descriptors = {{STDIN_FILENO, other.get()}, {STDOUT_FILENO, kDevNull}},
      .group = ChildGroup::kOwnSession,
      .signals = ChildSignals::kFresh,
  };
  if (namespaces != nullptr) {
    namespaces->put_in(child);
  }
  pid_ = spawn(child);
  readable_ = loop_.on_readable(socket_.get(), [this] { on_readable(); });
}

RosClientProcess::Connection::~Connection() {
  close();
  if (pid_ > 0) {
    reap();
  }
}

RosRequestId RosClientProcess::Connection::send(const RosRequest& request, Duration timeout, Done done) {
  const RosRequestId id = ++last_id_;
  pending_.emplace(id, std::move(done));
  write(to_line(RosRequestLine{id, request, timeout}));
  return id;
}

void RosClientProcess::Connection::cancel(RosRequestId id) {
  if (pending_.erase(id) != 0 && is_open()) {
    write(to_line(RosRequestLine{id, std::nullopt, Duration(0)}));
  }
}

void RosClientProcess::Connection::close() {
  readable_.reset();
  retry_.reset();
  socket_.reset();
}

void RosClientProcess::Connection::write(const std::string& line) {
  unwritten_ += line;
  if (!retry_) {
    flush();
  }
}

// Never waits: a client that hangs must not stop the launcher. on_readable() notices a client that has ended.
void RosClientProcess::Connection::flush() {
  retry_.reset();
  while (!unwritten_.empty()) {
    const ssize_t count = ::send(socket_.get(), unwritten_.data(), unwritten_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      if (errno == EAGAIN || errno == EWOULDBLOCK) {
        retry_ = loop_.after(kWriteRetry, [this] { flush(); });
      }
      return;
    }
    unwritten_.erase(0, static_cast<std::size_t>(count));
  }
}

void RosClientProcess::Connection::on_readable() {
  const auto self = shared_from_this();  // an answer may lead to a request that starts another program
  std::array<char, 4096> buffer{};
  const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (count <= 0) {
    lose();
    return;
  }
  unread_.append(buffer.data(), static_cast<std::size_t>(count));
  std::size_t end = 0;
  while (is_open() && (end = unread_.find('\n')) != std::string::npos) {
    const std::string line = unread_.substr(0, end);
    unread_.erase(0, end + 1);
    on_line(line);
  }
}

void RosClientProcess::Connection::on_line(std::string_view text) {
  const RosAnswerLine line = parse_answer_line(text);
  const auto found = pending_.find(line.id);
  if (found == pending_.end()) {
    return;  // cancelled meanwhile
  }
  const Done done = found->second;  // outlives its own cancellation
  done(line.answer);
}

void RosClientProcess::Connection::lose() {
  close();
  RosAnswer lost;
  lost.client_lost = true;
  lost.error = fmt::format("launch-ros-client {}", how_it_ended(reap()));
  while (!pending_.empty()) {
    const Done done = std::move(pending_.extract(pending_.begin()).mapped());
    done(lost);
  }
}

int RosClientProcess::Connection::reap() {
  if (!ends_within(pid_, kEndLimit)) {
    ::kill(pid_, SIGKILL);
  }
  const int status = wait_for(pid_);
  pid_ = -1;
  return status;
}

RosClientProcess::RosClientProcess(EventLoop& loop, const Namespaces* namespaces, std::string program)
    : loop_(loop), program_(std::move(program)), namespaces_(namespaces) {}

RosClientProcess::~RosClientProcess() {
  close();  // closes all sockets first, then waits for each program
}

EventLoop::SourcePtr RosClientProcess::ask(const RosRequest& request, const Environment& environment, Duration timeout,
                                           Done done) {
  Environment graph;
  for (const auto& [name, value] : environment) {
    if (chooses_graph(name)) {
      graph.emplace(name, value);
    }
  }
  auto found = connections_.end();
  std::string error;
  try {
    const std::string program = program_.empty() ? ros_program(kProgram, environment) : program_;
    found = connections_.find({program, graph});
    if (found == connections_.end() || !found->second->is_open()) {
      auto connection = std::make_shared<Connection>(loop_, program, namespaces_, environment);
      found = connections_.insert_or_assign({program, std::move(graph)}, std::move(connection)).first;
    }
  } catch (const LaunchError& given) {
    const Diagnostic& first = given.diagnostics().front();
    error = fmt::format("{}: {}", first.message, first.help);
  } catch (const std::system_error& given) {
    const bool is_missing = given.code() == std::errc::no_such_file_or_directory && program_.empty();
    error = is_missing ? "a request to a node " + needs_missing_file(kProgram) : given.what();
  }
  if (!error.empty()) {
    RosAnswer lost;
    lost.client_lost = true;
    lost.error = std::move(error);
    return loop_.after(Duration(0), [done = std::move(done), lost = std::move(lost)] { done(lost); });
  }
  const RosRequestId id = found->second->send(request, timeout, std::move(done));
  return std::make_unique<Ticket>(found->second, id);
}

void RosClientProcess::close() {
  for (const auto& [key, connection] : connections_) {
    connection->close();
  }
}

}  // namespace launch
