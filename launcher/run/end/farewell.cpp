// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/farewell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <variant>

#include "base/overloaded.hpp"

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
    carry_out(callbacks_.visit(invocation));
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

// Everything still runs, but little starts any more. What has no effect here is either refused by check_farewell(), or
// would only matter later.
void Farewell::carry_out(Requests requests) {
  if (!requests.loads.empty() || !requests.transitions.empty()) {
    callbacks_.warn("components are not loaded and states not changed any more, because the system ends");
  }
  for_each_request(requests,
                   Overloaded{
                       [&](ProcessCommand& command) { callbacks_.execute(command); },
                       [&](ProcessSpec& spec) { callbacks_.start(std::move(spec)); },
                       PassOver<RunScopePtr, UnregisterRequest, TestRequest, EventHandler, TimerRequest, LoadRequest,
                                TransitionRequest, CoroutineRequest, ShutdownRequest, NodeDescription, Dependency>(),
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
