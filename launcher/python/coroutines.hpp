// SPDX-License-Identifier: Apache-2.0
// Coroutines of Python launch files, which run beside the processes, on the launch's own loop.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "launcher/base/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/visit/coroutine_request.hpp"

namespace launch {

class LaunchContext;
class PythonFile;

// They run in steps, each up to where all of them wait; a descriptor and a time tell when the next step is due.
class Coroutines {
 public:
  // `stepped` is called after each step: a step may have left requests in the context, or have ended the last
  // coroutine. `fail` is given what a coroutine throws.
  Coroutines(LaunchContext& context, EventLoop& loop, std::function<void()> stepped,
             std::function<void(const LaunchError&)> fail)
      : context_(context), loop_(loop), stepped_(std::move(stepped)), fail_(std::move(fail)) {}

  void start(const CoroutineRequest& request);
  // Nothing runs.
  bool idle() const { return running_ == 0; }
  // Asks all of them to end; they may still have something to do first.
  void cancel();

 private:
  void step();

  LaunchContext& context_;
  EventLoop& loop_;
  std::function<void()> stepped_;
  std::function<void(const LaunchError&)> fail_;
  std::shared_ptr<PythonFile> file_;  // the one that started a coroutine last: what Python's calls speak of
  std::size_t running_ = 0;
  EventLoop::SourcePtr wake_up_;
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
