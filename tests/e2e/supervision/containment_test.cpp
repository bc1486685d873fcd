// SPDX-License-Identifier: Apache-2.0
// launch --contain: no process survives, whoever is killed.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{60};

// Without this capability root is like any other user: namespaces need a user namespace.
const std::vector<std::string> kUnprivileged = {"setpriv", "--bounding-set", "-sys_admin"};

std::vector<pid_t> children_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) + "/children");
  return {std::istream_iterator<pid_t>(file), {}};
}

std::string namespace_of(pid_t pid) {
  std::error_code gone;
  return fs::read_symlink("/proc/" + std::to_string(pid) + "/ns/pid", gone).string();
}

// The numbers outside of the processes in the namespace.
std::vector<std::string> processes_in(const std::string& name_space) {
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const std::string number = entry.path().filename().string();
    if (number.find_first_not_of("0123456789") == std::string::npos && namespace_of(std::stoi(number)) == name_space) {
      found.push_back(number);
    }
  }
  return found;
}

class Containment : public testing::Test {
 protected:
  void SetUp() override {
    const CommandResult allowed = run_command({"unshare", "--pid", "--fork", "--mount-proc", "true"});
    if (allowed.exit_code != 0) {
      GTEST_SKIP() << "skipped, because this machine allows no process namespace: " << allowed.err;
    }
  }

  std::string write(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  static Command contained(const std::string& file, std::vector<std::string> prefix = {}) {
    prefix.insert(prefix.end(), {LAUNCH_PROGRAM, "--contain", file});
    return {.argv = std::move(prefix)};
  }

  Sandbox sandbox_;
};

// Of a launch: the process that the user has started, the first of the namespace, guardian, spare and launcher.
std::vector<pid_t> chain_below(pid_t outside) {
  std::vector<pid_t> chain = {outside};
  for (int i = 0; i < 4; ++i) {
    const std::vector<pid_t> children = children_of(chain.back());
    if (children.empty()) {
      ADD_FAILURE() << "no process below " << chain.back();
      break;
    }
    chain.push_back(children.front());
  }
  return chain;
}

const std::string kHardToEnd = R"xml(
    <executable name="a" shell="true" output="screen" sigterm_timeout="0.1" sigkill_timeout="0.1"
                cmd="trap '' INT TERM; setsid sleep 1000 &amp; echo ready; while :; do sleep 1000; done"/>)xml";

TEST_F(Containment, WhoeverIsKilledNothingSurvives) {
  constexpr unsigned kSpareAlone = 0b01000;
  const std::string file = write(kHardToEnd);
  for (unsigned killed = 1; killed < 32; ++killed) {
    RunningCommand run(contained(file));
    ASSERT_TRUE(run.wait_for_output("[a-1] ready", kPatience)) << run.out() << run.err();
    const std::vector<pid_t> chain = chain_below(run.pid());
    ASSERT_EQ(chain.size(), 5u);
    const std::string inside = namespace_of(chain[1]);
    ASSERT_NE(inside, namespace_of(::getpid()));
    ASSERT_GE(processes_in(inside).size(), 6u);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if ((killed & (1u << i)) != 0) {
        ::kill(chain[i], SIGKILL);
      }
    }
    if (killed == kSpareAlone) {
      run.send_signal(SIGINT);  // the launch goes on
    }
    run.wait(kPatience);
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!processes_in(inside).empty() && std::chrono::steady_clock::now() < end) {
      ::waitpid(-1, nullptr, WNOHANG);
    }
    EXPECT_THAT(processes_in(inside), testing::IsEmpty()) << "killed: " << killed << "\n" << run.out() << run.err();
  }
}

TEST_F(Containment, AnOrdinaryEndIsAsGentleAsWithout) {
  const std::string file = write(R"xml(
    <executable name="worker" shell="true" output="screen"
                cmd="end() { echo cleaned up; exit; }; trap end INT; echo ready; while :; do read x; done"/>)xml");
  for (const auto& prefix : {std::vector<std::string>(), kUnprivileged}) {
    RunningCommand run(contained(file, prefix));
    ASSERT_TRUE(run.wait_for_output("[worker-1] ready", kPatience)) << run.out() << run.err();
    run.send_signal(SIGINT);
    const CommandResult result = run.wait(kPatience);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, HasSubstr("[INFO] [launch]: the launch has process numbers of its own; nothing in its "
                                      "process namespace can survive it\n"));
    EXPECT_THAT(result.out, HasSubstr("[worker-1] cleaned up"));
    EXPECT_THAT(result.out, Not(HasSubstr("what is left")));
  }
}

TEST_F(Containment, TheExitCodeIsThatOfTheLaunch) {
  EXPECT_EQ(run_command(contained(write(R"xml(<executable cmd="true"/>)xml")), kPatience).exit_code, 0);
  EXPECT_EQ(run_command(contained(write(R"xml(<executable cmd="false"/>)xml")), kPatience).exit_code, 3);
  EXPECT_EQ(
      run_command(contained(write(R"xml(<executable cmd="sh -c 'exit 7'" required="true"/>)xml")), kPatience).exit_code,
      7);
  EXPECT_EQ(run_command(contained("no-such-file.launch.xml"), kPatience).exit_code, 1);
}

