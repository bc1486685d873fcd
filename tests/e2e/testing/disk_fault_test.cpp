// SPDX-License-Identifier: Apache-2.0
// Full disks in the tests of launch files: programs meet ENOSPC, the launcher goes on, and the machine's disks are as
// before.
#include <gmock/gmock.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class DiskFaultTest : public LaunchTestFixture {
 protected:
  // A program that appends to the file until that fails, tells why, and tells when it works again. Then it ends.
  std::string writer(const std::string& file) {
    const std::string path = sandbox_.directory() / "writer.sh";
    write_file(path, R"xml(error=$(mktemp)
while head -c 65536 /dev/zero 2>$error >>$1; do echo written; sleep 0.02; done
cat $error
echo full
until head -c 65536 /dev/zero 2>$error >>$1; do sleep 0.02; done
echo room again
rm $error
)xml");
    return "<executable name=\"writer\" cmd=\"sh " + path + " " + file + "\"/>\n";
  }

  std::string write(const std::string& actions) { return LaunchTestFixture::write("a.launch.xml", actions); }

  fs::path make_directory(const char* name) {
    const fs::path directory = sandbox_.directory() / name;
    fs::create_directories(directory);
    return directory;
  }
};

TEST_F(DiskFaultTest, AProgramMeetsAFullDiskAndFindsRoomAfterwards) {
  const fs::path data = make_directory("data");
  write_file(data / "map.yaml", "resolution: 0.05\n");
  const std::string file = write(
      writer(data / "bag") + "<executable name=\"reader\" cmd=\"cat " + data.string() +
      R"xml(/map.yaml"/>
  <test name="t">
    <fault do="fill_disk" path=")xml" +
      data.string() +
      R"xml(" for="0.5..0.6"><depends_on process="writer" condition="output" pattern="written" occurrence="3"/></fault>
    <in_order process="writer">
      <line text="written"/><line text="No space left on device"/><line text="full"/><line text="room again"/>
    </in_order>
    <output process="reader" text="resolution: 0.05"/>
    <exit process="writer"/>
  </test>)xml");
  const std::string json = sandbox_.directory() / "result.json";
  const CommandResult result = run({file, "--json", json});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(plain(result.out), "PASS  a.launch.xml: t  T s  (1 of 1 fault)\n\n1 test: 1 passed, in T s\n");
  const auto fault = nlohmann::json::parse(read_file(json))["tests"][0]["faults"][0];
  EXPECT_THAT(fault["what"].get<std::string>(), HasSubstr("full disk at '" + data.string() + "' for 0."));
  EXPECT_EQ(read_file(data / "map.yaml"), "resolution: 0.05\n");
  EXPECT_FALSE(fs::exists(data / "bag")) << "it was written in the test only";
}

TEST_F(DiskFaultTest, SomeRoomMayBeLeft) {
  const fs::path data = make_directory("data");
  const std::string file =
      write("<executable name=\"writer\" cmd=\"sh -c 'head -c 100000 /dev/zero > " + data.string() +
            "/a &amp;&amp; echo first; head -c 1000000 /dev/zero > " + data.string() + R"xml(/b || echo second'"/>
  <test name="t">
    <fault do="fill_disk" path=")xml" +
            data.string() +
            R"xml(" free="200K"/>
    <in_order process="writer"><line text="first"/><line text="second"/></in_order>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

// Supervision needs no disk: lines are seen, processes are started again, and exits are judged. What was written before
// and afterwards is kept with the files of the test.
TEST_F(DiskFaultTest, SupervisionGoesOnWhenTheDiskOfTheLogsIsFull) {
  const std::string file = write(R"xml(
  <executable name="noisy" cmd="sh -c 'seq 1 20000; echo noise over; exec sleep 100'" output="both"/>
  <executable name="again" cmd="sh -c 'echo begun; exec sleep 100'" respawn="true" output="both"/>
  <test name="t">
    <fault do="fill_disk"/>
    <fault process="again" do="kill"><depends_on process="noisy" condition="output" pattern="noise over"/>
      <depends_on process="again" condition="output" pattern="begun"/></fault>
    <output process="again" text="begun" min="2"/>
    <output process="noisy" text="19999"/>
    <exit process="noisy" when="shutdown" code="any"/>
  </test>)xml");
  const fs::path directory = sandbox_.directory() / "kept";
  const CommandResult result = run({file, "--keep", "--directory", directory});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: t  T s  (2 of 2 faults)"));
  const std::string screen = read_file(directory / "0001-t/output.txt");
  EXPECT_THAT(screen, AllOf(HasSubstr("fault 1: full disk of the logs"), HasSubstr("No space left on device")));
  std::string log;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory / "0001-t/log")) {
    if (entry.path().filename() == "launch.log" && !entry.is_symlink()) {
      log = read_file(entry.path());
    }
  }
  EXPECT_THAT(log, AllOf(HasSubstr("process started with pid"), Not(HasSubstr("19999")))) << "it was full at once";
}

