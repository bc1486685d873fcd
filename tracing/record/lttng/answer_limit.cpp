// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/answer_limit.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/processes/process_stat.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::atomic<std::chrono::milliseconds> silence_limit{kLongestSilence};
thread_local bool unanswered = false;

// The sockets over which the library waits for an answer.
std::vector<int> daemon_connections() {
  constexpr std::string_view kSocket = "/client-lttng-sessiond";
  std::vector<int> connections;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc/self/fd", none)) {
    const std::string name = entry.path().filename();
    int fd = -1;
    std::from_chars(name.data(), name.data() + name.size(), fd);
    sockaddr_un peer{};
    socklen_t size = sizeof peer;
    if (fd < 0 || getpeername(fd, reinterpret_cast<sockaddr*>(&peer), &size) != 0 || peer.sun_family != AF_UNIX) {
      continue;
    }
    if (std::string_view(peer.sun_path).ends_with(kSocket)) {
      connections.push_back(fd);
    }
  }
  return connections;
}

// Of the daemon at the other end, in ticks; 0 when unknown.
std::uint64_t processor_time(int connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) {
    return 0;
  }
  return launch::read_process_stat(peer.pid).processor_time;
}

// A thread that looks at the call under way. It lives as long as the process.
class Watcher {
 public:
  Watcher() : owner_(getpid()) {
    std::thread([this] { watch(); }).detach();
  }

  pid_t owner() const { return owner_; }

  void begin() {
    bool has_to_know = false;
    {
      const std::lock_guard lock(mutex_);
      const std::chrono::milliseconds longest = silence_limit;
      const std::chrono::milliseconds before = limit_;
      silent_since_ = Clock::now();
      limit_ = silent_since_ < short_until_ ? longest / 10 : longest;
      processor_time_ = 0;
      cut_ = false;
      calls_ = true;
      ++begun_;
      has_to_know = std::exchange(is_idle_, false) || limit_ != before;
    }
    if (has_to_know) {
      changed_.notify_one();
    }
  }

  // Whether the call was ended.
  bool end() {
    const std::lock_guard lock(mutex_);
    calls_ = false;
    return cut_;
  }

 private:
  void watch() {
    std::unique_lock lock(mutex_);
    std::uint64_t seen = 0;
    while (true) {
      is_idle_ = begun_ == seen;
      changed_.wait(lock, [this, seen] { return begun_ != seen; });
      // A set-up has dozens of short calls: nobody is woken for each.
      do {
        seen = begun_;
        changed_.wait_for(lock, limit_ / kLooks);
        if (calls_ && Clock::now() - silent_since_ >= limit_ / kLooks) {
          look();
        }
      } while (calls_ || begun_ != seen);
    }
  }

  void look() {
    const std::vector<int> connections = daemon_connections();
    const std::uint64_t time = connections.empty() ? 0 : processor_time(connections.front());
    if (processor_time_ != 0 && time > processor_time_) {
      silent_since_ = Clock::now();
    }
    processor_time_ = time;
    if (Clock::now() - silent_since_ < limit_) {
      return;
    }
    cut_ = true;
    silent_since_ = Clock::now();  // the call may make another connection
    short_until_ = silent_since_ + 3 * silence_limit.load();
    for (const int connection : connections) {
      shutdown(connection, SHUT_RDWR);
    }
  }

  static constexpr int kLooks = 5;  // within the limit

  const pid_t owner_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::chrono::milliseconds limit_{0};
  Clock::time_point silent_since_;
  std::uint64_t processor_time_ = 0;  // of the daemon at the last look
  std::uint64_t begun_ = 0;           // calls
  bool calls_ = false;
  bool is_idle_ = false;  // the thread, until the next call begins
  bool cut_ = false;      // the call
  Clock::time_point short_until_;
};

// A process that was forked has no thread of its parent's.
Watcher& watcher() {
  static Watcher* watcher = nullptr;
  if (watcher == nullptr || watcher->owner() != getpid()) {
    watcher = new Watcher();
  }
  return *watcher;
}

}  // namespace

AnswerLimit::AnswerLimit() {
  watcher().begin();
}

AnswerLimit::~AnswerLimit() {
  unanswered = watcher().end();
}

bool AnswerLimit::was_unanswered() {
  return unanswered;
}

std::chrono::milliseconds longest_silence() {
  return silence_limit;
}

void set_longest_silence(std::chrono::milliseconds silence) {
  silence_limit = silence;
}

}  // namespace tracing
