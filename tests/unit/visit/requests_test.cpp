// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/requests.hpp"

#include <gmock/gmock.h>

#include "base/diagnostics/diagnostic.hpp"
#include "base/overloaded.hpp"

namespace launch {
namespace {

using testing::ElementsAre;

TEST(Requests, AreShownKindByKindInTheOrderOfARun) {
  Requests requests;
  requests.shutdowns.push_back({"done"});
  requests.processes.resize(2);
  requests.loads.resize(1);
  requests.commands.push_back({.process = "talker"});
  std::vector<std::string> seen;
  for_each_request(
      requests, Overloaded{
                    [&](const ProcessCommand& command) { seen.push_back("command to " + command.process); },
                    [&](const LoadRequest&) { seen.emplace_back("load"); },
                    [&](const ProcessSpec&) { seen.emplace_back("process"); },
                    [&](const ShutdownRequest& shutdown) { seen.push_back(shutdown.reason); },
                    PassOver<RunScopePtr, UnregisterRequest, TestRequest, EventHandler, TimerRequest, TransitionRequest,
                             CoroutineRequest, NodeDescription, Dependency>(),
                });
  EXPECT_THAT(seen, ElementsAre("command to talker", "load", "process", "process", "done"));
}

TEST(Requests, AreEmptyWithoutSomethingToDo) {
  Requests requests;
  requests.logs.emplace_back("told already");
  requests.includes = 1;
  EXPECT_TRUE(requests.empty());
  requests.timers.resize(1);
  requests.unregistered.resize(1);
  EXPECT_EQ(requests.count(), 2U);
}

TEST(Requests, SomeAreTooLateInAFarewell) {
  Requests requests;
  requests.processes.resize(1);
  requests.transitions.resize(1);
  EXPECT_NO_THROW(check_farewell(requests, true));
  EXPECT_THROW(check_farewell(requests, false), LaunchError);
}

}  // namespace
}  // namespace launch
