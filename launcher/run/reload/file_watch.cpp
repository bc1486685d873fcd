// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/reload/file_watch.hpp"

#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace launch {

FileWatch::FileWatch(EventLoop& loop, std::function<void()> changed)
    : changed_(std::move(changed)), inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (!inotify_) {
    throw std::system_error(errno, std::system_category(), "cannot watch files");
  }
  source_ = loop.on_readable(inotify_.get(), [this] { read(); });
}

void FileWatch::add(const std::set<std::string>& files) {
  for (const std::string& file : files) {
    // The directory is watched, because an editor puts another file in the place of the first one.
    const std::string directory = std::filesystem::path(file).parent_path().string();
    if (!files_.insert(file).second || directory.empty()) {
      continue;
    }
    const int watch = ::inotify_add_watch(inotify_.get(), directory.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO);
    if (watch >= 0) {
      directories_.insert_or_assign(watch, directory);
    } else if (errno == ENOSPC || errno == ENOMEM) {
      throw std::system_error(errno, std::system_category(), "cannot watch '" + directory + "'");
    } else {
      files_.erase(file);
    }
  }
}

void FileWatch::read() {
  constexpr std::size_t kBuffer = 16 * 1024;
  alignas(inotify_event) std::array<char, kBuffer> buffer;
  bool is_changed = false;
  for (ssize_t size = 0; (size = ::read(inotify_.get(), buffer.data(), buffer.size())) > 0;) {
    for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
      inotify_event event{};
      std::memcpy(&event, &buffer.at(at), sizeof event);
      const std::string name = event.len == 0 ? "" : &buffer.at(at + sizeof event);
      at += sizeof event + event.len;
      const auto directory = directories_.find(event.wd);
      is_changed = is_changed || (event.mask & IN_Q_OVERFLOW) != 0 ||
                   (directory != directories_.end() &&
                    files_.contains((std::filesystem::path(directory->second) / name).string()));
    }
  }
  if (is_changed) {
    changed_();
  }
}

}  // namespace launch
