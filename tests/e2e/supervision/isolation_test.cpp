// SPDX-License-Identifier: Apache-2.0
// launch --isolate: launches with the same topics side by side.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <regex>
#include <set>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{60};
const std::string kOwnNetwork = "the launch has a network and a /dev/shm of its own";
const std::string kLeased = "the launch is isolated by ROS_DOMAIN_ID=";

// Without this capability root is like any other user: namespaces need a user namespace.
const std::vector<std::string> kUnprivileged = {"setpriv", "--bounding-set", "-sys_admin"};
// A user namespace in which no further namespaces can be made.
const std::vector<std::string> kNoNamespaces = {
    "unshare",
    "--user",
    "--map-root-user",
    "sh",
    "-c",
    "for kind in user net ipc mnt; do echo 0 > /proc/sys/user/max_${kind}_namespaces || exit 1; done; exec \"$@\"",
    "sh"};

class Isolation : public testing::Test {
 protected:
  Command launch(std::vector<std::string> words, const std::vector<std::string>& prefix = {}) const {
    words.insert(words.begin(), LAUNCH_PROGRAM);
    words.insert(words.begin(), prefix.begin(), prefix.end());
    return {.argv = std::move(words), .directory = sandbox_.directory()};
  }

  std::string write(const std::string& name, const std::string& actions) const {
    write_file(sandbox_.directory() / name, "<launch>\n" + actions + "\n</launch>\n");
    return name;
  }

  // Says a word on a topic that has the same name everywhere, and prints what it hears there.
  std::string write_pair() const {
    return write("pair.launch.xml",
                 "<arg name=\"word\"/>\n<let name=\"message\" value=\"data: $(var word)\"/>\n"
                 "<node pkg=\"demo_nodes\" exec=\"listener\" output=\"screen\"/>\n"
                 "<executable name=\"say\" output=\"log\" cmd=\"" +
                     std::string(LAUNCH_PROGRAM) +
                     " topic pub --rate 20 /chatter std_msgs/msg/String $(var message)\"/>");
  }

  Sandbox sandbox_;
};

// What the listener has heard.
std::set<std::string> heard(const std::string& output) {
  static const std::regex pattern(R"(I heard: \[(\w+)\])");
  std::set<std::string> words;
  for (std::sregex_iterator match(output.begin(), output.end(), pattern), end; match != end; ++match) {
    words.insert((*match)[1]);
  }
  return words;
}

std::string domain_of(const std::string& output) {
  std::smatch match;
  return std::regex_search(output, match, std::regex(kLeased + R"((\d+))")) ? match[1].str() : "";
}

// Starts several pairs at once, waits until each has heard itself, and checks that it has heard nothing else. All of
// them run until the last one has been heard.
class Pairs {
 public:
  void start(std::size_t count, const std::function<Command(const std::string& word)>& command) {
    for (std::size_t i = 0; i < count; ++i) {
      words_.push_back("word" + std::to_string(i));
      runs_.push_back(std::make_unique<RunningCommand>(command("word:=" + words_.back())));
    }
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_TRUE(runs_[i]->wait_for_output("[" + words_[i] + "]", kPatience)) << runs_[i]->out() << runs_[i]->err();
    }
  }
  void end() {
    for (const auto& run : runs_) {
      run->send_signal(SIGINT);
    }
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const CommandResult result = runs_[i]->wait(kPatience);
      EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
      EXPECT_THAT(heard(result.out), testing::ElementsAre(words_[i])) << result.out;
    }
  }
  const RunningCommand& run(std::size_t number) const { return *runs_[number]; }

 private:
  std::vector<std::string> words_;
  std::vector<std::unique_ptr<RunningCommand>> runs_;
};

TEST_F(Isolation, KeepsLaunchesWithTheSameTopicsApart) {
  const std::string file = write_pair();
  Pairs pairs;
  pairs.start(4, [&](const std::string& word) { return launch({"--isolate", file, word}); });
  if (pairs.run(0).out().find(kLeased) != std::string::npos) {
    std::cout << "namespaces are not allowed here, so each launch has a domain\n";
  }
  pairs.end();
}

TEST_F(Isolation, LeasesDomainsWhereNamespacesAreNotAllowed) {
  const std::string file = write_pair();
  const bool may_forbid = run_command({"unshare", "--user", "--map-root-user", "true"}).exit_code == 0;
  Pairs pairs;
  pairs.start(2, [&](const std::string& word) {
    return launch({"--isolate", file, word}, may_forbid ? kNoNamespaces : std::vector<std::string>{});
  });
  EXPECT_THAT(pairs.run(0).out(), HasSubstr("[WARNING] [launch]: namespaces are not allowed here (unshare: "));
  EXPECT_NE(domain_of(pairs.run(0).out()), domain_of(pairs.run(1).out()));
  pairs.end();
}

