// SPDX-License-Identifier: Apache-2.0
// A screen that nobody reads, as that of `launch … | less`, stops no supervision and loses no line of the log.
#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

constexpr std::chrono::seconds kPatience{60};
constexpr std::size_t kLines = 100'000;  // with 100 bytes each, more than the screen's pipe and queue take

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) {
    ++found;
  }
  return found;
}

class StalledScreen : public testing::Test {
 protected:
  // A process that prints, then tells that all has been taken; and the other processes.
  std::string write(const std::string& others) const {
    const std::string file = sandbox_.directory() / "system.launch.xml";
    write_file(file, "<launch>\n<executable name=\"flood\" shell=\"true\" output=\"screen\" cmd=\"yes " +
                         std::string(100, 'x') + " | head -n " + std::to_string(kLines) + "; echo &gt; " +
                         make_fifo("taken") + "; read x\"/>\n" + others + "</launch>\n");
    return file;
  }
  std::string make_fifo(const std::string& name) const {
    const std::string path = sandbox_.directory() / name;
    run_command({"mkfifo", path});
    return path;
  }
  // Waits until a process has written to the fifo.
  void wait_for(const std::string& fifo) const {
    const CommandResult result = run_command({.argv = {"cat", sandbox_.directory() / fifo}}, kPatience);
    ASSERT_EQ(result.exit_code, 0) << fifo;
  }
  std::string log() const {
    std::string text;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sandbox_.directory())) {
      if (entry.path().filename() == "launch.log" && !entry.path().parent_path().string().ends_with("latest")) {
        text += read_file(entry.path());
      }
    }
    return text;
  }

  Sandbox sandbox_;
};

TEST_F(StalledScreen, ProcessesAreStartedAgainMeanwhileAndTheLogHasWhatTheScreenLacks) {
  const std::string file =
      write("<executable name=\"again\" shell=\"true\" respawn=\"true\" respawn_delay=\"0.01\" cmd=\"echo &gt; " +
            make_fifo("again") + "\"/>\n");
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, file}});
  wait_for("taken");
  for (int i = 0; i < 3; ++i) {
    wait_for("again");
  }
  EXPECT_TRUE(launch.wait_for_output(" lines dropped on the screen, all are in ", kPatience));
  launch.send_signal(SIGINT);
  const CommandResult result = launch.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.output_closed) << "no process is left";
  const std::size_t shown = count(result.out, "[flood-1] xxx");
  EXPECT_LT(shown, kLines);
  EXPECT_EQ(shown + count(log(), "[flood-1] xxx"), kLines);
}

TEST_F(StalledScreen, ASignalEndsTheLaunchAllTheSame) {
  const std::string file = write("<executable name=\"last\" shell=\"true\" cmd=\"end() { echo &gt; " +
                                 make_fifo("ended") + "; exit; }; trap end INT; while :; do read x; done\"/>\n");
  RunningCommand launch({.argv = {LAUNCH_PROGRAM, file}});
  wait_for("taken");
  launch.send_signal(SIGINT);
  wait_for("ended");
  const CommandResult result = launch.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.output_closed) << "no process is left";
}

TEST_F(StalledScreen, LinesForAScreenThatIsClosedAreInTheLog) {
  const std::string go = make_fifo("go");
  const std::string file = sandbox_.directory() / "system.launch.xml";
  write_file(file, "<launch>\n<executable name=\"late\" shell=\"true\" output=\"screen\" cmd=\"cat " + go +
                       "; echo too late\"/>\n</launch>\n");
  const std::string reader = "{ head -n 1; exec <&-; echo > " + go + "; }";
  run_command({.argv = {"sh", "-c", std::string(LAUNCH_PROGRAM) + " " + file + " | " + reader}}, kPatience);
  EXPECT_THAT(log(), HasSubstr(" [WARNING] [launch]: the screen is gone, its lines follow here\n"));
  EXPECT_THAT(log(), HasSubstr(" [late-1] too late\n"));
}

}  // namespace
