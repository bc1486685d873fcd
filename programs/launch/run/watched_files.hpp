// SPDX-License-Identifier: Apache-2.0
// `launch --watch`: the launch reloads when one of its launch files changes.
#pragma once

#include <vector>

#include "launcher/process/output/output_router.hpp"
#include "launcher/run/launch_service.hpp"
#include "launcher/run/reload/file_watch.hpp"

namespace launch {

// Watches the launch files that were visited, and those with an error.
class WatchedFiles {
 public:
  // The references must outlive this object. Throws std::system_error.
  WatchedFiles(EventLoop& loop, LaunchService& service, const LaunchContext& context, OutputRouter& output);

 private:
  void add(const std::vector<Diagnostic>& errors);

  const LaunchContext& context_;
  OutputRouter& output_;
  FileWatch watch_;
};

}  // namespace launch
