// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/fetched_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/files/replace_file.hpp"
#include "base/text/utf8.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"

namespace launch {
namespace {

constexpr std::size_t kLongestPath = 2048;
constexpr std::size_t kLongestName = 255;
constexpr int kMostFolders = 12;
constexpr std::uint32_t kMostFiles = 200'000;
constexpr mode_t kFolderMode = 0777;  // as the umask allows
constexpr mode_t kFileMode = 0666;

std::system_error error_of(const std::string& path) {
  return {errno, std::system_category(), fmt::format("cannot write '{}'", path)};
}

}  // namespace

bool is_path_of_fetched_file(std::string_view path) {
  if (path.empty() || path.size() > kLongestPath) {
    return false;
  }
  if (std::any_of(path.begin(), path.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; })) {
    return false;
  }
  int folders = 0;
  while (true) {
    const std::size_t slash = path.find('/');
    const std::string_view name = path.substr(0, slash);
    if (name.empty() || name == "." || name == ".." || name.size() > kLongestName) {
      return false;
    }
    if (slash == std::string_view::npos) {
      return name != kClockFile;
    }
    if (++folders > kMostFolders) {
      return false;
    }
    path.remove_prefix(slash + 1);
  }
}

FetchedFiles::FetchedFiles(std::string directory) : directory_(std::move(directory)), part_(directory_ + "~") {
  std::error_code failed;
  std::filesystem::create_directories(std::filesystem::path(directory_).parent_path(), failed);
  if (std::filesystem::symlink_status(directory_, failed).type() != std::filesystem::file_type::not_found) {
    errno = EEXIST;
    throw error_of(directory_);
  }
  if (::mkdir(part_.c_str(), kFolderMode) != 0) {
    throw error_of(part_);
  }
  folder_ = UniqueFd(::open(part_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!folder_) {
    throw error_of(part_);
  }
}

void FetchedFiles::begin_file(const std::string& path, std::uint64_t size) {
  if (!is_path_of_fetched_file(path) || !is_utf8(path)) {
    throw WireError("a file of a recording has a name that it must not have");
  }
  if (file_ || ++files_ > kMostFiles) {
    throw WireError(file_ ? "a file of a recording begins within another one" : "a recording has too many files");
  }
  struct statvfs space {};
  if (::fstatvfs(folder_.get(), &space) == 0 && size / space.f_frsize >= space.f_bavail) {
    errno = ENOSPC;
    throw error_of(part_ + "/" + path);
  }
  UniqueFd folder(::fcntl(folder_.get(), F_DUPFD_CLOEXEC, 0));
  std::string name = path;
  for (std::size_t slash; (slash = name.find('/')) != std::string::npos; name.erase(0, slash + 1)) {
    const std::string below = name.substr(0, slash);
    if (::mkdirat(folder.get(), below.c_str(), kFolderMode) != 0 && errno != EEXIST) {
      throw error_of(part_ + "/" + path);
    }
    UniqueFd next(::openat(folder.get(), below.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!next) {
      throw error_of(part_ + "/" + path);
    }
    folder = std::move(next);
  }
  file_ =
      UniqueFd(::openat(folder.get(), name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kFileMode));
  if (!file_) {
    throw error_of(part_ + "/" + path);
  }
  left_ = size;
  sum_ = kSumOfNothing;
}

void FetchedFiles::add(std::string_view bytes) {
  if (!file_ || bytes.size() > left_) {
    throw WireError("it sends more of a file than it has said");
  }
  left_ -= bytes.size();
  bytes_ += bytes.size();
  sum_ = sum_of(bytes, sum_);
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_.get(), bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      throw error_of(part_);
    }
  }
}

void FetchedFiles::end_file(std::uint64_t sum) {
  if (!file_ || left_ != 0 || sum != sum_) {
    throw WireError("a file of a recording has come with other bytes than it has there");
  }
  file_.reset();
}

void FetchedFiles::finish(std::uint32_t files, std::uint64_t bytes) {
  if (file_ || files != files_ || bytes != bytes_) {
    throw WireError("a recording has come with other files than it has there");
  }
  if (::rename(part_.c_str(), directory_.c_str()) != 0) {
    throw error_of(directory_);
  }
  part_ = directory_;
}

void FetchedFiles::add_own_file(const std::string& name, const std::string& text) {
  replace_file(folder_, name, text);
}

void FetchedFiles::remove() noexcept {
  file_.reset();
  folder_.reset();
  std::error_code failed;
  std::filesystem::remove_all(part_, failed);
}

}  // namespace launch
