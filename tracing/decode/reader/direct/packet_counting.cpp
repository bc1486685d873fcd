// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/direct/packet_counting.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>

#include "tracing/decode/ctf/streams/event_counter.hpp"

namespace tracing {
namespace {

constexpr std::uint64_t kJob = 2 << 20;  // bytes; a thread takes about a millisecond for them

// Packets of one stream that one thread counts.
struct Job {
  CountedStream* stream = nullptr;
  std::size_t first = 0;
  std::size_t last = 0;  // not included
};

std::vector<Job> jobs_of(std::vector<CountedStream>& streams) {
  std::vector<Job> jobs;
  for (CountedStream& stream : streams) {
    std::uint64_t bytes = 0;
    std::size_t first = 0;
    for (std::size_t packet = 0; packet < stream.packets.size(); ++packet) {
      bytes += stream.packets[packet].content_bits / 8;
      if (bytes >= kJob || packet + 1 == stream.packets.size()) {
        jobs.push_back({&stream, first, packet + 1});
        first = packet + 1;
        bytes = 0;
      }
    }
  }
  return jobs;
}

class Counting {
 public:
  explicit Counting(std::vector<CountedStream>& streams) : jobs_(jobs_of(streams)) {}

  bool run() {
    std::vector<std::thread> threads;
    const std::size_t most = std::min(usable_processors(), jobs_.size());
    try {
      while (threads.size() + 1 < most) {
        threads.emplace_back([this] { work(); });
      }
    } catch (const std::system_error&) {
      // Those that there are do it all.
    }
    work();
    for (std::thread& thread : threads) {
      thread.join();
    }
    if (error_) {
      std::rethrow_exception(error_);
    }
    return !is_damaged_;
  }

 private:
  void work() {
    try {
      ctf::EventCounter counter;
      std::vector<std::uint64_t> counts;
      for (std::size_t job = next_++; job < jobs_.size() && !is_damaged_; job = next_++) {
        CountedStream& stream = *jobs_[job].stream;
        counts.assign(stream.counts.size(), 0);
        for (std::size_t packet = jobs_[job].first; packet < jobs_[job].last; ++packet) {
          counter.count(stream.layout, stream.packets[packet], counts);
        }
        const std::lock_guard lock(mutex_);
        std::transform(counts.begin(), counts.end(), stream.counts.begin(), stream.counts.begin(), std::plus<>());
      }
    } catch (const ctf::DamagedPacket&) {
      is_damaged_ = true;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      error_ = std::current_exception();
      is_damaged_ = true;
    }
  }

  std::vector<Job> jobs_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> is_damaged_ = false;
  std::mutex mutex_;  // of what follows, and of the counts of the streams
  std::exception_ptr error_;
};

}  // namespace

std::size_t usable_processors() {
  cpu_set_t processors;
  CPU_ZERO(&processors);
  if (sched_getaffinity(0, sizeof processors, &processors) == 0) {
    return static_cast<std::size_t>(std::max(CPU_COUNT(&processors), 1));
  }
  return std::max(std::thread::hardware_concurrency(), 1U);  // there are more than fit into the set
}

bool count_packets(std::vector<CountedStream>& streams) {
  return Counting(streams).run();
}

}  // namespace tracing
