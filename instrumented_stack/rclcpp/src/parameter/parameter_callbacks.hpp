// SPDX-License-Identifier: Apache-2.0
// Lists of callbacks that live as long as their handles.
#pragma once

#include <list>
#include <memory>
#include <utility>
#include <vector>

namespace rclcpp::detail {

// The living handles. They are held so that a callback can remove itself.
template <typename HandleT>
std::vector<std::shared_ptr<HandleT>> living(std::list<std::weak_ptr<HandleT>>& handles) {
  std::vector<std::shared_ptr<HandleT>> result;
  handles.remove_if([&result](const std::weak_ptr<HandleT>& weak) {
    auto handle = weak.lock();
    if (handle) {
      result.push_back(std::move(handle));
    }
    return weak.expired();
  });
  return result;
}

template <typename HandleT, typename CallbackT>
std::shared_ptr<HandleT> add_handle(std::list<std::weak_ptr<HandleT>>& handles, CallbackT callback) {
  auto handle = std::make_shared<HandleT>();
  handle->callback = std::move(callback);
  handles.push_front(handle);  // the newest is called first
  return handle;
}

}  // namespace rclcpp::detail
