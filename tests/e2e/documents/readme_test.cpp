// SPDX-License-Identifier: Apache-2.0
// What README.md shows works as it stands there.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

// The text between the first line that is `begin` and the next line that is "```".
std::string block_of_readme(const std::string& begin) {
  const std::string readme = read_file(README);
  const std::size_t at = readme.find("\n" + begin + "\n");
  const std::size_t end = readme.find("\n```\n", at + 1);
  EXPECT_NE(at, std::string::npos);
  return at == std::string::npos ? "" : readme.substr(at + 1, end - at);
}

class Readme : public testing::Test {
 protected:
  // A launch file in the current directory of the command.
  CommandResult launch(const std::string& text) const {
    write_file(sandbox_.directory() / "system.launch.xml", text);
    Command command{{LAUNCH_PROGRAM, "system.launch.xml"}};
    command.directory = sandbox_.directory();
    return run_command(command);
  }

  Sandbox sandbox_;
};

TEST_F(Readme, ItsLaunchFileRuns) {
  const std::string block = block_of_readme("```xml");
  const CommandResult result = launch(block.substr(block.find('\n') + 1));
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("[left.ping]: ping 10 answered after "));
  EXPECT_THAT(result.out, HasSubstr("trace is complete: no events lost"));
}

TEST_F(Readme, ItsNodeHearsATalker) {
  const CommandResult result = launch(
      "<launch>\n"
      "  <node pkg=\"demo_nodes\" exec=\"talker\"/>\n"
      "  <executable name=\"listener\" output=\"screen\" cmd=\"" README_LISTENER
      "\"/>\n"
      "  <on_process_io process=\"listener\" pattern=\"Hello\"><shutdown/></on_process_io>\n"
      "</launch>\n");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("[listener]: Hello World: "));
}

TEST_F(Readme, ItsErrorIsWhatALaunchSays) {
  const std::string block = block_of_readme("system.launch.xml:3:20: error: unexpected attribute 'exce' in 'node'");
  const CommandResult result = launch("<launch>\n\n  <node pkg=\"demo\" exce=\"talker\"/>\n</launch>\n");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr(block));
}

}  // namespace
