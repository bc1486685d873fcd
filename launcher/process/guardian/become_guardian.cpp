// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/become_guardian.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "launcher/process/guardian/guardian_protocol.hpp"

namespace launch {

UniqueFd make_guardian_records() {
  const UniqueFd file(::memfd_create("launch-guardian", MFD_CLOEXEC));
  // The number of a standard descriptor is free when that descriptor was closed.
  UniqueFd records(file ? ::fcntl(file.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1) : -1);
  if (!records || ::ftruncate(records.get(), kGuardianRecords) != 0 ||
      ::lseek(records.get(), kGuardianRecords, SEEK_SET) != kGuardianRecords) {
    throw std::system_error(errno, std::system_category(), "cannot create a memory file for launch-guardian");
  }
  return records;
}

void become_guardian(const std::string& program, const std::vector<std::string>& words, const std::vector<int>& held) {
  for (const int descriptor : held) {
    ::fcntl(descriptor, F_SETFD, 0);
  }
  std::vector<char*> argv;
  for (const std::string& word : words) {
    argv.push_back(const_cast<char*>(word.c_str()));  // exec does not write, C has no way to say so
  }
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
}

}  // namespace launch
