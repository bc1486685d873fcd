// SPDX-License-Identifier: Apache-2.0
// random_tree SEED: becomes a tree of processes that make it hard to find and end them. Each of them waits for ever, or
// ends after its children were started, so that they become orphans. The same seed makes the same tree.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <random>

namespace {

constexpr int kDeepest = 3;

bool happens(std::mt19937& random, int percent) {
  return static_cast<int>(random() % 100) < percent;
}

[[noreturn]] void wait_for_ever() {
  while (true) {
    pause();
  }
}

void grow(std::mt19937& random, int depth) {
  const int children = depth == kDeepest ? 0 : static_cast<int>(random() % 3);
  for (int i = 0; i < children; ++i) {
    std::mt19937 of_child(static_cast<unsigned>(random()));
    if (fork() == 0) {
      grow(of_child, depth + 1);
      wait_for_ever();
    }
  }
  if (depth > 0 && happens(random, 30)) {
    setsid();
  } else if (happens(random, 20)) {
    setpgid(0, 0);
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (happens(random, 30)) {
      ::signal(signal, SIG_IGN);
    }
  }
  if (depth > 0 && happens(random, 30)) {
    const int null = open("/dev/null", O_RDWR);
    for (int fd = 0; fd <= 2; ++fd) {
      dup2(null, fd);
    }
  }
  if (happens(random, 20) && fork() > 0) {
    _exit(0);  // leaves an orphan, which goes on below
  }
  if (depth == 0) {
    std::puts("grown");
    std::fflush(stdout);
  }
  if (happens(random, 10)) {
    raise(SIGSTOP);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::mt19937 random(static_cast<unsigned>(argc > 1 ? std::atoi(argv[1]) : 0));
  grow(random, 0);
  wait_for_ever();
}
