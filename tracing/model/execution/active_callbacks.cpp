// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/active_callbacks.hpp"

#include <iterator>

namespace tracing {

std::optional<ActiveCallbacks::Parts> ActiveCallbacks::end(const CallbackInstance& instance) {
  Thread& thread = threads_[instance.thread];
  const auto innermost = std::find_if(thread.active.rbegin(), thread.active.rend(),
                                      [&](const Active& active) { return active.callback == instance.callback; });
  if (innermost == thread.active.rend()) {
    return std::nullopt;
  }
  const Active ended = *innermost;
  thread.active.erase(std::next(innermost).base());
  if (!instance.finished || !thread.is_scheduled) {
    return std::nullopt;
  }
  const std::int64_t duration_ns = instance.end_ns - instance.begin_ns;
  return Parts{.running_ns = duration_ns - ended.runnable_ns - ended.blocked_ns,
               .runnable_ns = ended.runnable_ns,
               .blocked_ns = ended.blocked_ns};
}

}  // namespace tracing
