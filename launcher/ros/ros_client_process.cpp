// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_client_process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/process/isolation/namespaces.hpp"
#include "launcher/process/line_program.hpp"
#include "launcher/ros/ros_program.hpp"
#include "launcher/ros/ros_protocol.hpp"

namespace launch {

namespace {

constexpr const char* kProgram = "launch-ros-client";

constexpr std::chrono::milliseconds kEndLimit{1000};

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

}  // namespace

// One running program, and the requests that it has not answered yet.
class RosClientProcess::Connection : public std::enable_shared_from_this<Connection> {
 public:
  // Throws std::system_error.
  Connection(EventLoop& loop, const std::string& program, const Namespaces* namespaces, const Environment& environment);

  RosRequestId send(const RosRequest& request, Duration timeout, Done done);
  void cancel(RosRequestId id);
  // Closes the socket, after which the program ends by itself.
  void close() { running_->close(); }
  bool is_open() const { return running_->is_open(); }

 private:
  void on_line(std::string_view line);
  void lose(const std::string& how);

  std::shared_ptr<LineProgram> running_;
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
    : running_(std::make_shared<LineProgram>(loop, kEndLimit)) {
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
      .descriptors = {{STDIN_FILENO, LineProgram::kSocket}, {STDOUT_FILENO, kDevNull}},
  };
  if (namespaces != nullptr) {
    namespaces->put_in(child);
  }
  running_->start(std::move(child), {.line = [this](std::string_view line) { on_line(line); },
                                     .end = [this](const std::string& how) { lose(how); }});
}

RosRequestId RosClientProcess::Connection::send(const RosRequest& request, Duration timeout, Done done) {
  const RosRequestId id = ++last_id_;
  pending_.emplace(id, std::move(done));
  running_->write(to_line(RosRequestLine{id, request, timeout}));
  return id;
}

void RosClientProcess::Connection::cancel(RosRequestId id) {
  if (pending_.erase(id) != 0 && is_open()) {
    running_->write(to_line(RosRequestLine{id, std::nullopt, Duration(0)}));
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

void RosClientProcess::Connection::lose(const std::string& how) {
  const auto self = shared_from_this();  // an answer may lead to a request that starts another program
  RosAnswer lost;
  lost.client_lost = true;
  lost.error = fmt::format("{} {}", kProgram, how);
  while (!pending_.empty()) {
    const Done done = std::move(pending_.extract(pending_.begin()).mapped());
    done(lost);
  }
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
