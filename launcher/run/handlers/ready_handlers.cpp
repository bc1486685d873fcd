// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/ready_handlers.hpp"

#include <optional>
#include <string>

namespace launch {

void ReadyHandlers::add(EventHandler handler) {
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
