// SPDX-License-Identifier: Apache-2.0
#include "object_state.hpp"

#include <algorithm>
#include <utility>

#include "tracetools/tracetools.h"

namespace tracetools {

ObjectState& ObjectState::instance() {
  static auto* state = new ObjectState;
  return *state;
}

std::size_t ObjectState::HashKey::operator()(const ObjectKey& key) const noexcept {
  return std::hash<const void*>()(key.address) * 31 + static_cast<std::size_t>(key.kind);
}

void ObjectState::keep(std::vector<ObjectKey> objects, const char* name, std::function<void()> record) {
  const std::lock_guard lock(mutex_);
  if (const auto found = of_object_.find(objects.front()); name != nullptr && found != of_object_.end()) {
    const auto same = std::find_if(found->second.begin(), found->second.end(), [&](InitEvents::iterator event) {
      return event->name == name && event->objects.front() == objects.front();
    });
    if (same != found->second.end()) erase(*same);
  }
  const auto event = events_.insert(events_.end(), {std::move(objects), name, std::move(record)});
  for (const ObjectKey& object : event->objects) of_object_[object].push_back(event);
}

void ObjectState::forget(ObjectKey object) {
  const std::lock_guard lock(mutex_);
  for (auto found = of_object_.find(object); found != of_object_.end(); found = of_object_.find(object)) {
    erase(found->second.back());
  }
}

void ObjectState::record_again() {
  const std::lock_guard lock(mutex_);
  if (events_.empty()) return;
  ros_trace_ext_state_dump_begin(events_.size());
  for (const InitEvent& event : events_) event.record();
  ros_trace_ext_state_dump_end(events_.size());
}

void ObjectState::erase(InitEvents::iterator event) {
  for (const ObjectKey& object : event->objects) {
    const auto found = of_object_.find(object);
    if (found == of_object_.end()) continue;  // the event names an object twice
    std::erase(found->second, event);
    if (found->second.empty()) of_object_.erase(found);
  }
  events_.erase(event);
}

}  // namespace tracetools
