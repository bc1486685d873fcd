// SPDX-License-Identifier: Apache-2.0
// Writes the time at which its main began to the pipe that the environment names, and then waits for a signal.
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

int main() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t nanoseconds = now.tv_sec * 1'000'000'000 + now.tv_nsec;
  const char* const path = std::getenv("STAMP_PIPE");
  const int fd = path == nullptr ? -1 : open(path, O_WRONLY | O_CLOEXEC);
  if (fd < 0 || write(fd, &nanoseconds, sizeof nanoseconds) != sizeof nanoseconds) {
    return 1;
  }
  pause();
}
