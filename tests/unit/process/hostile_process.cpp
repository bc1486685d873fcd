// SPDX-License-Identifier: Apache-2.0
// hostile_process SHAPE [FILE]: a process that is hard to find or to end. It prints a line when it has its shape.
//
// leaderless   its main thread has ended, another one lives
// hidden       nobody but root may look into it
// empty        it has emptied its environment
// tracer       it traces its parent from SIGUSR2 on
// root         it belongs to root, if its file may do that (setuid)
// endless      daemons, each of which ends when it has started the next one, in a session of its own
// *-daemon     the same in a session of its own, without its parent and its output
//
// With FILE it writes the names of SIGINT and SIGTERM there, and ends by SIGTERM.
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

[[noreturn]] void wait_for_ever() {
  while (true) {
    pause();
  }
}

void* live(void*) {
  wait_for_ever();
}

void say_ready() {
  std::puts("ready");
  std::fflush(stdout);
}

// The parent prints its line when the daemon is there, and waits for ever.
void become_daemon() {
  int grown[2];
  if (pipe(grown) != 0 || fork() > 0) {
    close(grown[1]);
    char byte = 0;
    static_cast<void>(!read(grown[0], &byte, 1));
    say_ready();
    wait_for_ever();
  }
  setsid();
  if (fork() > 0) {
    _exit(0);
  }
  const int null = open("/dev/null", O_RDWR);
  for (int fd = 0; fd <= 2; ++fd) {
    dup2(null, fd);
  }
  for (int fd = 3; fd < 100; ++fd) {
    close(fd);
  }
}

std::string file;  // for the handler, which runs while this process only waits

void tell(int signal) {
  const int told = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  const char* const name = signal == SIGINT ? "INT\n" : "TERM\n";
  static_cast<void>(!write(told, name, std::strlen(name)));
  if (signal == SIGTERM) {
    _exit(0);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const pid_t parent = getppid();
  std::string shape = argc > 1 ? argv[1] : "";
  file = argc > 2 ? argv[2] : "";
  const std::size_t suffix = shape.find("-daemon");
  if (suffix != std::string::npos || shape == "endless") {
    become_daemon();
    shape.erase(std::min(suffix, shape.size()));
  }
  if (shape == "leaderless") {
    pthread_t thread{};
    pthread_create(&thread, nullptr, live, nullptr);
    say_ready();
    pthread_exit(nullptr);
  }
  if (shape == "hidden") {
    prctl(PR_SET_DUMPABLE, 0);
  }
  if (shape == "root" && setresuid(0, 0, 0) != 0) {
    return EXIT_FAILURE;
  }
  if (!file.empty()) {
    struct sigaction action {};
    action.sa_handler = tell;
    sigfillset(&action.sa_mask);  // or else of two signals the second one would be told first
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }
  if (shape == "empty") {
    for (char** variable = environ; *variable != nullptr; ++variable) {
      std::memset(*variable, 0, std::strlen(*variable));
    }
  }
  if (shape == "tracer") {
    sigset_t asked;
    sigemptyset(&asked);
    sigaddset(&asked, SIGUSR2);
    sigprocmask(SIG_BLOCK, &asked, nullptr);
    say_ready();
    int number = 0;
    sigwait(&asked, &number);
    if (getppid() == parent) {
      ptrace(PTRACE_ATTACH, parent, nullptr, nullptr);
    }
    wait_for_ever();
  }
  if (shape == "endless") {
    for (const int number : {SIGINT, SIGTERM}) {
      signal(number, SIG_IGN);
    }
    const timespec a_moment{.tv_sec = 0, .tv_nsec = 2'000'000};
    constexpr int kMost = 20'000;  // so that one that a failed test leaves does not go on for ever
    for (int generation = 0; generation < kMost; ++generation) {
      nanosleep(&a_moment, nullptr);
      if (fork() > 0) {
        _exit(0);
      }
      setsid();
    }
  }
  say_ready();
  wait_for_ever();
}
