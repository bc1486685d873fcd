// SPDX-License-Identifier: Apache-2.0
// without_system_call NAME ERROR PROGRAM [ARGUMENT…]: runs the program as if the kernel did not have this system call
// (ENOSYS), or as if a seccomp profile forbade it (EPERM).
#include <errno.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>

namespace {

int number_of(const std::string& name) {
  return name == "pidfd_open" ? SYS_pidfd_open : name == "signalfd4" ? SYS_signalfd4 : SYS_pidfd_send_signal;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    return EXIT_FAILURE;
  }
  const unsigned error = std::string(argv[2]) == "EPERM" ? EPERM : ENOSYS;
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number_of(argv[1])), 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program = {static_cast<unsigned short>(std::size(filter)), filter};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) {
    std::perror("seccomp");
    return 77;
  }
  ::execv(argv[3], argv + 3);
  return EXIT_FAILURE;
}
