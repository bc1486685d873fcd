// SPDX-License-Identifier: Apache-2.0
#include "latency_run.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

extern char** environ;  // NOLINT: POSIX names it so

namespace latency {
namespace {

constexpr int kSilenceMs = 10'000;

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) {
    result.push_back(word.data());
  }
  result.push_back(nullptr);
  return result;
}

// Runs the calling thread on one processor as long as it lives.
class PinnedTo {
 public:
  explicit PinnedTo(int processor) {
    sched_getaffinity(0, sizeof before_, &before_);
    processor %= CPU_COUNT(&before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
      if (CPU_ISSET(cpu, &before_) && processor-- == 0) {
        CPU_SET(cpu, &one);
      }
    }
    sched_setaffinity(0, sizeof one, &one);
  }
  ~PinnedTo() { sched_setaffinity(0, sizeof before_, &before_); }
  PinnedTo(const PinnedTo&) = delete;
  PinnedTo& operator=(const PinnedTo&) = delete;

 private:
  cpu_set_t before_;
};

}  // namespace

void fail(const std::string& message) {
  throw std::runtime_error(message);
}

Worker::Worker(const std::vector<std::string>& argv, const std::map<std::string, std::string>& environment,
               int processor)
    : name_(argv.back() + " of " + argv.front()) {
  int in[2];
  int out[2];
  if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0) {
    fail("no pipe");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  std::vector<std::string> words = argv;
  std::vector<std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    variables.emplace_back(*entry);
  }
  for (const auto& [name, value] : environment) {
    std::erase_if(variables, [&](const std::string& entry) { return entry.starts_with(name + "="); });
    variables.push_back(name + "=" + value);
  }
  const PinnedTo pinned(processor);  // the child inherits this
  if (posix_spawn(&pid_, argv[0].c_str(), &actions, nullptr, pointers(words).data(), pointers(variables).data()) != 0) {
    fail("cannot start " + name_);
  }
  posix_spawn_file_actions_destroy(&actions);
  close(in[0]);
  close(out[1]);
  in_ = in[1];
  out_ = out[0];
}

Worker::~Worker() {
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  close(in_);
  close(out_);
}

void Worker::send(const void* bytes, std::size_t length) {
  if (write(in_, bytes, length) != static_cast<ssize_t>(length)) {
    fail(name_ + " has ended");
  }
}

void Worker::receive(void* bytes, std::size_t length) {
  for (auto* at = static_cast<char*>(bytes); length != 0;) {
    pollfd answer{out_, POLLIN, 0};
    if (poll(&answer, 1, kSilenceMs) != 1) {
      fail(name_ + " is silent: no message, or its last one was lost");
    }
    const ssize_t count = read(out_, at, length);
    if (count <= 0) {
      fail(name_ + " has ended");
    }
    at += count;
    length -= static_cast<std::size_t>(count);
  }
}

Pair::Pair(const std::string& program, const std::string& subscriber_role,
           const std::map<std::string, std::string>& environment)
    : subscriber_({program, subscriber_role}, environment, 1), publisher_({program, "publisher"}, environment, 0) {}

void Pair::wait_ready() {
  char ready;
  subscriber_.receive(&ready, sizeof ready);
  publisher_.receive(&ready, sizeof ready);
}

std::vector<std::int64_t> Pair::run(const Batch& batch) {
  publisher_.send(&batch, sizeof batch);
  std::uint64_t received = 0;
  subscriber_.receive(&received, sizeof received);
  std::vector<std::int64_t> latencies(received);
  subscriber_.receive(latencies.data(), latencies.size() * sizeof latencies[0]);
  return latencies;
}

}  // namespace latency
