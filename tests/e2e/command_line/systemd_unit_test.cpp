// SPDX-License-Identifier: Apache-2.0
// launch unit: a launch that a real systemd runs, which boots in namespaces of its own.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/e2e/command_line/booted_systemd.hpp"

namespace {

using namespace test_support;
using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class Unit : public BootedSystemd {
 protected:
  CommandResult unit(std::vector<std::string> words) const {
    words.insert(words.begin(), {LAUNCH_PROGRAM, "unit"});
    return inside(std::move(words));
  }

  std::string property(const std::string& name) const { return BootedSystemd::property("launch-robot.service", name); }

  bool becomes(const std::string& name, const std::string& value) const {
    return BootedSystemd::becomes("launch-robot.service", name, value);
  }

  // The journal's entries of the launch, by their messages.
  std::map<std::string, json> entries() const {
    inside({"journalctl", "--sync"});
    std::istringstream lines(inside({"journalctl", "--unit=launch-robot", "--output=json"}).out);
    std::map<std::string, json> found;
    for (std::string line; std::getline(lines, line);) {
      json entry = json::parse(line);
      found[entry.value("MESSAGE", "")] = entry;
    }
    return found;
  }
};

TEST_F(Unit, PrintsAUnitOfTheFile) {
  Command command{.argv = {LAUNCH_PROGRAM, "unit", "install", "--print", "--as", "daemon", "--realtime",
                           write(R"xml(<arg name="word"/><executable cmd="sleep 1" sigterm_timeout="50"/>)xml"),
                           "word:=a b$c%d\"e"}};
  command.environment = {{"ROS_DOMAIN_ID", "7"}, {"AMENT_PREFIX_PATH", "/opt/100%"}, {"SECRET", "x"}};
  command.directory = sandbox_.directory();
  const std::string text = run_command(command).out;
  EXPECT_THAT(text, HasSubstr("# Made by 'launch unit install'. 'launch unit remove' takes it away.\n[Unit]\n"
                              "Description=launch robot.launch.xml\n"));
  EXPECT_THAT(text, HasSubstr("ExecStart=\"" + std::string(LAUNCH_PROGRAM) + "\" \"" +
                              (sandbox_.directory() / "robot.launch.xml").string() + "\" \"word:=a b$$c%%d\\\"e\"\n"));
  EXPECT_THAT(text, HasSubstr("\nUser=daemon\n"));
  EXPECT_THAT(text, HasSubstr("\nEnvironment=\"ROS_DOMAIN_ID=7\"\n"));
  EXPECT_THAT(text, HasSubstr("\nEnvironment=\"AMENT_PREFIX_PATH=/opt/100%%\"\n"));
  EXPECT_THAT(text, Not(HasSubstr("SECRET")));
  EXPECT_THAT(text, HasSubstr("\nTimeoutStopSec=85\n"));  // 50 and 5 of the process, 30 for traces
  EXPECT_THAT(text, HasSubstr("\nLimitRTPRIO=99\n"));
}

TEST_F(Unit, AHardenedUnitGivesRightsUp) {
  const std::vector<std::string> words = {LAUNCH_PROGRAM, "unit", "install", "--print",
                                          write(R"xml(<executable cmd="true"/>)xml")};
  std::vector<std::string> hardened = words;
  hardened.push_back("--hardened");
  EXPECT_THAT(run_command(Command{.argv = hardened}).out,
              HasSubstr("\nNoNewPrivileges=yes\nProtectSystem=full\nProtectHostname=yes\nRestrictSUIDSGID=yes\n"
                        "LockPersonality=yes\nSystemCallArchitectures=native\n"));
  EXPECT_THAT(run_command(Command{.argv = words}).out, Not(HasSubstr("NoNewPrivileges")));
}

TEST_F(Unit, AFileWithAnErrorMakesNoUnit) {
  const std::string file = write("<executable/>");
  const CommandResult result = run_command({LAUNCH_PROGRAM, "unit", "install", file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(file + ":2:2: error: "));
  const std::string good = write(R"xml(<executable cmd="true"/>)xml");
  const auto error_of = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all = {LAUNCH_PROGRAM, "unit"};
    all.insert(all.end(), words.begin(), words.end());
    const CommandResult refused = run_command(Command{.argv = std::move(all)});
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_EQ(refused.out, "");
    return refused.err;
  };
  EXPECT_EQ(error_of({"install", "--print", "--env", "NOT_THERE", good}),
            "launch unit: error: there is no variable 'NOT_THERE' to take along\n");
  EXPECT_THAT(error_of({"install", "--print", "--option=--tarce", good}),
              HasSubstr("launch: error: unknown option '--tarce'\n      = help: did you mean '--trace'?\n"));
  EXPECT_EQ(error_of({"status"}),
            "launch unit status: error: the name of a unit is missing\n"
            "      = help: see 'launch unit status --help'\n");
  if (::geteuid() == 0) {
    EXPECT_EQ(error_of({"install", "--print", "--as", "no-such-user", good}),
              "launch unit: error: there is no user 'no-such-user'\n");
  }
  const CommandResult unknown = run_command({LAUNCH_PROGRAM, "unit", "instal", file});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err,
              HasSubstr("\n      = help: did you mean 'install'?\n      = help: see 'launch unit --help'\n"));
}

