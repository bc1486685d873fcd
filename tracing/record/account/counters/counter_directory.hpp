// SPDX-License-Identifier: Apache-2.0
// The directory in which the processes of a launch count their events.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/files/unique_fd.hpp"

namespace tracing {

// A directory in shared memory for the files of all processes of a launch, removed with its last owner.
class CounterDirectory {
 public:
  // The directory of this process, which all sessions of a launch share. It is made when no session has it yet. Null
  // when there is no room. Directories that killed launches of this user have left are removed before: nobody has used
  // them for ten minutes.
  static std::shared_ptr<CounterDirectory> shared();
  // The directory of the launch that records this session, for a program that is not the launch; "" if there is none.
  static std::string of_session(const std::string& lttng_session_name);

  explicit CounterDirectory(std::filesystem::path path);
  ~CounterDirectory();
  CounterDirectory(const CounterDirectory&) = delete;
  CounterDirectory& operator=(const CounterDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  launch::UniqueFd in_use_;  // locked, so that no other launch removes the directory
};

// For CounterDirectory::of_session().
void note_session(const std::filesystem::path& counters, const std::string& lttng_session_name);

}  // namespace tracing
