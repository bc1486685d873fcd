// SPDX-License-Identifier: Apache-2.0
// Two systems in one session daemon, of which a launch has started one: its report is about that one.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::UnorderedElementsAre;

class ProcessesOfOthers : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(beside_.wait_for_output("I heard")) << beside_.out() << beside_.err();
    const CommandResult result = run_command({LAUNCH_PROGRAM, file("system.launch.xml", R"xml(
<trace session-name="run" subbuffer-size-ust="1048576"/>
<node pkg="demo_nodes" exec="pong"/>
<executable name="shell" cmd="$(find-pkg-prefix demo_nodes)/lib/demo_nodes/add_two_ints_server; true" shell="true"/>
<node pkg="demo_nodes" exec="ping" on_exit="shutdown">
  <param name="count" value="30"/>
  <param name="period_ms" value="50"/>
  <depends_on node="/add_two_ints_server"/>
</node>)xml")});
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  }

  void TearDown() override { EXPECT_EQ(beside_.end_gently().exit_code, 0); }

  std::string file(const std::string& name, const std::string& content) const {
    const std::filesystem::path path = sandbox_.directory() / name;
    std::ofstream(path) << "<launch>" << content << "\n</launch>\n";
    return path;
  }
  std::string trace() const { return sandbox_.trace_directory() / "run"; }
  static std::vector<std::string> names(const json& list) {
    std::vector<std::string> names;
    for (const json& one : list) {
      names.push_back(one["name"]);
    }
    return names;
  }
  static json report(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {LAUNCH_PROGRAM, "report", "--json"});
    const CommandResult result = run_command({arguments});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }

  Sandbox sandbox_;
  RunningCommand beside_{{.argv = {LAUNCH_PROGRAM, file("beside.launch.xml", R"xml(
<node pkg="demo_nodes" exec="talker"/>
<node pkg="demo_nodes" exec="listener"/>)xml")},
                          .environment = {{"ROS_DOMAIN_ID", "97"}}}};
};

TEST_F(ProcessesOfOthers, AreNotInTheReportOfALaunch) {
  const json own = report({trace()});
  EXPECT_THAT(names(own["nodes"]), UnorderedElementsAre("/ping", "/pong", "/add_two_ints_server"))
      << "a shell of the launch has started one";
  EXPECT_THAT(names(own["others"]), UnorderedElementsAre("talker", "listener"));
  EXPECT_THAT(own["findings"].dump(), Not(HasSubstr("/talker")));

  const CommandResult text = run_command({LAUNCH_PROGRAM, "report", trace()});
  EXPECT_THAT(text.out, HasSubstr(" of 3 processes\nLeft out   2 processes of others: --all\n"));
  EXPECT_THAT(text.out, Not(HasSubstr("/chatter")));
}

TEST_F(ProcessesOfOthers, AreInItWithAll) {
  const json all = report({trace(), "--all"});
  EXPECT_THAT(names(all["nodes"]), IsSupersetOf({"/ping", "/pong", "/talker", "/listener"}));
  EXPECT_EQ(all["others"], json::array());
  EXPECT_THAT(names(all["topics"]), Contains("/chatter"));
}

}  // namespace
