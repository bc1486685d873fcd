// SPDX-License-Identifier: Apache-2.0
#include "programs/watch/traced_nodes.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"

namespace tracing {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kRetry{10};  // the relay daemon does not tell when it gets a session
constexpr std::chrono::seconds kLongestAttach{60};

LiveAddress address_of(const std::string& session, const PrivateRelay& relay) {
  LiveAddress address = live_address(session);
  address.relay = relay.viewer_address();
  return address;
}

}  // namespace

TracedNodes::TracedNodes(Settings settings)
    : settings_(std::move(settings)),
      session_(fmt::format("{}-{}", settings_.name, getpid())),
      reader_(address_of(session_, relay_)) {
  try {
    start();
    attach();
  } catch (...) {
    end();
    throw;
  }
}

TracedNodes::~TracedNodes() {
  end();
}

void TracedNodes::start() {
  launch::Pipe input = launch::make_pipe();
  launch::Pipe errors = launch::make_pipe();
  const std::string program = launch::own_prefix() + "/bin/launch";
  // It is no record: small buffers, which are read soon, and files that replace themselves.
  std::vector<std::string> argv = {program,
                                   "trace",
                                   "--session-name",
                                   session_,
                                   "--url",
                                   relay_.session_url(),
                                   "--live-timer",
                                   std::to_string(settings_.live_timer.count()),
                                   "--subbuffer-size-ust",
                                   "262144",
                                   "--tracefile-size",
                                   "16777216",
                                   "--tracefile-count",
                                   "2",
                                   "--ust"};
  argv.insert(argv.end(), settings_.events.begin(), settings_.events.end());
  recorder_ = launch::spawn({.program = program,
                             .argv = std::move(argv),
                             .descriptors = {{STDIN_FILENO, input.read.get()},
                                             {STDOUT_FILENO, launch::kDevNull},
                                             {STDERR_FILENO, errors.write.get()}},
                             .group = launch::ChildGroup::kOwn});
  alive_ = std::move(input.write);
  problems_ = std::move(errors.read);
  // The answer to "press enter to start".
  if (write(alive_.get(), "\n", 1) != 1) {
    throw std::runtime_error("cannot start the session");
  }
}

void TracedNodes::attach() {
  const Clock::time_point give_up = Clock::now() + kLongestAttach;
  while (!reader_.attach()) {
    if (!is_recorded_for(kRetry)) {
      std::string problem = launch::read_to_end(problems_);
      while (problem.ends_with('\n')) {
        problem.pop_back();
      }
      throw std::runtime_error(problem.empty() ? "the session has ended at once" : problem);
    }
    if (Clock::now() > give_up) {
      throw std::runtime_error("the relay daemon does not get the session");
    }
  }
  catch_up();
}

// What is recorded before a viewer attaches is not read.
void TracedNodes::catch_up() {
  if (caught_up_ == reader_.late_attachments()) {
    return;
  }
  caught_up_ = reader_.late_attachments();
  launch::wait_for(launch::spawn(
      {.program = "lttng",
       .argv = {"lttng", "regenerate", "statedump", "--session=" + session_},
       .search_path = true,
       .descriptors = {
           {STDIN_FILENO, launch::kDevNull}, {STDOUT_FILENO, launch::kDevNull}, {STDERR_FILENO, launch::kDevNull}}}));
}

bool TracedNodes::is_recorded_for(std::chrono::milliseconds time) const {
  return !launch::ends_within(recorder_, time);
}

void TracedNodes::end() {
  alive_.reset();
  if (recorder_ < 0) {
    return;
  }
  launch::wait_for(recorder_);
  recorder_ = -1;
}

}  // namespace tracing
