// SPDX-License-Identifier: Apache-2.0
// Nodes of this build and of another one speak with each other, both ways: topics, services, actions. The other one may
// have another release of Fast DDS or of ROS 2.
//
// OTHER_STACK is a command that runs a program of a package of the other build when the names of both follow, such as
// "/opt/other/bin/launch run". It must leave ROS_DOMAIN_ID and /dev/shm as they are. Without it the tests are skipped.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using test_support::Command;
using test_support::RunningCommand;

enum class Build { kThis, kOther };

// Runs a program of demo_nodes.
Command node(Build build, const std::string& program) {
  std::vector<std::string> argv;
  if (build == Build::kThis) {
    argv = {BUILD_DIRECTORY "/prefix/lib/demo_nodes/" + program};
  } else {
    std::istringstream words(std::getenv("OTHER_STACK"));
    for (std::string word; words >> word;) {
      argv.push_back(word);
    }
    argv.insert(argv.end(), {"demo_nodes", program});
  }
  return {.argv = argv};
}

struct Way {
  const char* name;
  Build first;
  Build second;
};

class OtherStack : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    if (std::getenv("OTHER_STACK") == nullptr) {
      GTEST_SKIP() << "skipped, because OTHER_STACK does not say how to run a program of another build";
    }
  }

  // The second program says `text` while the first one runs.
  void expect(const std::string& first, const std::string& second, const std::string& text) {
    RunningCommand server(node(GetParam().first, first));
    RunningCommand client(node(GetParam().second, second));
    EXPECT_TRUE(client.wait_for_output(text)) << first << ":\n"
                                              << server.out() << server.err() << second << ":\n"
                                              << client.out() << client.err();
    client.end_gently();
    server.end_gently();
  }

  test_support::Sandbox sandbox_;
};

INSTANTIATE_TEST_SUITE_P(Ways, OtherStack,
                         testing::Values(Way{"FromThisToOther", Build::kThis, Build::kOther},
                                         Way{"FromOtherToThis", Build::kOther, Build::kThis}),
                         [](const auto& way) { return std::string(way.param.name); });

TEST_P(OtherStack, MessagesArrive) {
  expect("talker", "listener", "I heard");
}

TEST_P(OtherStack, ServicesAnswer) {
  expect("add_two_ints_server", "add_two_ints_client", "2 + 3 = 5");
}

TEST_P(OtherStack, ActionsSucceed) {
  expect("fibonacci_action_server", "fibonacci_action_client", "Goal succeeded: 0 1 1 2 3");
}

}  // namespace
