// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/coroutines.hpp"

#include <chrono>

#include "launcher/python/interpreter/python_module.hpp"
#include "launcher/python/python_file.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

void Coroutines::start(const CoroutineRequest& request) {
  file_ = request.file;
  try {
    PythonHost host(*file_, context_);
    request.object->start(host);
  } catch (const python::Error& error) {
    try {
      file_->places().fail(error);
    } catch (const LaunchError& failure) {
      fail_(failure);
    }
    return;
  }
  ++running_;
  timer_ = loop_.after(Duration(0), [this] { step(); });
}

void Coroutines::cancel() {
  if (running_ + background_ == 0) {
    return;
  }
  PythonHost host(*file_, context_);
  python_runtime().cancel_coroutines(host);
  timer_ = loop_.after(Duration(0), [this] { step(); });
}

void Coroutines::abandon() {
  running_ = 0;
  background_ = 0;
  wake_up_.reset();
  timer_.reset();
}

void Coroutines::step() {
  const EventLoop::SourcePtr timer = std::move(timer_);  // outlives its callback
  std::optional<LaunchError> failure;
  python::Pause pause;
  try {
    PythonHost host(*file_, context_);
    pause = python_runtime().step_coroutines(host);
  } catch (const python::Error& error) {
    try {
      file_->places().fail(error);
    } catch (const LaunchError& told) {
      failure = told;
    }
    pause = {.running = running_ > 0 ? running_ - 1 : 0, .background = background_, .descriptor = -1, .seconds = 0};
  }
  running_ = pause.running;
  background_ = pause.background;
  if (running_ + background_ == 0) {
    wake_up_.reset();
  } else {
    if (!wake_up_ && pause.descriptor >= 0) {
      wake_up_ = loop_.on_readable(pause.descriptor, [this] { step(); });
    }
    if (pause.seconds) {
      const std::chrono::duration<double> seconds(*pause.seconds);
      timer_ = loop_.after(std::chrono::duration_cast<Duration>(seconds), [this] { step(); });
    }
  }
  if (failure) {
    fail_(*failure);
  }
  stepped_();
}

}  // namespace launch
