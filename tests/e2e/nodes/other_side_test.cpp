// SPDX-License-Identifier: Apache-2.0
// Nodes whose shared memory cannot be opened by the other side: of two users, and of two containers with one network.
// What the environment says about transports.
#include <gmock/gmock.h>
#include <pwd.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using test_support::Command;
using test_support::RunningCommand;
using testing::HasSubstr;

constexpr const char* kPing = PREFIX "/lib/demo_nodes/ping";
constexpr const char* kPong = PREFIX "/lib/demo_nodes/pong";

class OtherSideTest : public testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) {
      GTEST_SKIP() << "skipped, because only root may start programs of another user";
    }
    const passwd* nobody = getpwnam("nobody");
    if (nobody == nullptr) {
      GTEST_SKIP() << "skipped, because this machine has no user nobody";
    }
    namespace fs = std::filesystem;
    home_ = sandbox_.directory() / "home";
    fs::create_directory(home_);
    fs::permissions(sandbox_.directory(), fs::perms(0755));
    ASSERT_EQ(chown(home_.c_str(), nobody->pw_uid, nobody->pw_gid), 0);
    as_nobody_ = {"setpriv",       "--reuid", std::to_string(nobody->pw_uid), "--regid", std::to_string(nobody->pw_gid),
                  "--clear-groups"};
  }

  Command of_nobody(const std::string& program) const {
    Command command{as_nobody_};
    command.argv.push_back(program);
    for (const char* name : {"HOME", "ROS_HOME", "ROS_LOG_DIR", "LTTNG_HOME", "TMPDIR", "XDG_RUNTIME_DIR"}) {
      command.environment[name] = home_.string();
    }
    return command;
  }

  // The files of shared memory that there are now.
  static std::vector<std::string> shared_memory() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
      if (const std::string name = entry.path().filename(); name.rfind("fast", 0) == 0) {
        names.push_back(name);
      }
    }
    return names;
  }

  static void expect_to_talk(RunningCommand& ping, RunningCommand& pong) {
    EXPECT_TRUE(ping.wait_for_output("answered")) << ping.out() << ping.err() << pong.out() << pong.err();
  }

  const test_support::Sandbox sandbox_;
  std::filesystem::path home_;
  std::vector<std::string> as_nobody_;
};

TEST_F(OtherSideTest, NodesOfTwoUsersHearEachOther) {
  RunningCommand ping(Command{{kPing}});
  RunningCommand pong(of_nobody(kPong));
  expect_to_talk(ping, pong);
  // The other order: the ports of shared memory that both use belong to the other user.
  ping.end_gently();
  RunningCommand other_ping(of_nobody(kPing));
  expect_to_talk(other_ping, pong);
  pong.end_gently();
  RunningCommand other_pong(Command{{kPong}});
  EXPECT_TRUE(other_pong.wait_for_output("pong")) << other_pong.out() << other_pong.err();
}

TEST_F(OtherSideTest, NodesOfTwoContainersWithOneNetworkHearEachOther) {
  RunningCommand ping(Command{{kPing}});
  RunningCommand pong(
      Command{{"unshare", "--mount", "sh", "-c", std::string("mount -t tmpfs tmpfs /dev/shm && exec ") + kPong}});
  expect_to_talk(ping, pong);
}

TEST_F(OtherSideTest, TwoUsersWithSharedMemoryAloneAreWarned) {
  Command of_root{{kPing}};
  of_root.environment["FASTDDS_BUILTIN_TRANSPORTS"] = "SHM";
  Command of_other = of_nobody(kPong);
  of_other.environment["FASTDDS_BUILTIN_TRANSPORTS"] = "SHM";
  RunningCommand ping(of_root);
  EXPECT_TRUE(ping.wait_for_output("waiting for pong")) << ping.out() << ping.err();
  RunningCommand pong(of_other);
  EXPECT_TRUE(pong.wait_for_output("Nodes of the users 'nobody' and 'root' do not hear each other in domain"))
      << pong.out() << pong.err();
  EXPECT_TRUE(pong.wait_for_output("(FASTDDS_BUILTIN_TRANSPORTS=DEFAULT)"));
}

TEST_F(OtherSideTest, TheEnvironmentChoosesTheTransports) {
  for (const char* transports : {"UDPv4", "SHM", "DEFAULT"}) {
    SCOPED_TRACE(transports);
    Command ping_command{{kPing}};
    Command pong_command{{kPong}};
    ping_command.environment["FASTDDS_BUILTIN_TRANSPORTS"] = transports;
    pong_command.environment["FASTDDS_BUILTIN_TRANSPORTS"] = transports;
    RunningCommand ping(ping_command);
    RunningCommand pong(pong_command);
    expect_to_talk(ping, pong);
    EXPECT_EQ(shared_memory().empty(), std::string(transports) == "UDPv4");
    ping.end_gently();
    pong.end_gently();
  }
}

TEST_F(OtherSideTest, AMisspeltTransportIsAWarning) {
  Command command{{kPing}};
  command.environment["FASTDDS_BUILTIN_TRANSPORTS"] = "UDP";
  RunningCommand ping(command);
  EXPECT_TRUE(ping.wait_for_output("FASTDDS_BUILTIN_TRANSPORTS is 'UDP', but must be DEFAULT, DEFAULTv6, SHM"))
      << ping.out() << ping.err();
}

TEST_F(OtherSideTest, ProfilesAreReadFromBothVariables) {
  const std::string file = (sandbox_.directory() / "profiles.xml").string();
  test_support::write_file(file, R"(<?xml version="1.0"?>
<dds><profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <transport_descriptors><transport_descriptor>
    <transport_id>udp</transport_id><type>UDPv4</type>
  </transport_descriptor></transport_descriptors>
  <participant profile_name="udp_alone" is_default_profile="true"><rtps>
    <userTransports><transport_id>udp</transport_id></userTransports>
    <useBuiltinTransports>false</useBuiltinTransports>
  </rtps></participant>
</profiles></dds>
)");
  for (const char* variable : {"FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"}) {
    SCOPED_TRACE(variable);
    Command ping_command{{kPing}};
    Command pong_command{{kPong}};
    ping_command.environment[variable] = file;
    pong_command.environment[variable] = file;
    RunningCommand ping(ping_command);
    RunningCommand pong(pong_command);
    expect_to_talk(ping, pong);
    EXPECT_THAT(shared_memory(), testing::IsEmpty());
    ping.end_gently();
    pong.end_gently();
  }
  Command command{{kPing}};
  command.environment["FASTDDS_DEFAULT_PROFILES_FILE"] = file + ".none";
  RunningCommand ping(command);
  EXPECT_TRUE(ping.wait_for_output("FASTDDS_DEFAULT_PROFILES_FILE is '" + file +
                                   ".none', whose profiles cannot be read; they have no effect"))
      << ping.out() << ping.err();
}

}  // namespace
