// SPDX-License-Identifier: Apache-2.0
// A directory that is a disk of its own, in memory, whose room can be taken and given back: for tests in which a disk
// is full. The disks of the machine are never filled.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/files/unique_fd.hpp"

namespace launch {

// From now on this process has a mount namespace of its own, in a user namespace of its own if that is necessary: what
// it mounts, only it sees, and the processes that it starts. Must be called while there is one thread. Throws
// std::system_error where the machine does not allow it.
void enter_own_mounts();

class MemoryDisk {
 public:
  // Mounts it on an existing directory. It holds what the directory holds, as copies. Only in a mount namespace of this
  // process's own. Throws std::system_error, also when the directory holds more than kMostCopied bytes.
  static constexpr std::uint64_t kMostCopied = 256 << 20;
  explicit MemoryDisk(std::string directory);
  MemoryDisk(MemoryDisk&&) = default;
  MemoryDisk& operator=(MemoryDisk&&) = delete;
  ~MemoryDisk() = default;

  // So many bytes of room are left from now on, in whole blocks. nullopt: as much as at the begin, half of the memory
  // of the machine. What is there stays. Throws std::system_error.
  void leave(std::optional<std::uint64_t> room);

  // Copies its files to the directory that it covers. Throws std::system_error.
  void save() const;

  const std::string& directory() const { return directory_; }

 private:
  std::uint64_t used() const;
  // False if more is used. Throws std::system_error.
  bool try_resize(std::uint64_t blocks) const;

  std::string directory_;
  UniqueFd covered_;  // the directory below
  UniqueFd root_;     // of the disk
  UniqueFd block_;    // a file without a name: a disk of size 0 would have no limit
  std::uint64_t block_size_ = 0;
  std::uint64_t whole_ = 0;  // its blocks at the begin
};

}  // namespace launch
