// SPDX-License-Identifier: Apache-2.0
// Coroutines of Python launch files, which run on the launch's own loop beside the processes.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class LaunchContext;
class PythonFile;

// They run in steps. A step goes on until all of them wait; a descriptor and a time tell when the next step is due.
class Coroutines {
 public:
  // `stepped` is called after each step, because a step may have left requests in the context or have ended the last
  // coroutine. `fail` gets the error that a coroutine throws.
  Coroutines(LaunchContext& context, EventLoop& loop, std::function<void()> stepped,
             std::function<void(const LaunchError&)> fail)
      : context_(context), loop_(loop), stepped_(std::move(stepped)), fail_(std::move(fail)) {}

  void start(const CoroutineRequest& request);
  // True when no coroutine runs but for those in the background.
  bool idle() const { return running_ == 0; }
  // Asks all coroutines to end; they may still have something to do first.
  void cancel();
  // Lets them wait for ever: none takes another step.
  void abandon();

 private:
  void step();

  LaunchContext& context_;
  EventLoop& loop_;
  std::function<void()> stepped_;
  std::function<void(const LaunchError&)> fail_;
  std::shared_ptr<PythonFile> file_;  // the file that started a coroutine last; Python's calls refer to it
  std::size_t running_ = 0;
  std::size_t background_ = 0;
  EventLoop::SourcePtr wake_up_;
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