TEST_F(Unit, SystemdRunsItAndTheJournalKnowsWhereLinesComeFrom) {
  if (const std::string why = boot(); !why.empty()) {
    GTEST_SKIP() << why;
  }
  const std::string file = write(
      R"xml(<executable name="first" shell="true" output="screen"
                cmd="echo [WARN] careful; echo home $HOME; env | grep -c NOTIFY_SOCKET; touch here; cat &lt; begin; echo up; sleep 1000"/>
<executable name="second" cmd="sleep 1000"><depends_on process="first" condition="output" pattern="up"/></executable>)xml");
  ASSERT_EQ(inside({"mkfifo", (sandbox_.directory() / "begin").string()}).exit_code, 0);
  const CommandResult installed = unit({"install", file});
  EXPECT_EQ(installed.exit_code, 0) << installed.out << installed.err;
  EXPECT_THAT(installed.out, HasSubstr("/etc/systemd/system/launch-robot.service is written\n"));

  // It is not active before all has started.
  EXPECT_TRUE(becomes("StatusText", "starting 1 of 2, waiting: second")) << property("StatusText");
  EXPECT_EQ(property("ActiveState"), "activating");
  EXPECT_EQ(inside({"sh", "-c", "echo > begin"}).exit_code, 0);
  EXPECT_TRUE(becomes("ActiveState", "active"));
  EXPECT_TRUE(becomes("StatusText", "2 processes run")) << property("StatusText");
  const CommandResult status = unit({"status", "launch-robot"});
  EXPECT_EQ(status.exit_code, 0);
  EXPECT_THAT(status.out, ContainsRegex("^launch-robot: active \\(running\\), 2 processes run, launch [0-9]+\n$"));

  std::map<std::string, json> lines = entries();
  const json& careful = lines["[first-1] [WARN] careful"];
  EXPECT_EQ(careful.value("PRIORITY", ""), "4") << careful;
  EXPECT_EQ(careful.value("LAUNCH_PROCESS", ""), "first-1");
  EXPECT_EQ(careful.value("CODE_FILE", ""), file);
  EXPECT_EQ(careful.value("CODE_LINE", ""), "2");
  EXPECT_EQ(lines.count("[first-1] home /root"), 1u) << "nodes need a home";
  EXPECT_EQ(lines.count("[first-1] 0"), 1u) << "processes must not get the socket of the launch";

  EXPECT_EQ(inside({"systemctl", "stop", "launch-robot"}).exit_code, 0);
  EXPECT_EQ(property("Result"), "success");
  const CommandResult stopped = unit({"status", "launch-robot"});
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_EQ(stopped.out, "launch-robot: inactive (dead)\n");
  EXPECT_EQ(unit({"remove", "launch-robot"}).exit_code, 0);
  const CommandResult gone = unit({"status", "launch-robot"});
  EXPECT_EQ(gone.exit_code, 4);
  EXPECT_EQ(gone.err, "launch unit status: error: there is no unit 'launch-robot'\n");
}

