// SPDX-License-Identifier: Apache-2.0
#include "track_frames/frames.hpp"

#include <rcutils/logging_macros.h>

namespace track_frames {

bool Frames::set(const geometry_msgs::msg::TransformStamped& transform, bool is_static) {
  if (transform.child_frame_id.empty()) {
    RCUTILS_LOG_ERROR("ignoring a transform of '%s' without a child frame", transform.header.frame_id.c_str());
    return false;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    (is_static ? static_by_child_ : by_child_)[transform.child_frame_id] = transform;
  }
  changed_.notify_all();
  return true;
}

geometry_msgs::msg::TransformStamped Frames::lookup(const std::string& target, const std::string& source) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto* list : {&static_by_child_, &by_child_}) {
    const auto found = list->find(source);
    if (found != list->end() && found->second.header.frame_id == target) {
      return found->second;
    }
  }
  throw LookupError("\"" + target + "\" and \"" + source + "\" are not connected");
}

bool Frames::wait_for(const std::string& target, const std::string& source, Duration timeout) const {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] {
    for (const auto* list : {&static_by_child_, &by_child_}) {
      const auto found = list->find(source);
      if (found != list->end() && found->second.header.frame_id == target) {
        return true;
      }
    }
    return false;
  });
}

void Frames::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  by_child_.clear();
}

}  // namespace track_frames
