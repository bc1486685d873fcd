// SPDX-License-Identifier: Apache-2.0
// A corner of the machine for one end-to-end test: its own LTTng, network, ROS directories and process tree.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace test_support {

// Make one at the beginning of a test, before it starts a thread or a process, and let it outlive everything it starts:
//
//   test_support::Sandbox sandbox;
//   auto result = test_support::run_command({LAUNCH_BINARY, "system.launch.xml"});
//
// As root the test gets mount and network namespaces of its own: /run and /dev/shm are empty (hence a session daemon
// and DDS shared memory of its own) and lo is the only network, up, with multicast (hence Fast DDS discovery among the
// test's own nodes only). Otherwise LTTNG_HOME and ROS_DOMAIN_ID keep tests apart; not_isolated() says what they share.
//
// HOME, LTTNG_HOME, ROS_HOME, ROS_LOG_DIR, ROS_TRACE_DIR and TMPDIR point into directory(). All other ROS_* variables
// and AMENT_PREFIX_PATH are unset; ROS_DOMAIN_ID is set. Whatever the test's processes leave behind becomes a child of
// the test and is killed and reaped at the end; leaving anything but LTTng's daemons fails the test. The
// directory is removed unless KEEP_TEST_DIRS is set. Environment, namespaces and working directory are then as before.
class Sandbox {
 public:
  Sandbox();
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path trace_directory() const { return directory_ / "traces"; }

  // What other processes of the machine share with this test, as a sentence; empty as root.
  const std::string& not_isolated() const { return not_isolated_; }

  // Kills and reaps all descendants of this process. Returns the names ("sleep 1234") of those that are no LTTng
  // daemons. The destructor does it, too.
  std::vector<std::string> end_processes();

  // Until nothing but LTTng's daemons descends from this process. For what a killed launcher leaves: it becomes ours,
  // and goes by itself.
  static void wait_until_daemons_are_left();

 private:
  void enter_namespaces();
  void leave_namespaces();
  void set_environment(const std::string& name, const std::optional<std::string>& value);

  std::filesystem::path directory_;
  std::filesystem::path previous_directory_;
  std::string not_isolated_;
  int mount_namespace_ = -1;    // to return to
  int network_namespace_ = -1;  // to return to
  std::map<std::string, std::optional<std::string>> previous_environment_;
};

}  // namespace test_support
