// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/unit/service_manager.hpp"

#include <fmt/format.h>
#include <pwd.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/environment/home_directory.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"

namespace launch {

namespace fs = std::filesystem;

SystemdManager::SystemdManager(bool user) : of_user_(user || ::geteuid() != 0) {
  // Sessions of sudo(8) and cron(8) lack the variable, without which systemctl(1) finds no service manager.
  const std::string usual = fmt::format("/run/user/{}", ::geteuid());
  if (of_user_ && ::getenv("XDG_RUNTIME_DIR") == nullptr && fs::exists(usual)) {
    ::setenv("XDG_RUNTIME_DIR", usual.c_str(), 0);
  }
}

fs::path SystemdManager::directory() const {
  if (!of_user_) {
    return "/etc/systemd/system";
  }
  const char* const config = ::getenv("XDG_CONFIG_HOME");
  return (config != nullptr && *config == '/' ? fs::path(config) : fs::path(home_directory()) / ".config") /
         "systemd/user";
}

fs::path SystemdManager::path_of(const std::string& unit) const {
  return directory() / (unit + ".service");
}

fs::path SystemdManager::link_of(const std::string& unit) const {
  return directory() / (of_user_ ? "default.target.wants" : "multi-user.target.wants") / (unit + ".service");
}

bool SystemdManager::runs() const {
  const char* const runtime = ::getenv("XDG_RUNTIME_DIR");
  std::error_code unreadable;
  return of_user_ ? runtime != nullptr && fs::exists(fs::path(runtime) / "systemd/private", unreadable)
                  : fs::exists("/run/systemd/system");
}

bool SystemdManager::lingers() const {
  const passwd* const user = ::getpwuid(::geteuid());
  std::error_code unreadable;
  return user != nullptr && fs::exists(fs::path("/var/lib/systemd/linger") / user->pw_name, unreadable);
}

std::vector<std::string> SystemdManager::systemctl(std::vector<std::string> words) const {
  if (of_user_) {
    words.insert(words.begin(), "--user");
  }
  words.insert(words.begin(), "systemctl");
  return words;
}

void SystemdManager::tell(const std::vector<std::string>& words) const {
  const int status = wait_for(spawn({.program = "systemctl", .argv = systemctl(words), .search_path = true}));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(fmt::format("'systemctl {}' has failed", words.front()));
  }
}

void SystemdManager::enable_later(const std::string& unit) const {
  const fs::path link = link_of(unit);
  fs::create_directories(link.parent_path());
  fs::remove(link);
  fs::create_symlink(path_of(unit), link);
}

std::map<std::string, std::string> SystemdManager::properties_of(const std::string& unit) const {
  Pipe pipe = make_pipe();
  const pid_t pid = spawn({.program = "systemctl",
                           .argv = systemctl({"show",
                                              "--property=LoadState,ActiveState,SubState,StatusText,MainPID,"
                                              "NRestarts,Result,ExecMainStatus",
                                              unit + ".service"}),
                           .search_path = true,
                           .descriptors = {{STDOUT_FILENO, pipe.write.get()}}});
  pipe.write.reset();
  std::istringstream lines(read_to_end(pipe.read));
  wait_for(pid);
  std::map<std::string, std::string> found;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t sign = line.find('=');
    if (sign != std::string::npos) {
      found[line.substr(0, sign)] = line.substr(sign + 1);
    }
  }
  return found;
}

}  // namespace launch
