// SPDX-License-Identifier: Apache-2.0
// The files of a recording, in pieces, for the launcher that fetches it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"

namespace launch {

class TraceFiles {
 public:
  using Send = std::function<void(FromAgent kind, const WireWriter& content)>;

  // Looks for the regular files below the directory; links are left out. Throws std::system_error.
  TraceFiles(std::uint32_t trace, std::filesystem::path directory);

  // Sends as much as the credit allows, no more than one piece at a time. Returns whether more can be sent now.
  // Throws std::runtime_error when a file can't be read, or is shorter than it was.
  bool send_some(const Send& send);
  void add_credit(std::uint64_t bytes) { credit_ += bytes; }
  std::uint64_t credit() const { return credit_; }

 private:
  std::uint32_t trace_;
  std::filesystem::path directory_;
  std::vector<std::string> names_;
  std::size_t next_ = 0;
  UniqueFd file_;
  std::uint64_t left_ = 0;  // bytes of the file
  std::uint64_t sum_ = 0;
  std::uint64_t bytes_ = 0;  // of all files
  std::uint64_t credit_ = 0;
  bool done_ = false;
};

}  // namespace launch
