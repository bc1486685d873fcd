// SPDX-License-Identifier: Apache-2.0
// The floors of what stays within a process: a loop that sleeps until the next time, and a locked queue with an eventfd
// that wakes the thread that takes from it.
//   latency_plain_local sleep|queue
#include <poll.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "worker.hpp"

namespace {

// How late the thread wakes.
void sleep_until_due() {
  latency::LatencyLog log;
  latency::tell_ready();
  latency::for_each_batch([&](const latency::Batch& batch) {
    std::int64_t due = latency::monotonic_now();
    for (auto remaining = static_cast<std::int64_t>(batch.messages); remaining-- > 0;) {
      due += batch.period;
      const timespec at{due / 1'000'000'000, due % 1'000'000'000};
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
      log.received(due, remaining);
    }
  });
}

struct Message {
  std::int64_t sent;
  std::int64_t remaining;
  std::vector<std::uint8_t> data;
};

class Queue {
 public:
  void put(std::unique_ptr<Message> message) {
    {
      const std::lock_guard lock(mutex_);
      messages_.push_back(std::move(message));
    }
    eventfd_write(ready_, 1);
  }
  std::unique_ptr<Message> take() {
    pollfd wanted{ready_, POLLIN, 0};
    poll(&wanted, 1, -1);
    eventfd_t count = 0;
    eventfd_read(ready_, &count);
    const std::lock_guard lock(mutex_);
    std::unique_ptr<Message> message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }

 private:
  std::mutex mutex_;
  std::deque<std::unique_ptr<Message>> messages_;
  const int ready_ = eventfd(0, EFD_CLOEXEC);
};

void hand_over() {
  Queue queue;
  latency::LatencyLog log;
  const std::function<void(std::unique_ptr<Message>)> callback = [&](std::unique_ptr<Message> message) {
    log.received(message->sent, message->remaining);
  };
  latency::tell_ready();
  latency::publish_batches([&](std::size_t size_index, std::int64_t remaining) {
    auto message = std::make_unique<Message>();
    message->data.resize(latency::kSizes.at(size_index));
    message->remaining = remaining;
    message->sent = latency::monotonic_now();
    queue.put(std::move(message));
    callback(queue.take());
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "sleep") {
    sleep_until_due();
  } else {
    hand_over();
  }
}
