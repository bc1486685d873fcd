// SPDX-License-Identifier: Apache-2.0
#include "programs/watch/node_watch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <sstream>
#include <utility>

#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"

namespace launch {
namespace {

constexpr char kEndOfText = '\f';

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

NodeWatch::NodeWatch(Tells tells) : tells_(tells), lines_{"A recording of the nodes begins."} {
  ::signal(SIGPIPE, SIG_IGN);  // launch-watch may have ended when a width is written
  start();
}

void NodeWatch::start() {
  Pipe input = make_pipe();
  Pipe output = make_pipe();
  const std::string program = own_library_file("launch-watch");
  std::vector<std::string> argv = {program};
  if (tells_ == Tells::kMetrics) {
    argv.emplace_back("--metrics");
  }
  pid_ = spawn({.program = program,
                .argv = std::move(argv),
                .descriptors = {{STDIN_FILENO, input.read.get()},
                                {STDOUT_FILENO, output.write.get()},
                                {STDERR_FILENO, kDevNull}},
                .group = ChildGroup::kOwnSession,
                .signals = ChildSignals::kFresh});
  input_ = std::move(input.write);
  output_ = std::move(output.read);
}

NodeWatch::~NodeWatch() {
  end();
}

void NodeWatch::set_width(std::size_t columns) {
  if (columns == width_ || !input_) {
    return;
  }
  width_ = columns;
  write_width();
}

void NodeWatch::write_width() {
  const std::string line = fmt::format("{}\n", width_);
  // A program that has ended says why, see read_some().
  [[maybe_unused]] const ssize_t written = ::write(input_.get(), line.data(), line.size());
}

void NodeWatch::update() {
  for (pollfd readable{output_.get(), POLLIN, 0}; output_ && ::poll(&readable, 1, 0) > 0;) {
    if (!read_some()) {
      output_.reset();
      begin_again_after_crash();
    }
    readable.fd = output_.get();
  }
}

// libbabeltrace2 2.1 is ended by SIGSEGV if it attaches when LTTng has described the session, but none of its streams.
void NodeWatch::begin_again_after_crash() {
  constexpr int kMostRestarts = 2;
  const int status = wait_for(std::exchange(pid_, -1));
  if (!WIFSIGNALED(status)) {
    return;  // it has said why it ends
  }
  const std::string how = fmt::format("launch-watch was ended by SIG{}", ::sigabbrev_np(WTERMSIG(status)));
  if (restarts_++ == kMostRestarts) {
    lines_ = {how};
    return;
  }
  received_.clear();
  metrics_.clear();  // old figures are no figures
  try {
    start();
  } catch (const SpawnError& error) {
    lines_ = {how, error.what()};
    return;
  }
  if (width_ > 0) {
    write_width();
  }
  lines_ = {how + ". The recording of the nodes begins anew."};
}

bool NodeWatch::read_some() {
  std::array<char, 65'536> bytes{};
  const ssize_t count = ::read(output_.get(), bytes.data(), bytes.size());
  if (count <= 0) {
    return count < 0 && errno == EINTR;
  }
  received_.append(bytes.data(), static_cast<std::size_t>(count));
  for (std::size_t end; (end = received_.find(kEndOfText)) != std::string::npos;) {
    take(received_.substr(0, end));
    received_.erase(0, end + 1);
  }
  return true;
}

void NodeWatch::take(const std::string& text) {
  const std::size_t line_end = text.find('\n');
  const std::string what = text.substr(0, line_end);
  const std::string rest = line_end == std::string::npos ? std::string() : text.substr(line_end + 1);
  if (what == "report") {
    report_ = rest;
  } else if (what == "metrics") {
    metrics_ = rest;
  } else {
    lines_ = lines_of(rest);
  }
}

std::vector<std::string> NodeWatch::lines_with(const std::string& text) const {
  std::vector<std::string> found;
  for (const std::string& line : lines_) {
    if (!line.starts_with("  ") || line.find(text) != std::string::npos) {
      found.push_back(line);
    }
  }
  return found;
}

std::string NodeWatch::end() {
  input_.reset();
  while (output_ && read_some()) {
  }
  output_.reset();
  if (pid_ > 0) {
    wait_for(std::exchange(pid_, -1));
  }
  return report_;
}

}  // namespace launch
