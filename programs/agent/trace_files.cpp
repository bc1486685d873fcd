// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/trace_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace launch {

namespace fs = std::filesystem;

TraceFiles::TraceFiles(std::uint32_t trace, fs::path directory) : trace_(trace), directory_(std::move(directory)) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory_)) {
    if (entry.symlink_status().type() == fs::file_type::regular) {
      names_.push_back(entry.path().lexically_relative(directory_).string());
    }
  }
  std::sort(names_.begin(), names_.end());
}

bool TraceFiles::send_some(const Send& send) {
  if (done_) {
    return false;
  }
  if (!file_) {
    if (next_ == names_.size()) {
      done_ = true;
      send(FromAgent::kTraceAll, WireWriter().u32(trace_).u32(static_cast<std::uint32_t>(names_.size())).u64(bytes_));
      return false;
    }
    const std::string& name = names_[next_++];
    file_ = UniqueFd(::open((directory_ / name).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    struct stat facts {};
    if (!file_ || ::fstat(file_.get(), &facts) != 0) {
      throw std::system_error(errno, std::system_category(), fmt::format("cannot read '{}'", name));
    }
    left_ = static_cast<std::uint64_t>(facts.st_size);
    sum_ = kSumOfNothing;
    send(FromAgent::kTraceFile, WireWriter().u32(trace_).text(name).u64(left_));
  }
  if (left_ > 0) {
    if (credit_ == 0) {
      return false;
    }
    std::array<char, kTracePiece> bytes;  // not initialised: it is read into
    const ssize_t count = ::read(file_.get(), bytes.data(), std::min<std::uint64_t>({bytes.size(), left_, credit_}));
    if (count < 0 && errno == EINTR) {
      return true;
    }
    if (count <= 0) {
      throw std::runtime_error(fmt::format("'{}' can't be read to its end", names_[next_ - 1]));
    }
    const std::string_view piece(bytes.data(), static_cast<std::size_t>(count));
    send(FromAgent::kTraceBytes, WireWriter().u32(trace_).rest(piece));
    sum_ = sum_of(piece, sum_);
    left_ -= piece.size();
    credit_ -= piece.size();
    bytes_ += piece.size();
  }
  if (left_ == 0) {
    file_.reset();
    send(FromAgent::kTraceSum, WireWriter().u32(trace_).u64(sum_));
  }
  return true;
}

}  // namespace launch
