// SPDX-License-Identifier: Apache-2.0
// The handlers that wait for something outside the launch, such as a service that is offered. Each is visited once.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/visit/event_handler.hpp"

namespace launch {

class ReadyHandlers {
 public:
  // `invoke` gets a handler whose condition holds; `fail` gets an error that prevents a condition from being known. The
  // loop must outlive this object.
  ReadyHandlers(EventLoop& loop, std::function<void(std::vector<Invocation>)> invoke,
                std::function<void(const LaunchError&)> fail)
      : loop_(loop), invoke_(std::move(invoke)), fail_(std::move(fail)) {}

  // Watches the condition of an OnceReady.
  void add(EventHandler handler);
  void clear() { handlers_.clear(); }

 private:
  EventLoop& loop_;
  std::function<void(std::vector<Invocation>)> invoke_;
  std::function<void(const LaunchError&)> fail_;
  std::list<std::shared_ptr<const EventHandler>> handlers_;
};

inline void ReadyHandlers::add(EventHandler handler) {
  const auto place = handlers_.insert(handlers_.end(), std::make_shared<const EventHandler>(std::move(handler)));
  std::get<OnceReady>((*place)->event)
      .condition->watch(loop_, [this, place](const std::optional<std::string>& failure) {
        const std::shared_ptr<const EventHandler> ready = *place;
        handlers_.erase(place);
        if (failure) {
          fail_(LaunchError(*failure, ready->where));
        } else {
          invoke_({{ready, {}}});
        }
      });
}

}  // namespace launch