TEST_F(DiskFaultTest, EachRunHasTheDiskOfItsOwnRosHome) {
  const std::string file = write(writer("$(env ROS_HOME)/bag") + R"xml(
  <test name="t"><fault do="fill_disk" path="$(env ROS_HOME)" at="0.1" for="0.5"/>
    <output process="writer" text="No space left on device"/><exit process="writer"/></test>)xml");
  const fs::path directory = sandbox_.directory() / "kept";
  const CommandResult result = run({file, "--keep", "--directory", directory, "--seeds", "2"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(fs::exists(directory / "0001-t__seed_1_/ros/bag")) << "files of the test are kept";
}

// The session daemon that the test begins must not have the disks of the test.
TEST_F(DiskFaultTest, ATestWithATraceMayHaveAFullDisk) {
  const fs::path data = make_directory("data");
  const std::string nodes = R"xml(
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping" on_exit="shutdown"><param name="count" value="3"/></node>)xml";
  const std::string full = write(nodes + R"xml(
  <test name="t">
    <fault do="fill_disk" path=")xml" +
                                 data.string() + R"xml("/>
    <event name="ros2:rcl_publish" min="3"/>
    <exit process="ping"/>
  </test>)xml");
  const CommandResult result = run({full});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string later =
      LaunchTestFixture::write("b.launch.xml", "<trace session-name=\"later\" base-path=\"" + data.string() +
                                                   "\" events-ust=\"ros2:*\"/>" + nodes);
  const CommandResult after = run_command({.argv = {LAUNCH_PROGRAM, later}}, std::chrono::seconds(60));
  EXPECT_EQ(after.exit_code, 0) << after.out << after.err;
  EXPECT_THAT(after.out, HasSubstr("trace written to: " + data.string())) << "nothing covers what the daemon writes";
}

TEST_F(DiskFaultTest, NoTestPassesWithADirectoryThatCannotBeADisk) {
  const fs::path data = make_directory("data");
  fs::resize_file((write_file(data / "large", ""), data / "large"), 300 << 20);
  const std::string file = write(R"xml(
  <executable name="p" cmd="true"/>
  <trace session-name="own"/>
  <test name="missing"><fault do="fill_disk" path="/nowhere/data"/><exit process="p"/></test>
  <test name="around"><fault do="fill_disk" path="/"/><exit process="p"/></test>
  <test name="large"><fault do="fill_disk" path=")xml" +
                                 data.string() +
                                 R"xml("/><exit process="p"/></test>
  <test name="trace"><fault do="fill_disk" path="$(env ROS_TRACE_DIR)"/><event name="ros2:*"/><exit process="p"/></test>)xml");
  const CommandResult result = run({file, "-j", "1"});
  EXPECT_EQ(result.exit_code, 1);
  const std::string out = plain(result.out);
  EXPECT_THAT(out, HasSubstr(R"xml(FAIL  a.launch.xml: missing  T s
a.launch.xml:5:52: error: a full disk is not possible here: '/nowhere/data' is no directory
    5 |   <test name="missing"><fault do="fill_disk" path="/nowhere/data"/><exit process="p"/></test>
      |                                                    ^~~~~~~~~~~~~
      = help: a directory must be there when the test begins
)xml"));
  EXPECT_THAT(out, HasSubstr(R"xml(error: a full disk is not possible here: '/' holds the files of the test
    6 |   <test name="around"><fault do="fill_disk" path="/"/><exit process="p"/></test>
      |                                                   ^
      = help: without path, the disk of the logs is full; launch test --directory puts the files elsewhere
)xml"));
  EXPECT_THAT(out, HasSubstr("error: a full disk is not possible here: 'data' holds more than 256 MiB\n"));
  EXPECT_THAT(out, HasSubstr("      = help: a test works on a copy of the directory, in memory\n"));
  EXPECT_THAT(out, HasSubstr("      = help: LTTng's daemons write it, and they do not see the disks of a test\n"));
}

// unshare(2) fails as where namespaces are forbidden.
[[noreturn]] void become_without_namespaces(const std::string& file) {
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_unshare, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{4, filter};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0) {
    ::execl(LAUNCH_PROGRAM, LAUNCH_PROGRAM, "test", file.c_str(), "--junit", (file + ".junit").c_str(), nullptr);
  }
  ::_exit(99);
}

TEST_F(DiskFaultTest, NoTestPassesWhereTheyAreNotPossible) {
  const std::string file = write(R"xml(
  <executable name="p" cmd="true"/>
  <test name="t"><fault do="fill_disk" probability="0"/><exit process="p"/></test>)xml");
  const pid_t child = ::fork();
  if (child == 0) {
    become_without_namespaces(file);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(read_file(file + ".junit"),
              HasSubstr("a full disk is not possible here: make a mount namespace: Operation not permitted"));
}

}  // namespace
