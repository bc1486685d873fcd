// SPDX-License-Identifier: Apache-2.0
// Interfaces as they are installed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "launcher/messages/print_value.hpp"
#include "test_library.hpp"

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class Interfaces : public testing::Test {
 protected:
  TestLibrary prefix_;
  launch::InterfaceLibrary library_ = prefix_.make();
};

TEST_F(Interfaces, HaveFieldsConstantsAndDefaults) {
  const auto type = library_.message("test_interfaces/Defaults");
  EXPECT_EQ(type->name, "test_interfaces/msg/Defaults");
  EXPECT_THAT(type->field_names(),
              ElementsAre("number", "ratio", "on", "name", "single", "wide", "three", "several", "words", "plain"));
  EXPECT_EQ(to_yaml({launch::FieldKind::kMessage, type}, default_value(*type)),
            "number: -7\nratio: 2.0\n'on': true\n"
            "name: \"a\\tb\"\nsingle: it is\nwide: grüß\nthree:\n- 1\n- 2\n- 3\nseveral:\n- 0.5\n- -1.0\nwords:\n"
            "- one, two\n- three\nplain: 0\n");
  const auto constants = library_.message("test_interfaces/msg/Tagged");
  EXPECT_EQ(to_string(library_.message("test_interfaces/msg/Bounded")->fields[2].type), "test_interfaces/Tagged[<=2]");
}

TEST_F(Interfaces, OfServicesAndActionsHaveTheirParts) {
  const launch::ServiceType service = library_.service("test_interfaces/AddTwoInts");
  EXPECT_EQ(service.name, "test_interfaces/srv/AddTwoInts");
  EXPECT_THAT(service.request->field_names(), ElementsAre("a", "b"));
  EXPECT_THAT(service.response->field_names(), ElementsAre("sum"));
  const launch::ServiceType goal = library_.action_service("example_interfaces/action/Fibonacci", "SendGoal");
  EXPECT_THAT(goal.request->field_names(), ElementsAre("goal_id", "goal"));
  EXPECT_EQ(goal.request->name, "example_interfaces/action/Fibonacci_SendGoal_Request");
  EXPECT_THAT(library_.message("example_interfaces/action/Fibonacci_FeedbackMessage")->field_names(),
              ElementsAre("goal_id", "feedback"));
}

TEST_F(Interfaces, AreListed) {
  EXPECT_THAT(library_.names_of_package("std_srvs", "srv"),
              ElementsAre("std_srvs/srv/Empty", "std_srvs/srv/SetBool", "std_srvs/srv/Trigger"));
  EXPECT_THAT(library_.names("action"), Contains("example_interfaces/action/Fibonacci"));
}

TEST_F(Interfaces, ThatAreNotThereAreSuggested) {
  EXPECT_EQ(errors_of([&] { library_.message("std_msgs/msg/Strin"); }),
            "error: there is no interface 'std_msgs/msg/Strin'\n"
            "      = help: did you mean 'std_msgs/msg/String'?\n");
  EXPECT_THAT(errors_of([&] { library_.message("std_msg/msg/String"); }), HasSubstr("did you mean 'std_msgs'?"));
  EXPECT_THAT(errors_of([&] { library_.message("String"); }), HasSubstr("write PACKAGE/msg/NAME"));
  EXPECT_THAT(errors_of([&] { library_.service("std_msgs/msg/String"); }), HasSubstr("is a message, not a service"));
}

TEST_F(Interfaces, WithAMistakeShowItsPlace) {
  prefix_.add_file("mine", "msg/A.msg", "std_msgs/Headr header\n");
  EXPECT_EQ(errors_of([&] { library_.message("mine/msg/A"); }),
            prefix_.prefix().string() +
                "/share/mine/msg/A.msg:1:1: error: there is no interface 'std_msgs/msg/Headr'\n"
                "    1 | std_msgs/Headr header\n"
                "      | ^~~~~~~~~~~~~~\n"
                "      = help: did you mean 'std_msgs/msg/Header'?\n");
  prefix_.add_file("mine", "msg/B.msg", "B inner\n");
  EXPECT_THAT(errors_of([&] { library_.message("mine/msg/B"); }), HasSubstr("'mine/msg/B' contains itself"));
}

}  // namespace
