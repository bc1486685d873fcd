// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/hold_ups.hpp"

#include <algorithm>

#include "tracing/model/objects/record_at.hpp"

namespace tracing {

namespace {

// A callback that waits for more than these of its thread is held up by others than one.
constexpr std::size_t kRuns = 16;

}  // namespace

const HoldUpRecord::By* HoldUpRecord::most() const {
  const auto most = std::max_element(by.begin(), by.end(), [](const By& a, const By& b) { return a.ns < b.ns; });
  return most == by.end() ? nullptr : &*most;
}

void HoldUps::on_callback_begin(const CallbackInstance& instance) {
  const CallbackObject& callback = model_.callbacks()[instance.callback];
  if (callback.owner != CallbackObject::Owner::kTimer || callback.owner_id == kNoObject) {
    return;
  }
  std::int64_t& last_begin_ns = record_at(last_begins_ns_, instance.callback);
  const std::int64_t due_ns = last_begin_ns + model_.timers()[callback.owner_id].period_ns;
  if (last_begin_ns != 0) {
    add(instance.callback, instance.thread, due_ns, instance.begin_ns);
  }
  last_begin_ns = instance.begin_ns;
}

void HoldUps::on_message(const MessageFlow& message) {
  if (message.callback != kNoObject && message.publication.number != 0) {
    add(message.callback, message.taking_thread, message.publication.published_ns, message.taken_ns);
  }
}

void HoldUps::on_callback(const CallbackInstance& instance) {
  if (!instance.finished) {
    return;
  }
  std::deque<Run>& runs = runs_[instance.thread];
  while (!runs.empty() && runs.back().begin_ns >= instance.begin_ns) {
    runs.pop_back();  // it ran within this one
  }
  runs.push_back({instance.callback, instance.begin_ns, instance.end_ns});
  if (runs.size() > kRuns) {
    runs.pop_front();
  }
}

void HoldUps::add(ObjectId callback, const ThreadId& thread, std::int64_t due_ns, std::int64_t begin_ns) {
  const std::deque<Run>* const runs = runs_.find(thread);
  if (runs == nullptr) {
    return;
  }
  std::vector<HoldUpRecord::By>& by = record_at(records_, callback).by;
  for (auto run = runs->rbegin(); run != runs->rend() && run->end_ns > due_ns; ++run) {
    if (run->callback == callback || run->begin_ns >= begin_ns) {
      continue;
    }
    auto known = std::find_if(by.begin(), by.end(), [&](const auto& one) { return one.callback == run->callback; });
    if (known == by.end()) {
      if (by.size() == HoldUpRecord::kMost) {
        continue;
      }
      known = by.insert(by.end(), {run->callback, 0, 0});
    }
    known->ns += std::min(run->end_ns, begin_ns) - std::max(run->begin_ns, due_ns);
    ++known->count;
  }
}

}  // namespace tracing