TEST_F(Isolation, GivesAProcessItsDomainAndTakesItBackFromAKilledLaunch) {
  const std::string file = write("wait.launch.xml",
                                 "<executable shell=\"true\" cmd=\"echo domain $ROS_DOMAIN_ID; exec sleep 1000\" "
                                 "output=\"screen\"/>");
  if (run_command({"unshare", "--user", "--map-root-user", "true"}).exit_code != 0) {
    GTEST_SKIP() << "skipped, because namespaces can't be forbidden for a launch";
  }
  RunningCommand run(launch({"--isolate", file}, kNoNamespaces));
  ASSERT_TRUE(run.wait_for_output("domain ", kPatience)) << run.out() << run.err();
  ASSERT_TRUE(run.wait_for_output("\n"));
  const std::string domain = domain_of(run.out());
  EXPECT_THAT(run.out(), HasSubstr("domain " + domain + "\n"));
  const auto is_leased = [&] {
    // 32768 plus the domain, as a port in /proc/net/tcp.
    char port[16];
    ::snprintf(port, sizeof port, ":%04X ", 32768 + std::stoi(domain));
    std::string bound =
        run_command({"python3", "-c", "import socket, sys\ns = socket.socket()\ns.bind(('', 32768 + int(sys.argv[1])))",
                     domain})
            .err;
    return bound.find("Address already in use") != std::string::npos;
  };
  EXPECT_TRUE(is_leased());
  run.send_signal(SIGKILL);
  run.wait();
  Sandbox::wait_until_daemons_are_left();
  EXPECT_FALSE(is_leased());
}

// The expectations of a launch with namespaces of its own, made with or without privileges.
class Namespaces : public Isolation, public testing::WithParamInterface<bool> {
 protected:
  std::vector<std::string> prefix() const { return GetParam() ? std::vector<std::string>{} : kUnprivileged; }

  // Runs it if the machine allows it.
  CommandResult isolated(const std::vector<std::string>& words) const {
    std::vector<std::string> all = {"--isolate"};
    all.insert(all.end(), words.begin(), words.end());
    return run_command(launch(all, prefix()), kPatience);
  }
};

TEST_P(Namespaces, HaveTheirOwnNetworkAndSharedMemoryAndTheFilesOfTheMachine) {
  write_file("/dev/shm/outside", "");
  const std::string file = write("look.launch.xml", R"xml(
    <executable shell="true" output="screen" name="look" cmd="readlink /proc/self/ns/net /proc/self/ns/ipc;
      ls /dev/shm; touch /dev/shm/inside; cat /proc/net/dev | grep -c : ; pwd; ls look.launch.xml;
      echo domain $ROS_DOMAIN_ID; id -u; ls /proc/self/fd | wc -l"/>)xml");
  const CommandResult result = isolated({file});
  if (result.out.find(kLeased) != std::string::npos) {
    GTEST_SKIP() << "skipped, because namespaces are not allowed here";
  }
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("[INFO] [launch]: " + kOwnNetwork + "\n"), HasSubstr("[look-1] 1\n"),
                                HasSubstr("[look-1] " + sandbox_.directory().string() + "\n"),
                                HasSubstr("[look-1] look.launch.xml\n"), HasSubstr("[look-1] domain 1\n"),
                                HasSubstr("[look-1] " + std::to_string(::geteuid()) + "\n"),
                                HasSubstr("[look-1] 4\n")));  // standard descriptors, and that of the directory
  EXPECT_THAT(result.out, Not(HasSubstr("outside")));
  EXPECT_FALSE(fs::exists("/dev/shm/inside"));
  for (const char* const name : {"net", "ipc"}) {
    EXPECT_THAT(result.out, Not(HasSubstr(fs::read_symlink(std::string("/proc/self/ns/") + name).string())));
    EXPECT_THAT(result.out, ContainsRegex("\\[look-1\\] " + std::string(name) + ":\\[[0-9]+\\]\n"));
  }
}

TEST_P(Namespaces, HideALaunchFromNobodyWhoMaySteerIt) {
  const std::string file = write("wait.launch.xml",
                                 "<executable name=\"sleeper\" shell=\"true\" cmd=\"echo ready; exec sleep 1000\" "
                                 "output=\"screen\"/>");
  RunningCommand run(launch({"--isolate", file}, prefix()));
  ASSERT_TRUE(run.wait_for_output("ready", kPatience)) << run.out() << run.err();
  EXPECT_THAT(run_command(launch({"ps"})).out,
              AllOf(ContainsRegex("sleeper-1 +running"),
                    ContainsRegex("^launch [0-9]+: wait.launch.xml, running for [0-9:]+, 1 process, isolated by "
                                  "(namespaces|ROS_DOMAIN_ID=[0-9]+)\n")));
  EXPECT_EQ(run_command(launch({"shutdown"}), kPatience).exit_code, 0);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0) << run.out() << run.err();
}

