// SPDX-License-Identifier: Apache-2.0
// Tells when a file has been written, or was replaced by another one, as editors do.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class FileWatch {
 public:
  // `changed` is called once for all changes that are there at a time, in a turn of the loop. The loop must outlive
  // this object. Throws std::system_error.
  FileWatch(EventLoop& loop, std::function<void()> changed);

  // Watches these files, too. One whose directory does not exist is passed over. Throws std::system_error when the
  // system allows no more watches.
  void add(const std::set<std::string>& files);

 private:
  void read();

  std::function<void()> changed_;
  UniqueFd inotify_;
  std::map<int, std::string> directories_;  // by their watches
  std::set<std::string> files_;
  EventLoop::SourcePtr source_;
};

}  // namespace launch
