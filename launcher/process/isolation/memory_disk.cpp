// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/isolation/memory_disk.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr unsigned long kFlags = MS_NOSUID | MS_NODEV;
constexpr mode_t kPermissions = 07777;

void must_succeed(bool done, const std::string& what) {
  if (!done) {
    throw std::system_error(errno, std::system_category(), what);
  }
}

void write_text(const char* path, std::string_view text) {
  const UniqueFd file(::open(path, O_WRONLY | O_CLOEXEC));
  must_succeed(file && ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()), path);
}

// The directory of a descriptor, whatever has been mounted on it.
std::string path_of(const UniqueFd& directory) {
  return fmt::format("/proc/self/fd/{}", directory.get());
}

std::uint64_t size_of_files(const fs::path& directory) {
  std::uint64_t size = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_symlink() && entry.is_regular_file()) {
      size += entry.file_size();
    }
  }
  return size;
}

// Files, directories and symbolic links, with their permissions; owners where that is allowed.
void copy_entries(const fs::path& from, const fs::path& to) {
  for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
    const fs::path copy = to / entry.path().filename();
    struct stat status {};
    must_succeed(::lstat(entry.path().c_str(), &status) == 0, entry.path());
    if (S_ISDIR(status.st_mode)) {
      fs::create_directory(copy);
      copy_entries(entry.path(), copy);
    } else if (S_ISLNK(status.st_mode)) {
      fs::remove(copy);
      fs::copy_symlink(entry.path(), copy);
    } else if (S_ISREG(status.st_mode)) {
      fs::copy_file(entry.path(), copy, fs::copy_options::overwrite_existing);
    } else {
      continue;
    }
    static_cast<void>(!::lchown(copy.c_str(), status.st_uid, status.st_gid));
    if (!S_ISLNK(status.st_mode)) {
      must_succeed(::chmod(copy.c_str(), status.st_mode & kPermissions) == 0, copy);
    }
  }
}

}  // namespace

void enter_own_mounts() {
  const uid_t uid = ::geteuid();
  const gid_t gid = ::getegid();
  if (::unshare(CLONE_NEWNS) != 0) {
    must_succeed(::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0, "make a mount namespace");
    // Without privileges a process may map its own user and group only, and must give up setgroups(2) before.
    write_text("/proc/self/setgroups", "deny");
    write_text("/proc/self/uid_map", fmt::format("{0} {0} 1", uid));
    write_text("/proc/self/gid_map", fmt::format("{0} {0} 1", gid));
  }
  // Disks that are mounted later appear inside, and nothing that is mounted inside appears outside.
  must_succeed(::mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr) == 0, "make mounts private");
}

MemoryDisk::MemoryDisk(std::string directory) : directory_(std::move(directory)) {
  covered_.reset(::open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  struct stat status {};
  must_succeed(covered_ && ::fstat(covered_.get(), &status) == 0, directory_);
  if (size_of_files(directory_) > kMostCopied) {
    throw std::system_error(EFBIG, std::system_category(), directory_);
  }
  const std::string options = fmt::format("mode={:o}", status.st_mode & kPermissions);
  must_succeed(::mount("tmpfs", directory_.c_str(), "tmpfs", kFlags, options.c_str()) == 0,
               fmt::format("mount a disk on '{}'", directory_));
  root_.reset(::open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  must_succeed(static_cast<bool>(root_), directory_);
  static_cast<void>(!::fchown(root_.get(), status.st_uid, status.st_gid));
  block_.reset(::open(directory_.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600));
  must_succeed(block_ && ::write(block_.get(), "", 1) == 1, directory_);
  struct statvfs room {};
  must_succeed(::fstatvfs(root_.get(), &room) == 0, directory_);
  block_size_ = room.f_frsize;
  whole_ = room.f_blocks;
  copy_entries(path_of(covered_) + "/", directory_);
}

std::uint64_t MemoryDisk::used() const {
  struct statvfs room {};
  must_succeed(::fstatvfs(root_.get(), &room) == 0, directory_);
  return room.f_blocks - room.f_bfree;
}

bool MemoryDisk::try_resize(std::uint64_t blocks) const {
  const std::string options = fmt::format("size={}", blocks * block_size_);
  const bool done = ::mount(nullptr, path_of(root_).c_str(), nullptr, MS_REMOUNT | kFlags, options.c_str()) == 0;
  must_succeed(done || errno == EINVAL, fmt::format("change the size of the disk on '{}'", directory_));
  return done;
}

void MemoryDisk::leave(std::optional<std::uint64_t> room) {
  if (!room) {
    must_succeed(try_resize(whole_), directory_);
    return;
  }
  const std::uint64_t blocks = *room / block_size_;
  // The kernel refuses a size below what is used, and a program may write meanwhile. So there may be some more room at
  // first, which such a program fills, or which is taken now.
  std::uint64_t more = 0;
  while (!try_resize(used() + blocks + more)) {
    more = more == 0 ? 1 : 2 * more;
  }
  constexpr int kMostTimes = 20;
  for (int i = 0; more > 0 && i < kMostTimes && !try_resize(used() + blocks); ++i) {
  }
}

void MemoryDisk::save() const {
  copy_entries(path_of(root_) + "/", path_of(covered_));
}

}  // namespace launch
