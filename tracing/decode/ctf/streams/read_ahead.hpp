// SPDX-License-Identifier: Apache-2.0
// Threads that decode the next block of each stream while the one before is read.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "tracing/decode/ctf/streams/block_decoder.hpp"
#include "tracing/decode/ctf/streams/event_block.hpp"

namespace tracing::ctf {

class ReadAhead {
 public:
  // A block that is to be filled. Whoever has asked for it must leave the decoder and the block alone until he has
  // waited for it.
  struct Task {
    BlockDecoder* decoder = nullptr;
    EventBlock* block = nullptr;

   private:
    friend class ReadAhead;
    enum class State { kNone, kWaits, kRuns, kDone };
    State state = State::kNone;
  };

  // As many threads as can be had; without one, wait() does all.
  explicit ReadAhead(std::size_t threads);
  ~ReadAhead();  // all that was asked for must have been waited for
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  // The task must stay where it is.
  void ask(Task& task);
  // Until the block is filled. What no thread has begun is done at once.
  void wait(Task& task);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable asked_;
  std::condition_variable done_;
  std::deque<Task*> tasks_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace tracing::ctf
