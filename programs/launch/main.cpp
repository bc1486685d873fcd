// SPDX-License-Identifier: Apache-2.0
// launch: runs launch files, and the commands of command_table.cpp.
#include <fcntl.h>
#include <unistd.h>

#include "launcher/python/interpreter/python_guest.hpp"
#include "programs/launch/commands.hpp"

namespace {

// A program that was started without standard descriptors (`launch … >&-`) would take their numbers for files and pipes
// of its own.
void open_standard_descriptors() {
  for (int fd = ::open("/dev/null", O_RDWR); fd >= 0; fd = ::open("/dev/null", O_RDWR)) {
    if (fd > STDERR_FILENO) {
      ::close(fd);
      break;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_descriptors();
  const int exit_code = launch::run_command_of({argv + 1, argv + argc});
  launch::end_of_guest();
  return exit_code;
}
