// SPDX-License-Identifier: Apache-2.0
// A real systemd, which boots in namespaces of its own and knows the units of a test alone.
#pragma once

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace test_support {

inline constexpr std::chrono::seconds kPatience{60};
inline constexpr const char* kSystemd = "/lib/systemd/systemd";

// Units of the machine must not start here: they would clean its /tmp, among other things. This systemd knows no more
// than those of the journal and of the end, and what the test installs. Its last program, which would end file systems,
// does nothing.
inline constexpr const char* kBoot = R"sh(
set -e
mount --make-rprivate /
mkdir -p "$1/cgroup" && mount -t cgroup2 none "$1/cgroup"
mkdir "$1/cgroup/launch-unit-test-$$" && echo 0 > "$1/cgroup/launch-unit-test-$$/cgroup.procs"
exec unshare --mount --pid --cgroup --ipc --uts --fork --kill-child --mount-proc sh -c '
set -e
mount -t tmpfs tmpfs /run && mkdir -p /run/lock /run/lttng
mount -t tmpfs tmpfs /var/log && mount -t tmpfs tmpfs /etc/systemd/system && mount -t cgroup2 cgroup2 /sys/fs/cgroup
cp /lib/systemd/system/systemd-journald.service /lib/systemd/system/systemd-journald*.socket /etc/systemd/system
for name in sysinit basic multi-user; do
  printf "[Unit]\nDefaultDependencies=no\n" > /etc/systemd/system/$name.target
done
printf "[Unit]\nRequires=systemd-journald.service\nWants=multi-user.target\nAfter=multi-user.target\n" > /etc/systemd/system/default.target
for name in poweroff.target systemd-poweroff.service shutdown.target umount.target final.target; do
  cp "/lib/systemd/system/$name" /etc/systemd/system
done
mount --bind /bin/true "$(command -v systemd-tmpfiles)"
mount --bind /bin/true /lib/systemd/systemd-shutdown
exec env -i container=test PATH="$PATH" SYSTEMD_UNIT_PATH=/etc/systemd/system /lib/systemd/systemd --system --log-target=null'
)sh";

inline std::vector<pid_t> children_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) + "/children");
  return {std::istream_iterator<pid_t>(file), {}};
}

class BootedSystemd : public testing::Test {
 protected:
  std::string write(const std::string& actions) const {
    const std::filesystem::path path = sandbox_.directory() / "robot.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  void TearDown() override {
    if (systemd_ > 0) {
      ::kill(systemd_, SIGKILL);  // the kernel ends everything in its namespace
      boot_->wait(kPatience);
    }
  }

  // Why there can be no systemd here, or "".
  std::string boot() {
    if (::geteuid() != 0 || !std::filesystem::exists(kSystemd)) {
      return "skipped, because this needs root and an installed systemd";
    }
    boot_ = std::make_unique<RunningCommand>(Command{.argv = {"sh", "-c", kBoot, "sh", sandbox_.directory().string()}});
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end && ::kill(boot_->pid(), 0) == 0) {
      const std::vector<pid_t> children = children_of(boot_->pid());
      systemd_ = children.empty() ? 0 : children.front();
      const std::string name =
          systemd_ == 0 ? "" : std::filesystem::path("/proc/" + std::to_string(systemd_)).string() + "/comm";
      std::ifstream file(name);
      std::string comm;
      if (std::getline(file, comm) && comm == "systemd" &&
          inside({"systemctl", "is-system-running", "--wait"}).out.starts_with("running")) {
        return "";
      }
      if (boot_->err().find("denied") != std::string::npos || boot_->err().find("not permitted") != std::string::npos) {
        break;
      }
    }
    return "skipped, because no systemd boots in namespaces here: " + boot_->err();
  }

  // A program beside the services.
  CommandResult inside(std::vector<std::string> words) const {
    words.insert(words.begin(), {"nsenter", "--target", std::to_string(systemd_), "--mount", "--pid", "--cgroup",
                                 "--ipc", "--uts", "--wdns=" + sandbox_.directory().string()});
    return run_command({.argv = std::move(words)}, kPatience);
  }

  // Waits until a unit has this value of a property.
  bool becomes(const std::string& unit, const std::string& name, const std::string& value) const {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
      if (property(unit, name) == value) {
        return true;
      }
    }
    return false;
  }

  std::string property(const std::string& unit, const std::string& name) const {
    const std::string value = inside({"systemctl", "show", "--value", "--property=" + name, unit}).out;
    return value.substr(0, value.find('\n'));
  }

  Sandbox sandbox_;
  std::unique_ptr<RunningCommand> boot_;
  pid_t systemd_ = 0;
};

}  // namespace test_support
