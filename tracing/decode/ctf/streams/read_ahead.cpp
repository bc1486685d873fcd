// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/read_ahead.hpp"

#include <algorithm>
#include <system_error>

namespace tracing::ctf {

ReadAhead::ReadAhead(std::size_t threads) {
  try {
    while (threads_.size() < threads) {
      threads_.emplace_back([this] { work(); });
    }
  } catch (const std::system_error&) {
    // Those that there are do it all.
  }
}

ReadAhead::~ReadAhead() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  asked_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

void ReadAhead::ask(Task& task) {
  {
    const std::lock_guard lock(mutex_);
    task.state = Task::State::kWaits;
    tasks_.push_back(&task);
  }
  asked_.notify_one();
}

void ReadAhead::wait(Task& task) {
  std::unique_lock lock(mutex_);
  if (task.state == Task::State::kWaits) {
    tasks_.erase(std::find(tasks_.begin(), tasks_.end(), &task));
    task.state = Task::State::kNone;
    lock.unlock();
    task.decoder->fill(*task.block);
    return;
  }
  done_.wait(lock, [&task] { return task.state == Task::State::kDone; });
  task.state = Task::State::kNone;
}

void ReadAhead::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    asked_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
    if (ends_) {
      return;
    }
    Task& task = *tasks_.front();
    tasks_.pop_front();
    task.state = Task::State::kRuns;
    lock.unlock();
    task.decoder->fill(*task.block);
    lock.lock();
    task.state = Task::State::kDone;
    done_.notify_all();
  }
}

}  // namespace tracing::ctf