TEST_F(Containment, WhenTheUsersProcessIsKilledTheLaunchEndsGently) {
  const std::string file = write(R"xml(
    <executable name="worker" shell="true" output="screen"
                cmd="end() { echo cleaned up &gt; cleaned; exit; }; trap end INT; echo ready; while :; do read x; done"/>)xml");
  Command command = contained(file);
  command.directory = sandbox_.directory();
  RunningCommand run(command);
  ASSERT_TRUE(run.wait_for_output("[worker-1] ready", kPatience));
  const std::string inside = namespace_of(chain_below(run.pid()).at(1));
  run.send_signal(SIGKILL);
  run.wait(kPatience);
  while (!processes_in(inside).empty()) {
    ::waitpid(-1, nullptr, WNOHANG);
  }
  EXPECT_EQ(read_file(sandbox_.directory() / "cleaned"), "cleaned up\n");
}

TEST_F(Containment, CtrlZStopsItAndSigcontContinuesIt) {
  const std::string file = write(R"xml(
    <executable name="worker" shell="true" output="screen"
                cmd="end() { echo cleaned up; exit; }; trap end INT; echo ready; while :; do read x; done"/>)xml");
  RunningCommand run(contained(file));
  ASSERT_TRUE(run.wait_for_output("[worker-1] ready", kPatience));
  run.send_signal(SIGTSTP);
  siginfo_t stopped{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(run.pid()), &stopped, WSTOPPED | WEXITED), 0);
  EXPECT_EQ(stopped.si_code, CLD_STOPPED);
  run.send_signal(SIGCONT);
  ASSERT_TRUE(run.wait_for_output("[launch]: continuing the system", kPatience)) << run.out();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("[worker-1] cleaned up"));
}

TEST_F(Containment, NumbersOnTheScreenAndInPsAreThoseOfTheMachine) {
  const std::string file =
      write(R"xml(<executable name="a" cmd="sh -c 'echo ready; sleep 1000'" output="screen"/>)xml");
  RunningCommand run(contained(file));
  ASSERT_TRUE(run.wait_for_output("[a-1] ready", kPatience));
  const pid_t launcher = chain_below(run.pid()).at(4);
  const std::vector<pid_t> started = children_of(launcher);
  ASSERT_EQ(started.size(), 1u);
  EXPECT_THAT(run.out(), HasSubstr("[INFO] [a-1]: process started with pid [" + std::to_string(started[0]) + "]"));
  const CommandResult ps = run_command({LAUNCH_PROGRAM, "ps", "--json", "--launch", std::to_string(run.pid())});
  EXPECT_EQ(nlohmann::json::parse(ps.out).at("launches").at(0).at("processes").at(0).at("pid"), started[0])
      << ps.out << ps.err;
  ::kill(started[0], SIGKILL);
  const CommandResult result = run.wait(kPatience);
  EXPECT_THAT(result.out, HasSubstr("process has died [pid " + std::to_string(started[0]) + ", exit code -9"));
}

// The launcher is killed while it records: the trace has a verdict all the same, by whoever is left.
TEST_F(Containment, ATraceIsEndedWhoeverIsKilled) {
  const std::string file = write("<trace session-name=\"run\"/>" + kHardToEnd);
  for (const unsigned killed : {0b00000u, 0b10000u, 0b11100u}) {  // nobody, the launcher, launcher and both guardians
    RunningCommand run(contained(file));
    ASSERT_TRUE(run.wait_for_output("[a-1] ready", kPatience)) << run.out() << run.err();
    const std::vector<pid_t> chain = chain_below(run.pid());
    ASSERT_EQ(chain.size(), 5u);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if ((killed & (1u << i)) != 0) {
        ::kill(chain[i], SIGKILL);
      }
    }
    if (killed == 0) {
      run.send_signal(SIGINT);
    }
    const CommandResult result = run.wait(kPatience);
    EXPECT_TRUE(fs::exists(sandbox_.trace_directory() / "run" / "verdict.json")) << result.out << result.err;
    fs::remove_all(sandbox_.trace_directory() / "run");
  }
}

TEST_F(Containment, AMachineThatDoesNotAllowItIsAnError) {
  const std::string file = write(R"xml(<executable cmd="touch started"/>)xml");
  const CommandResult result = run_command(
      contained(file, {"unshare", "--user", "--map-root-user", "sh", "-c",
                       "for kind in user pid; do echo 0 > /proc/sys/user/max_${kind}_namespaces || exit 1; done; exec "
                       "\"$@\"",
                       "sh"}),
      kPatience);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch: error: --contain needs a process namespace, which this machine does not allow: clone: No space "
            "left on device\n");
}

}  // namespace