TEST_F(Unit, ReloadReadsTheFileAgain) {
  if (const std::string why = boot(); !why.empty()) {
    GTEST_SKIP() << why;
  }
  const std::string first = R"xml(<executable name="a" cmd="sleep 1000"/>)xml";
  ASSERT_EQ(unit({"install", "--hardened", write(first)}).exit_code, 0);
  ASSERT_TRUE(becomes("StatusText", "1 process runs")) << property("StatusText");
  const std::string pid = inside({"pgrep", "-f", "^sleep 1000"}).out;

  write("<executable/>");
  EXPECT_NE(inside({"systemctl", "reload", "launch-robot"}).exit_code, 0);
  EXPECT_EQ(property("ActiveState"), "active");

  write(first + R"xml(<executable name="b" cmd="sleep 2000"/>)xml");
  const CommandResult reloaded = inside({"systemctl", "reload", "launch-robot"});
  EXPECT_EQ(reloaded.exit_code, 0) << reloaded.err << inside({"journalctl", "--unit=launch-robot"}).out;
  EXPECT_TRUE(becomes("StatusText", "2 processes run")) << property("StatusText");
  EXPECT_EQ(inside({"pgrep", "-f", "^sleep 1000"}).out, pid);
}

TEST_F(Unit, PowerOffEndsTheProcessesGently) {
  if (const std::string why = boot(); !why.empty()) {
    GTEST_SKIP() << why;
  }
  write_file(sandbox_.directory() / "node.sh",
             "trap 'echo gentle > end; exit' INT\necho > begun\nwhile :; do sleep 0.01; done\n");
  const std::string file = write(R"xml(<executable name="a" cmd="sh node.sh"/>)xml");
  ASSERT_EQ(unit({"install", file}).exit_code, 0);
  ASSERT_TRUE(becomes("ActiveState", "active"));
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!fs::exists(sandbox_.directory() / "begun")) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
  }
  // It may end with the others before it has been answered.
  inside({"systemctl", "poweroff"});
  boot_->wait(kPatience);
  systemd_ = 0;
  EXPECT_EQ(read_file(sandbox_.directory() / "end"), "gentle\n");
}

