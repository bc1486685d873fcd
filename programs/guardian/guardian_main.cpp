// SPDX-License-Identifier: Apache-2.0
// launch-guardian: the processes above the launcher (guardian.hpp, guardian_protocol.hpp).
//
// It is linked statically and stays small, because each launch has it twice: the guardian is the process that the user
// has started, its child is a spare, and the child of the spare is the launcher. Both adopt orphans, so as long as one
// of them lives, everything that the launch has started descends from it.
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <utility>

#include "launcher/process/guardian/guardian_protocol.hpp"
#include "programs/guardian/contained_launch.hpp"
#include "programs/guardian/guardian_process.hpp"
#include "programs/guardian/launch_rest.hpp"
#include "programs/guardian/spare_process.hpp"

namespace {

std::set<pid_t> numbers(const char* text) {
  std::set<pid_t> all;
  for (char* end = nullptr; *text != '\0'; text = *end == ',' ? end + 1 : end) {
    all.insert(static_cast<pid_t>(std::strtol(text, &end, 10)));
    if (end == text) {
      break;
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  using launch::UniqueFd;
  const char* const role = argc < 8 ? "" : argv[7];
  const auto is = [role](const char* name) { return std::strcmp(role, name) == 0; };
  if (!is("--") && !is("--between") && !is("--after") && !is(launch::kStandsOutside) && !is(launch::kIsFirst)) {
    std::fputs("launch-guardian is started by launch, not by hand\n", stderr);
    return EXIT_FAILURE;
  }
  if (is(launch::kStandsOutside)) {
    launch::stand_outside(std::atoi(argv[2]), std::atoi(argv[4]), UniqueFd(std::atoi(argv[5])));
  }
  if (is(launch::kIsFirst)) {
    launch::be_first(std::atoi(argv[2]), std::atoi(argv[4]), UniqueFd(std::atoi(argv[5])),
                     UniqueFd(std::atoi(argv[6])));
  }
  launch::GuardedLaunch launch{.id = argv[1],
                               .launcher = std::atoi(argv[2]),
                               .other = std::atoi(argv[3]),
                               .records = std::atoi(argv[4]),
                               .strangers = numbers(argv[6])};
  UniqueFd ready(std::atoi(argv[5]));
  if (is("--between")) {
    launch.strangers.clear();  // they are children of the guardian
    launch::stand_between(std::move(launch), std::move(ready));
  }
  if (is("--after")) {
    if (::getppid() != launch.launcher) {
      launch.launcher = -1;  // it has ended, and its number may be that of another process
    }
    launch::stand_beside(launch, {});
  }
  launch::GuardianProcess guardian(std::move(launch), std::move(ready));
  const int status = guardian.run();
  if (!guardian.ended_all() && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) {
    return EXIT_FAILURE;
  }
  launch::end_with(status);
}
