// SPDX-License-Identifier: Apache-2.0
// for and for_each, and the smaller entities: log_*, bool_arg, unset, append_env, reset_env, rep_env.
#include <gmock/gmock.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using test_support::plan_actions;
using test_support::plan_text;
using test_support::Planned;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ForEach, VisitsItsActionsOncePerSetOfValues) {
  const Planned planned = plan_actions(R"xml(
    <arg name="robots" default="{name: 'a', id: 1};{name: b, on: true, l: [1, x]};{}"/>
    <for_each values="$(var robots)"><log message="$(for-var name none) $(for-var id -) $(for-var l -)"/></for_each>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("a 1 -", "b - [1, 'x']", "none - -"));
}

TEST(ForEach, IsNoScopeButItsVariablesEnd) {
  const Planned planned = plan_actions(R"xml(
    <for_each values="{v: 1};{v: 2}"><let name="last" value="$(for-var v)"/></for_each>
    <log message="$(var last) $(for-var v gone)"/>)xml");
  EXPECT_THAT(planned.plan.logs, ElementsAre("2 gone"));
}

TEST(ForEach, NoValuesAreNoTurnWithAWarning) {
  const Planned planned = plan_actions(R"xml(<for_each values=""><log message="never"/></for_each>)xml");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, IsEmpty());
  EXPECT_THAT(planned.messages, ElementsAre(HasSubstr("the loop has no turns: there are no values")));
}

TEST(ForEach, ValuesMustBeMappings) {
  EXPECT_EQ(plan_actions(R"xml(<for_each values="a;b"/>)xml").error,
            "/test/system.launch.xml:2:19: error: the values of a turn are a mapping, got 'a'\n"
            "    2 | <for_each values=\"a;b\"/>\n"
            "      |                   ^~~\n"
            "      = help: write {name: a, id: 1};{name: b, id: 2}");
}

TEST(For, CountsFromZeroAndNests) {
  const Planned planned = plan_text(R"yaml(launch:
- for:
    len: "2"
    name: i
    children:
    - for: {len: "2", name: j, children: [log_info: {message: $(index i)$(index j)}]}
)yaml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.logs, ElementsAre("00", "01", "10", "11"));
}

TEST(For, LengthMustBeAWholeNumber) {
  EXPECT_THAT(plan_actions(R"xml(<for len="two" name="i"/>)xml").error,
              HasSubstr("the length of a loop is a whole number, got 'two'"));
}

TEST(Logs, HaveATagForEachLevel) {
  const Planned planned = plan_actions(R"xml(
    <log_debug message="d"/><log_info message="i"/><log_warning message="w"/><log_error message="e"/>)xml");
  EXPECT_THAT(planned.plan.logs, ElementsAre("d", "i", "w", "e"));
  EXPECT_THAT(plan_actions(R"xml(<log_info message="i" level="error"/>)xml").error,
              HasSubstr("unexpected attribute 'level' in 'log_info'"));
}

TEST(BoolArg, TakesBooleansOnly) {
  const std::string text = R"xml(<bool_arg name="b" default="true"/>)xml";
  EXPECT_EQ(plan_actions(text, {.arguments = {{"b", "FALSE"}}}).error, "");
  EXPECT_THAT(
      plan_actions(text, {.arguments = {{"b", "maybe"}}}).error,
      HasSubstr("argument \"b\" provided value \"maybe\" is not valid. Valid options are: ['true', 'false', 'True', "
                "'False', 'TRUE', 'FALSE']"));
}

TEST(Unset, RemovesAConfiguration) {
  const Planned planned = plan_actions(R"xml(
    <let name="v" value="1"/><unset name="v"/><unset name="never"/><log message="$(var v gone)"/>)xml");
  EXPECT_THAT(planned.plan.logs, ElementsAre("gone"));
}

TEST(Environment, AppendsPrependsAndResets) {
  const Planned planned = plan_actions(R"xml(
    <append_env name="A" value="1"/><append_env name="A" value="2"/><append_env name="A" value="0" prepend="true" separator=";"/>
    <log message="$(env A)"/>
    <reset_env/>
    <log message="$(env A gone) $(env HOME)"/>
    <rep_env><env name="ONLY" value="this"/></rep_env>
    <log message="$(env ONLY) $(env HOME gone)"/>)xml");
  EXPECT_THAT(planned.plan.logs, ElementsAre("0;1:2", "gone /home/user", "this gone"));
  EXPECT_THAT(plan_actions(R"xml(<append_env name="A" value="1" prepend="perhaps"/>)xml").error,
              HasSubstr("expected a boolean, got 'perhaps'"));
}

}  // namespace
