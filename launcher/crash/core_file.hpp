// SPDX-License-Identifier: Apache-2.0
// What a core file says of the process that it is from, without a debugger: its notes, see core(5) and elf(5).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace launch {

struct MappedFile {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::uint64_t offset = 0;  // in the file, in bytes
  std::string path;
};

struct CoreFile {
  pid_t pid = 0;
  int signal = 0;
  bool has_address = false;   // the signal tells an address: SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP
  std::uint64_t address = 0;  // that could not be read, say
  pid_t sender = 0;           // who sent the signal; 0: the process has caused it itself
  std::vector<MappedFile> files;
  std::string program;  // the file that the process ran

  // The mapped file that holds the address; null for none.
  const MappedFile* file_at(std::uint64_t address) const;
};

// Nothing if the file is no core file of this kind of machine, or ends before its notes do.
std::optional<CoreFile> read_core_file(const std::string& path);

}  // namespace launch
