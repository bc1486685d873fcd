// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/spawn/generated_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <system_error>

#include "base/files/unique_fd.hpp"

namespace launch {
namespace {

void write_file(const std::string& path, std::string_view content) {
  const UniqueFd file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  while (file && !content.empty()) {
    const ssize_t written = ::write(file.get(), content.data(), content.size());
    if (written < 0 && errno != EINTR) {
      throw std::system_error(errno, std::system_category(), fmt::format("cannot write '{}'", path));
    }
    content.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  if (!file) {
    throw std::system_error(errno, std::system_category(), fmt::format("cannot create '{}'", path));
  }
}

}  // namespace

GeneratedFiles::~GeneratedFiles() {
  if (!directory_.empty()) {
    std::error_code ignored;  // files left in a temporary directory hurt less than an exception here
    std::filesystem::remove_all(directory_, ignored);
  }
}

void GeneratedFiles::write(ProcessSpec& spec, ProcessId id) {
  for (std::size_t i = 0; i < spec.files.size(); ++i) {
    const GeneratedFile& file = spec.files[i];
    std::string name = file.name;
    std::replace(name.begin(), name.end(), '/', '_');
    const std::string path = fmt::format("{}/{}-{}-{}", directory(), id, i, name);
    ::unlink(path.c_str());  // of an earlier start with another spec
    write_file(path, file.content);
    spec.argv.at(file.argument) = path;
  }
}

const std::string& GeneratedFiles::directory() {
  if (!directory_.empty()) {
    return directory_;
  }
  int error = ENOENT;
  for (const char* base : std::initializer_list<const char*>{::getenv("XDG_RUNTIME_DIR"), ::getenv("TMPDIR"), "/tmp"}) {
    if (base == nullptr || *base != '/') {
      continue;
    }
    // The guardian has to know the name before the directory exists, so mkdtemp(3) can't choose it.
    std::uint64_t number = 0;
    static_cast<void>(::getrandom(&number, sizeof number, 0));
    std::string path = fmt::format("{}/launch-{:016x}", base, number);
    if (make(path)) {
      directory_ = path;
      return directory_;
    }
    error = errno;
  }
  throw std::system_error(error, std::system_category(),
                          "cannot create a directory for parameter files in /tmp (TMPDIR may name another place)");
}

bool GeneratedFiles::make(const std::string& path) {
  if (announce_) {
    announce_(path);
  }
  if (::mkdir(path.c_str(), 0700) == 0) {
    return true;
  }
  const int error = errno;
  if (withdraw_) {
    withdraw_();
  }
  errno = error;
  return false;
}

}  // namespace launch
