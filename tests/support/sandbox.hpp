// SPDX-License-Identifier: Apache-2.0
// A corner of the machine for one end-to-end test: its own LTTng, network, ROS directories and process tree.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace launch {
class DomainLease;
}

namespace test_support {

// Make a sandbox at the beginning of a test, before it starts a thread or a process. It must outlive everything that
// the test starts:
//
//   test_support::Sandbox sandbox;
//   auto result = test_support::run_command({LAUNCH_BINARY, "system.launch.xml"});
//
// As root the test gets mount and network namespaces of its own. /run and /dev/shm are empty, so there is a session
// daemon and DDS shared memory for this test alone. lo is the only network; it is up and allows multicast, so Fast DDS
// discovers only the test's own nodes. Otherwise LTTNG_HOME and ROS_DOMAIN_ID keep tests apart; not_isolated() says
// what they share.
//
// HOME, LTTNG_HOME, ROS_HOME, ROS_LOG_DIR, ROS_TRACE_DIR, TMPDIR and XDG_RUNTIME_DIR point into directory(). All other
// ROS_* variables are unset; ROS_DOMAIN_ID is set. AMENT_PREFIX_PATH is what TEST_AMENT_PREFIX_PATH says, else unset.
// Processes that the test leaves behind become children of the test; they are killed and reaped at the end. A test
// fails if it leaves anything but LTTng's daemons. The directory is removed unless KEEP_TEST_DIRS is set. Environment,
// namespaces and working directory are then as before.
class Sandbox {
 public:
  Sandbox();
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path trace_directory() const { return directory_ / "traces"; }

  // A sentence about what other processes of the machine share with this test; empty as root.
  const std::string& not_isolated() const { return not_isolated_; }

  // Kills and reaps all descendants of this process. Returns the names ("sleep 1234") of those that are not LTTng
  // daemons. The destructor does the same.
  std::vector<std::string> end_processes();

  // Waits until only LTTng's daemons descend from this process. The processes that a killed launcher leaves become our
  // children, and end by themselves.
  static void wait_until_daemons_are_left();

 private:
  void enter_namespaces();
  void leave_namespaces();
  void set_environment(const std::string& name, const std::optional<std::string>& value);

  std::filesystem::path directory_;
  std::filesystem::path previous_directory_;
  std::string not_isolated_;
  std::shared_ptr<launch::DomainLease> domain_;  // when not root
  int mount_namespace_ = -1;                     // the namespace to return to
  int network_namespace_ = -1;                   // the namespace to return to
  std::map<std::string, std::optional<std::string>> previous_environment_;
};

}  // namespace test_support
