// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/farewell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <variant>

namespace launch {

void Farewell::say(std::vector<Invocation> handlers) {
  under_way_ = true;
  handlers_ = std::move(handlers);
  if (handlers_.empty()) {
    end();
  } else {
    loop_.post([this] { visit_handlers(); });
  }
}

void Farewell::visit_handlers() {
  if (!under_way_) {
    return;  // it was cut short earlier
  }
  Duration timeout{0};
  for (const Invocation& invocation : std::exchange(handlers_, {})) {
    timeout = std::max(timeout, std::get<OnShutdown>(invocation.handler->event).timeout);
    callbacks_.visit(invocation);
  }
  if (processes_.empty()) {
    end();
    return;
  }
  timer_ = loop_.after(timeout, [this, timeout] {
    callbacks_.warn(fmt::format("on_shutdown: {} s have passed, the system ends now",
                                std::chrono::duration<double>(timeout).count()));
    end();
  });
}

void Farewell::on_done(ProcessId process) {
  if (processes_.erase(process) != 0 && processes_.empty()) {
    // Unless the handlers have started another process meanwhile.
    loop_.post([this] {
      if (processes_.empty()) {
        end();
      }
    });
  }
}

void Farewell::end() {
  if (std::exchange(under_way_, false)) {
    timer_.reset();
    callbacks_.over();
  }
}

}  // namespace launch