TEST_F(Unit, AUserHasUnitsOfTheirOwn) {
  if (const std::string why = boot(); !why.empty()) {
    GTEST_SKIP() << why;
  }
  const fs::path home = sandbox_.directory() / "daemon";
  const fs::path units = home / ".config/systemd/user";
  fs::create_directories(units);
  fs::create_directories(home / "runtime");
  for (const char* const name : {"default", "basic", "shutdown"}) {
    write_file(units / (std::string(name) + ".target"), "[Unit]\nDefaultDependencies=no\n");
  }
  write_file(home / "robot.launch.xml", "<launch>\n<executable name=\"a\" cmd=\"sleep 1000\"/>\n</launch>\n");
  fs::permissions(sandbox_.directory(), fs::perms::all);
  ASSERT_EQ(run_command({"chown", "-R", "daemon:", home.string()}).exit_code, 0);
  fs::permissions(home / "runtime", fs::perms::owner_all);
  const std::string variables = "HOME=" + home.string() + " XDG_RUNTIME_DIR=" + (home / "runtime").string() +
                                " SYSTEMD_UNIT_PATH=" + units.string();
  const auto as_daemon = [&](const std::string& command) {
    return inside({"setpriv", "--reuid=daemon", "--regid=daemon", "--clear-groups", "sh", "-c",
                   "cd " + home.string() + "; exec env -i PATH=\"$PATH\" " + variables + " " + command});
  };
  const std::string launch = LAUNCH_PROGRAM;
  if (as_daemon("test -x " + launch).exit_code != 0) {
    GTEST_SKIP() << "skipped, because other users can't reach the build";
  }

  // Without a service manager of the user the unit is written for later.
  const CommandResult early = as_daemon(launch + " unit install robot.launch.xml");
  EXPECT_EQ(early.exit_code, 0) << early.err;
  EXPECT_EQ(early.out,
            (units / "launch-robot.service").string() +
                " is written\n"
                "it starts when this user logs in; 'loginctl enable-linger' makes it start with the machine\n"
                "the service manager of this user does not run, so nothing starts now\n");

  EXPECT_TRUE(fs::exists(units / "default.target.wants/launch-robot.service"));
  EXPECT_EQ(as_daemon(launch + " unit remove launch-robot").exit_code, 0);
  EXPECT_FALSE(fs::exists(fs::symlink_status(units / "default.target.wants/launch-robot.service")));
  EXPECT_FALSE(fs::exists(units / "launch-robot.service"));

  // As user@.service, without PAM.
  write_file(sandbox_.directory() / "manager.service",
             "[Service]\nType=notify\nUser=daemon\nDelegate=yes\nEnvironment=" + variables +
                 "\nExecStart=/lib/systemd/systemd --user\n");
  ASSERT_EQ(inside({"cp", (sandbox_.directory() / "manager.service").string(), "/etc/systemd/system"}).exit_code, 0);
  const CommandResult logged_in = inside({"systemctl", "start", "manager"});
  ASSERT_EQ(logged_in.exit_code, 0) << logged_in.err << inside({"journalctl", "--unit=manager"}).out;
  EXPECT_EQ(as_daemon("systemctl --user is-active --quiet default.target").exit_code, 0);
  const CommandResult installed = as_daemon(launch + " unit install robot.launch.xml");
  EXPECT_EQ(installed.exit_code, 0) << installed.err;
  EXPECT_THAT(installed.out, HasSubstr("launch-robot starts; see 'launch unit status launch-robot' and 'journalctl "
                                       "--user -u launch-robot'\n"));
  CommandResult status;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {
    status = as_daemon(launch + " unit status launch-robot");
  } while (status.out.find("1 process runs") == std::string::npos && std::chrono::steady_clock::now() < end);
  EXPECT_THAT(status.out, ContainsRegex("^launch-robot: active \\(running\\), 1 process runs, launch [0-9]+\n$"))
      << status.err << inside({"journalctl", "--no-pager", "-n", "50"}).out;
  EXPECT_EQ(inside({"pgrep", "-u", "daemon", "-c", "-f", "^sleep 1000"}).out, "1\n");
  const CommandResult removed = as_daemon(launch + " unit remove launch-robot");
  EXPECT_EQ(removed.exit_code, 0) << removed.err;
  EXPECT_EQ(inside({"pgrep", "-u", "daemon", "-c", "-f", "^sleep 1000"}).out, "0\n");
}

// The launcher is stopped, so it does not feed the watchdog. systemd ends it and starts it anew.
TEST_F(Unit, ALaunchThatHangsIsStartedAnew) {
  if (const std::string why = boot(); !why.empty()) {
    GTEST_SKIP() << why;
  }
  const std::string file = write(R"xml(<executable name="a" cmd="sleep 1000"/>)xml");
  ASSERT_EQ(unit({"install", "--no-start", file}).exit_code, 0);
  inside({"sed", "-i", "s/^WatchdogSec=.*/WatchdogSec=1/; s/^RestartSec=.*/RestartSec=0/",
          "/etc/systemd/system/launch-robot.service"});
  inside({"systemctl", "daemon-reload"});
  ASSERT_EQ(inside({"systemctl", "start", "launch-robot"}).exit_code, 0);
  const std::string first = property("MainPID");
  // The main process is the guardian; below it are its spare and the launcher.
  inside({"sh", "-c", "kill -STOP $(pgrep -P $(pgrep -P " + first + "))"});
  EXPECT_TRUE(becomes("NRestarts", "1"));
  EXPECT_TRUE(becomes("ActiveState", "active"));
  EXPECT_NE(property("MainPID"), first);
  const CommandResult left = inside({"sh", "-c", "pgrep -c -f 'sleep 1000$'"});
  EXPECT_EQ(left.out, "1\n");
}

}  // namespace
