// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/open_trace.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace tracing {
namespace {

namespace fs = std::filesystem;

// The kernel grants a lease for reading only if nobody has the file open for writing. This holds for programs of other
// users, too, whose descriptors can't be looked at. The lease is given back at once. A program that opens the file
// meanwhile has to wait for it, and we would get a signal, which is ignored by default.
bool has_writer(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return false;
  }
  bool has_writer = false;
  struct statfs system {};
  // NFS gives no lease without a delegation from the server.
  if (fstatfs(file, &system) == 0 && system.f_type != NFS_SUPER_MAGIC && fcntl(file, F_SETSIG, SIGURG) == 0) {
    if (fcntl(file, F_SETLEASE, F_RDLCK) == 0) {
      fcntl(file, F_SETLEASE, F_UNLCK);
    } else {
      has_writer = errno == EAGAIN;
    }
  }
  close(file);
  return has_writer;
}

}  // namespace

bool is_being_written(const fs::path& directory) {
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;
    if (entry->is_regular_file(gone) && has_writer(entry->path())) {
      return true;
    }
  }
  return false;
}

}  // namespace tracing
