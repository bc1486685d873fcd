// SPDX-License-Identifier: Apache-2.0
// Interfaces as they are installed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "launcher/message_types/print_value.hpp"
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
  const auto event = library_.message("test_interfaces/srv/AddTwoInts_Event");
  EXPECT_THAT(event->field_names(), ElementsAre("info", "request", "response"));
  EXPECT_EQ(to_string(event->find("response")->type), "test_interfaces/srv/AddTwoInts_Response[<=1]");
  EXPECT_EQ(library_.message("example_interfaces/action/Fibonacci_SendGoal_Event")->find("request")->type.message->name,
            "example_interfaces/action/Fibonacci_SendGoal_Request");
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

constexpr const char* kScan = R"IDL(// comments and includes have no effect
#include "std_msgs/msg/Header.idl"
/* over
   lines */
module lidar {
  module msg {
    typedef double double__3[3];
    module Scan_Constants {
      const uint64 BEAMS = 0x10;
      const string FRAME = "las" "er";
      const float LEAST = -.5;
    };
    @verbatim (language="comment", text="a (bracket)" "and on")
    struct Scan {
      std_msgs::msg::Header header;
      char name[BEAMS];
      unsigned long long serial, more[2];
      @default (value=TRUE)
      boolean is_complete;
      @default (value="(1, 2)") @unit (value="m")
      sequence<octet, 4> flags;
      @default (value="x\"y") string<8> text;
      double__3 origin;
      sequence<lidar::msg::Beam> beams;
    };
  };
};
)IDL";

TEST_F(Interfaces, AreReadFromIdlFilesIfThereAreNoOthers) {
  prefix_.add_file("lidar", "msg/Scan.idl", kScan);
  prefix_.add_file("lidar", "msg/Beam.msg", "float32 range");
  prefix_.add_file("lidar", "msg/Beam.idl", "no IDL");
  prefix_.add_file("lidar", "srv/Reset.idl",
                   "module lidar { module srv { struct Reset_Request { uint8 structure_needs_at_least_one_member; };\n"
                   "struct Reset_Response { @default (value=-3) long code; }; }; };");
  const auto type = library_.message("lidar/msg/Scan");
  EXPECT_EQ(to_string(type->fields[1].type), "char[16]");
  EXPECT_EQ(to_string(type->fields[3].type), "uint64[2]");
  EXPECT_EQ(to_string(type->fields[5].type), "byte[<=4]");
  EXPECT_EQ(to_string(type->fields[6].type), "string<=8");
  EXPECT_EQ(to_string(type->fields[7].type), "float64[3]");
  EXPECT_EQ(to_string(type->fields[8].type), "lidar/Beam[]");
  EXPECT_THAT(to_yaml({launch::FieldKind::kMessage, type}, default_value(*type)),
              HasSubstr("is_complete: true\nflags:\n- \"\\x01\"\n- \"\\x02\"\ntext: x\"y\n"));
  ASSERT_EQ(type->constants.size(), 3u);
  EXPECT_EQ(type->constants[0].value, (launch::MessageValue{std::uint64_t{16}}));
  EXPECT_EQ(type->constants[1].value, (launch::MessageValue{std::string("laser")}));
  EXPECT_EQ(type->constants[2].value, (launch::MessageValue{-0.5}));
  EXPECT_TRUE(library_.service("lidar/srv/Reset").request->fields.empty());
  EXPECT_EQ(library_.service("lidar/srv/Reset").response->fields[0].default_value,
            (launch::MessageValue{std::int64_t{-3}}));
  EXPECT_THAT(library_.names_of_package("lidar", "msg"), ElementsAre("lidar/msg/Beam", "lidar/msg/Scan"));
}

TEST_F(Interfaces, ErrorsInIdlFilesHaveTheirPlace) {
  const auto error_of = [&](const std::string& text) {
    prefix_.add_file("lidar", "msg/Bad.idl", "module lidar { module msg {\n" + text);
    const std::string errors = errors_of([&] { library_.message("lidar/msg/Bad"); });
    return errors.substr(std::min(errors.find("Bad.idl"), errors.size()));
  };
  EXPECT_EQ(error_of("struct Bad { lidar::msg::Bean b; }; }; };"),
            "Bad.idl:2:14: error: there is no interface 'lidar/msg/Bean'\n"
            "    2 | struct Bad { lidar::msg::Bean b; }; }; };\n"
            "      |              ^~~~~\n"
            "      = help: did you mean 'lidar/msg/Bad'?\n");
  EXPECT_EQ(error_of("struct Bad { long a }; }; };"),
            "Bad.idl:2:21: error: expected ';' and not '}'\n"
            "    2 | struct Bad { long a }; }; };\n"
            "      |                     ^\n");
  EXPECT_EQ(error_of("struct Bad { long a[N]; }; }; };"),
            "Bad.idl:2:21: error: unknown constant 'N'\n"
            "    2 | struct Bad { long a[N]; }; }; };\n"
            "      |                     ^\n");
  EXPECT_EQ(error_of("struct Bad { @default (value=300) octet a; }; }; };"),
            "Bad.idl:2:30: error: 300 does not fit byte, which goes from 0 to 255\n"
            "    2 | struct Bad { @default (value=300) octet a; }; }; };\n"
            "      |                              ^~~\n");
  EXPECT_EQ(error_of("struct Other { long a; }; }; };"),
            "Bad.idl:1:1: error: the file does not define 'struct Bad'\n"
            "    1 | module lidar { module msg {\n"
            "      | ^~~~~~\n");
  EXPECT_EQ(error_of("struct Bad { string a; /* "),
            "Bad.idl:2:24: error: the comment has no end\n"
            "    2 | struct Bad { string a; /* \n"
            "      |                        ^~\n");
}

}  // namespace
