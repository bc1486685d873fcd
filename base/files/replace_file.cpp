// SPDX-License-Identifier: Apache-2.0
#include "base/files/replace_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

namespace launch {
namespace {

// How many names to try. A process that was killed while it wrote may have left some files behind.
constexpr int kMostNames = 100;

[[noreturn]] void throw_error(int error) {
  throw std::system_error(error, std::generic_category());
}

// Makes a new file beside `name` and sets `name` to the name of the new file.
UniqueFd create_beside(const UniqueFd& directory, std::string& name) {
  const std::string begin = "." + name + "." + std::to_string(::getpid()) + ".";
  for (int i = 0; i < kMostNames; ++i) {
    name = begin + std::to_string(i);
    UniqueFd file(::openat(directory.get(), name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    if (file) {
      return file;
    }
    if (errno != EEXIST) {
      throw_error(errno);
    }
  }
  throw_error(EEXIST);
}

// Returns the error number, 0 for none.
int write_all(UniqueFd file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file.get(), text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  // Some file systems, such as NFS, report only on close that there is no room.
  return ::close(file.release()) == 0 ? 0 : errno;
}

constexpr int kDirectory = O_PATH | O_DIRECTORY | O_CLOEXEC;

bool is_link_of_another(const UniqueFd& directory, const char* name) {
  struct stat status {};
  return ::fstatat(directory.get(), name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode) &&
         status.st_uid != 0 && status.st_uid != ::geteuid();
}

UniqueFd open_or_make(const UniqueFd& directory, const char* name) {
  if (is_link_of_another(directory, name)) {
    throw_error(ELOOP);
  }
  UniqueFd opened(::openat(directory.get(), name, kDirectory));
  if (!opened && errno == ENOENT) {
    // Another process may have made the directory meanwhile.
    if (::mkdirat(directory.get(), name, 0777) != 0 && errno != EEXIST) {
      throw_error(errno);
    }
    opened.reset(::openat(directory.get(), name, kDirectory | O_NOFOLLOW));
  }
  if (!opened) {
    throw_error(errno);
  }
  return opened;
}

}  // namespace

void replace_file(const UniqueFd& directory, const std::string& name, std::string_view text) {
  std::string beside = name;
  UniqueFd file = create_beside(directory, beside);
  int error = write_all(std::move(file), text);
  if (error == 0 && ::renameat(directory.get(), beside.c_str(), directory.get(), name.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    ::unlinkat(directory.get(), beside.c_str(), 0);
    throw_error(error);
  }
}

void replace_file(const std::string& path, std::string_view text) {
  const std::filesystem::path file = path;
  const std::string parent = file.has_parent_path() ? file.parent_path().string() : ".";
  const UniqueFd directory(::open(parent.c_str(), kDirectory));
  if (!directory) {
    throw_error(errno);
  }
  replace_file(directory, file.filename().string(), text);
}

UniqueFd open_or_make_directory(const std::string& path) {
  UniqueFd directory(::open(path.starts_with('/') ? "/" : ".", kDirectory));
  if (!directory) {
    throw_error(errno);
  }
  for (const std::filesystem::path& part : std::filesystem::path(path).relative_path()) {
    if (!part.empty()) {
      directory = open_or_make(directory, part.c_str());
    }
  }
  return directory;
}

}  // namespace launch
