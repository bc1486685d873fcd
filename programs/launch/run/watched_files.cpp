// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/run/watched_files.hpp"

#include <fmt/format.h>

#include <set>
#include <string>
#include <system_error>

namespace launch {

WatchedFiles::WatchedFiles(EventLoop& loop, LaunchService& service, const LaunchContext& context, OutputRouter& output)
    : context_(context), output_(output), watch_(loop, [&service] {
        if (!service.reloads().has_queued()) {
          service.reloads().ask({});
        }
      }) {
  loop.post([this, &loop] { loop.post([this] { add({}); }); });  // behind the first visit
  service.reloads().observe([this](const ReloadReport& report) { add(report.errors); }, [](const ReloadEnd&) {});
}

void WatchedFiles::add(const std::vector<Diagnostic>& errors) {
  std::set<std::string> files = context_.files();
  for (const Diagnostic& error : errors) {
    if (error.where) {
      files.insert(error.where.file->path());
    }
  }
  try {
    watch_.add(files);
  } catch (const std::system_error& error) {
    output_.message(LogLevel::kWarning, "launch", fmt::format("--watch misses files: {}", error.what()));
  }
}

}  // namespace launch