TEST_P(Namespaces, LeaveNothingBehindAfterKill9) {
  const std::string file = write("wait.launch.xml",
                                 "<executable shell=\"true\" cmd=\"setsid sleep 1000 &amp; echo ready; sleep 1000\" "
                                 "sigterm_timeout=\"0.2\" sigkill_timeout=\"0.2\" "
                                 "output=\"screen\"/>");
  RunningCommand run(launch({"--isolate", file}, prefix()));
  ASSERT_TRUE(run.wait_for_output("ready", kPatience)) << run.out() << run.err();
  run.send_signal(SIGKILL);
  run.wait(kPatience);
  Sandbox::wait_until_daemons_are_left();
}

TEST_P(Namespaces, AreTraced) {
  const std::string file = write("traced.launch.xml", R"xml(
    <trace session-name="isolated"/>
    <node pkg="demo_nodes" exec="pong"/>
    <node pkg="demo_nodes" exec="ping" on_exit="shutdown"><param name="count" value="3"/><param name="period_ms" value="50"/></node>)xml");
  const CommandResult result = isolated({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("trace is complete")) << result.out;
  const CommandResult events =
      run_command(launch({"trace", "read", "--count", (sandbox_.trace_directory() / "isolated").string()}), kPatience);
  EXPECT_THAT(events.out, ContainsRegex("ros2:callback_start")) << events.out << events.err;
}

// No session daemon has run since the machine was started, so the files do not exist by which it wakes programs.
TEST_P(Namespaces, LetASessionDaemonThatStartsLaterWakeTheirProcesses) {
  const std::string file = write("early.launch.xml", R"xml(<node pkg="demo_nodes" exec="listener"/>
    <node pkg="demo_nodes" exec="talker" output="screen"/>)xml");
  ASSERT_FALSE(fs::exists("/dev/shm/lttng-ust-wait-8") && ::geteuid() == 0);
  RunningCommand run(launch({"--isolate", file}, prefix()));
  ASSERT_TRUE(run.wait_for_output("Hello World", kPatience)) << run.out() << run.err();
  ASSERT_EQ(run_command({"lttng", "create", "later"}).exit_code, 0);
  std::string registered;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  do {
    registered = run_command({"lttng", "list", "--userspace"}).out;
  } while ((registered.find("/talker") == std::string::npos || registered.find("/listener") == std::string::npos) &&
           std::chrono::steady_clock::now() < deadline);
  EXPECT_THAT(registered, AllOf(HasSubstr("/talker"), HasSubstr("/listener")));
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0) << run.out() << run.err();
}

TEST_P(Namespaces, NeedNoRoomInTheSharedMemoryOfTheMachine) {
  const std::string file = write("full.launch.xml", R"xml(<node pkg="demo_nodes" exec="pong"/>
    <node pkg="demo_nodes" exec="ping" on_exit="shutdown"><param name="count" value="2"/></node>)xml");
  std::vector<std::string> full = {"unshare",
                                   "--mount",
                                   "sh",
                                   "-c",
                                   "mount -t tmpfs -o size=4k tmpfs /dev/shm && "
                                   "head -c 4096 /dev/zero > /dev/shm/full && exec \"$@\"",
                                   "sh"};
  if (run_command({"unshare", "--mount", "mount", "-t", "tmpfs", "tmpfs", "/dev/shm"}).exit_code != 0) {
    GTEST_SKIP() << "skipped, because /dev/shm can't be replaced";
  }
  const std::vector<std::string> user = prefix();
  full.insert(full.end(), user.begin(), user.end());
  const CommandResult result = run_command(launch({"--isolate", file}, full), kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("has died")));
}

TEST_P(Namespaces, HoldTheComponentsThatAreLoadedThere) {
  const std::string file = write("components.launch.xml", R"xml(
    <node_container pkg="rclcpp_components" exec="component_container" name="container" namespace="">
      <composable_node pkg="composition" plugin="composition::Talker" name="talker"/>
    </node_container>
    <executable name="seen" cmd="echo seen" output="screen"><depends_on node="/talker"/></executable>)xml");
  RunningCommand run(launch({"--isolate", file}, prefix()));
  EXPECT_TRUE(run.wait_for_output("[seen-2] seen", kPatience)) << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0) << run.out() << run.err();
}

TEST_P(Namespaces, TellOfAProgramThatDoesNotExist) {
  const std::string file = write("missing.launch.xml", "<executable cmd=\"./missing\"/>");
  const CommandResult result = isolated({file});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("cannot find the program './missing'")) << result.out;
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutPrivileges, Namespaces, testing::Bool(),
                         [](const auto& test) { return test.param ? "AsRoot" : "WithoutPrivileges"; });

}  // namespace
