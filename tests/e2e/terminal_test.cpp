// SPDX-License-Identifier: Apache-2.0
// launch on a terminal: its status line while it starts and stops.
#include "tests/support/terminal.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class OnATerminal : public testing::Test {
 protected:
  std::vector<std::string> launch(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return {LAUNCH_PROGRAM, path.string()};
  }

  Sandbox sandbox_;
  std::map<std::string, std::string> environment_ = {{"TERM", "xterm"}, {"NO_COLOR", "1"}};
};

TEST_F(OnATerminal, AStatusLineTellsOfASlowStartAndASlowEnd) {
  const std::string fifo = (sandbox_.directory() / "fifo").string();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  Terminal terminal(launch("<executable name=\"gate\" shell=\"true\" output=\"screen\" sigterm_timeout=\"2\"\n"
                           "  cmd=\"trap : INT; cat " +
                           fifo +
                           "; while :; do read x; done\"/>\n"
                           "<executable name=\"late\" cmd=\"echo here\" output=\"screen\">"
                           "<depends_on process=\"gate\" condition=\"output\" pattern=\"open\"/></executable>"),
                    environment_);
  ASSERT_TRUE(terminal.shows("starting 1 of 2, waiting: late")) << terminal.screen();
  std::ofstream gate(fifo);
  gate << "not yet" << std::endl;
  ASSERT_TRUE(terminal.shows("[gate-1] not yet")) << terminal.screen();
  ASSERT_TRUE(terminal.shows("starting 1 of 2, waiting: late")) << terminal.screen();
  EXPECT_THAT(terminal.screen(), HasSubstr("[gate-1] not yet\nstarting 1 of 2, waiting: late\n"));
  gate << "open" << std::endl;
  ASSERT_TRUE(terminal.shows("[late-2] here")) << terminal.screen();
  ASSERT_TRUE(terminal.hides("starting ")) << terminal.screen();
  ASSERT_TRUE(terminal.shows("[INFO] [late-2]: process has finished cleanly")) << terminal.screen();
  gate.close();
  terminal.type("\003");
  ASSERT_TRUE(terminal.shows("stopping: 1 of 1 still run, SIGTERM in ", ": gate-1")) << terminal.screen();
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
  EXPECT_THAT(terminal.screen(), Not(HasSubstr("stopping:")));
  EXPECT_THAT(terminal.screen(), HasSubstr("\n[INFO] [late-2]: process has finished cleanly"));
}

TEST_F(OnATerminal, AQuickLaunchHasNoStatusLine) {
  Terminal terminal(launch("<executable name=\"quick\" cmd=\"echo here\" output=\"screen\"/>"), environment_);
  EXPECT_EQ(terminal.wait(), 0);
  EXPECT_THAT(terminal.screen(), HasSubstr("[quick-1] here\n"));
  EXPECT_THAT(terminal.everything(), Not(HasSubstr("\033")));
}

}  // namespace
