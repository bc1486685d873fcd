// SPDX-License-Identifier: Apache-2.0
// Faults of messages as the launcher sees them: which processes learn of which faults, when messages count, and what is
// told of them. The test stands for the nodes.
#include <fcntl.h>
#include <fmt/ranges.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "rmw_message_faults/fault_table.hpp"
#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

namespace table = rmw_message_faults;

// What a node knows.
class NodeSide {
 public:
  explicit NodeSide(const std::string& variable)
      : numbers(variable.substr(0, variable.find(':'))), path_(variable.substr(variable.find(':') + 1)) {
    const int file = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
    struct stat status {};
    if (::fstat(file, &status) != 0) {
      throw std::runtime_error(path_);
    }
    table_ = static_cast<table::Table*>(
        ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    ::close(file);
  }

  table::Fault& fault(std::size_t number) const { return table_->faults()[number - 1]; }

  // A message of the topic is hit.
  void hit(std::size_t number, Duration now) const {
    table::Fault& hit = fault(number);
    hit.seen++;
    std::int64_t none = 0;
    hit.first_time.compare_exchange_strong(none, now.count());
    hit.latest_time = now.count();
    hit.hit++;
    const int pipe = ::open((path_ + table::kWakeSuffix).c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    EXPECT_EQ(::write(pipe, "", 1), 1);
    ::close(pipe);
  }

  std::string numbers;

 private:
  std::string path_;
  table::Table* table_ = nullptr;
};

class MessageFaultsRun : public LaunchServiceTest {
 protected:
  MessageFaultsRun() {
    char name[] = "/tmp/message_faults_run.XXXXXX";
    directory_ = log_directory_ = ::mkdtemp(name);
    supervisor_.observe([this](const ProcessEvent& event) {
      const auto found = event.spec.environment.find("RMW_MESSAGE_FAULTS");
      if (std::holds_alternative<ProcessStarted>(event.what)) {
        variables_.push_back(found == event.spec.environment.end() ? ""
                                                                   : found->second.substr(0, found->second.find(':')));
        if (found != event.spec.environment.end() && node_ == nullptr) {
          node_ = std::make_unique<NodeSide>(found->second);
        }
      }
    });
  }
  ~MessageFaultsRun() override {
    EXPECT_TRUE(std::filesystem::is_empty(directory_)) << "its files end with the launch";
    std::filesystem::remove_all(directory_);
  }

  void run_with(const std::string& actions, const std::string& faults) {
    const auto file = std::make_shared<SourceFile>(
        "/t.launch.xml", "<launch>" + actions + "<test name=\"t\"><output text=\"a\"/>" + faults + "</test></launch>");
    LaunchContext context(registry_, {{"PATH", "/bin"}}, "",
                          [this](LogLevel, std::string_view, std::string_view text) { messages_.emplace_back(text); });
    context.tests().take(0);
    context.scope().log_directory = log_directory_;
    LaunchService service(context, loop_, supervisor_,
                          [this](const LaunchError& error) { errors_.emplace_back(error.what()); });
    service.test().use(
        {[](const TestRequest&) {}, [](auto&&...) {}, [] {}, [this](const FaultEvent& event) { note(event); }});
    service.run(*parse_launch_description(file, registry_));
    EXPECT_THAT(errors_, IsEmpty());
  }

  static double seconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }

  void note(const FaultEvent& event) {
    const std::string now = fmt::format("{:g} s: {} ", seconds(loop_.now()), event.number);
    switch (event.kind) {
      case FaultEvent::Kind::kApplied:
        events_.push_back(fmt::format("{}hit {}, {:g} s to {:g} s", now, event.messages, seconds(event.first),
                                      seconds(event.latest)));
        break;
      case FaultEvent::Kind::kOver:
        events_.push_back(now + "over");
        break;
      case FaultEvent::Kind::kMissed:
        events_.push_back(now + "missed: " + event.reason);
        break;
    }
  }

  // At this time a node does something.
  template <typename Step>
  void at(Duration time, Step step) {
    sources_.push_back(loop_.after(time, [this, step] { step(*node_); }));
  }
  void hit_at(Duration time, std::size_t number) {
    at(time, [this, number](const NodeSide& node) { node.hit(number, loop_.now()); });
  }

  std::string directory_;
  std::string log_directory_;
  std::vector<std::string> variables_;  // of each process that has started, the numbers
  std::unique_ptr<NodeSide> node_;
  std::vector<EventLoop::SourcePtr> sources_;
  std::vector<std::string> events_;
};

TEST_F(MessageFaultsRun, EachProcessLearnsOfItsFaults) {
  runner_.default_script({.exits_after = 1s});
  run_with(R"(<executable name="p" cmd="p"/><executable name="q" cmd="q"/><executable name="r" cmd="r"/>)",
           R"(<fault topic="/a" do="drop" process="p" probability="0"/>
              <fault topic="/a" do="drop" process="p"/>
              <fault topic="/b" do="delay" by="0.5" process="q-2" node="n" on="take" occurrence="3" every="2"/>
              <fault process="p" do="kill" at="9"/>
              <fault topic="/c" do="corrupt" count="all" at="0.5"/>
              <fault service="/d" do="drop" process="r"/>
              <fault service="/d" do="drop" on="response" process="r"/>)");
  EXPECT_THAT(variables_, ElementsAre("1,3", "2,3", "3,4,5"));
  const table::Fault& first = node_->fault(1);
  EXPECT_EQ(std::string(first.topic), "/a");
  EXPECT_EQ(first.kind, table::Kind::kDrop);
  EXPECT_EQ(first.count, 1U);
  const table::Fault& second = node_->fault(2);
  EXPECT_EQ(second.kind, table::Kind::kDelay);
  EXPECT_EQ(second.side, table::Side::kTake);
  EXPECT_EQ(std::string(second.node), "/n");
  EXPECT_EQ(second.delay, 500'000'000);
  EXPECT_EQ(second.first, 3U);
  EXPECT_EQ(second.every, 2U);
  EXPECT_EQ(node_->fault(3).count, 0U);
  EXPECT_EQ(node_->fault(4).side, table::Side::kRequest);
  EXPECT_EQ(std::string(node_->fault(4).topic), "/d");
  EXPECT_EQ(node_->fault(5).side, table::Side::kResponse);
}

TEST_F(MessageFaultsRun, TellsOfEachHitAndOfTheLastOne) {
  runner_.default_script({.exits_after = 9s});
  hit_at(1s, 1);
  hit_at(2s, 1);
  run_with(R"(<executable cmd="p"/>)", R"(<fault topic="/a" do="drop" count="2"/>)");
  EXPECT_THAT(events_, ElementsAre("1 s: 1 hit 1, 1 s to 1 s", "2 s: 1 hit 2, 1 s to 2 s", "2 s: 1 over"));
  EXPECT_THAT(messages_, testing::Contains("fault 1: drop of messages 1 to 2 on '/a'"));
}

TEST_F(MessageFaultsRun, NothingWaitsForTheEndOfOneThatHasNone) {
  runner_.default_script({.exits_after = 4s});
  hit_at(1s, 1);
  hit_at(2s, 1);
  run_with(R"(<executable cmd="p"/>)", R"(<fault topic="/a" do="drop" count="all"/>)");
  EXPECT_THAT(events_, ElementsAre("1 s: 1 hit 1, 1 s to 1 s", "1 s: 1 over", "2 s: 1 hit 2, 1 s to 2 s", "2 s: 1 over",
                                   "4 s: 1 over"));
}

TEST_F(MessageFaultsRun, MessagesCountWhileItsTimeIs) {
  runner_.script("p", {{.exits_after = 9s, .output = {{.at = 1s, .text = "ready\n"}}}});
  std::vector<std::uint32_t> armed;
  for (const Duration time : {Duration(500ms), Duration(1200ms), Duration(1700ms), Duration(2700ms)}) {
    at(time, [&](const NodeSide& node) { armed.push_back(node.fault(1).is_armed); });
  }
  hit_at(2s, 1);
  run_with(R"(<executable cmd="p"/>)", R"xml(<fault topic="/a" do="drop" at="0.5" for="1">
    <depends_on process="p" condition="output" pattern="ready"/></fault>)xml");
  EXPECT_THAT(armed, ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(events_, ElementsAre("2 s: 1 hit 1, 2 s to 2 s", "2.5 s: 1 over"));
}

TEST_F(MessageFaultsRun, SaysHowManyMessagesThereWereInstead) {
  runner_.default_script({.exits_after = 4s});
  at(1s, [](const NodeSide& node) {
    node.fault(1).seen = 2;
    node.fault(2).seen = 1;
    node.fault(4).seen = 1;
  });
  run_with(R"(<executable cmd="p"/>)", R"(<fault topic="/a" do="drop" occurrence="5"/>
                                          <fault topic="/b" do="drop" occurrence="5" for="2"/>
                                          <fault topic="/c" do="drop"/>
                                          <fault service="/d" do="drop" occurrence="2"/>
                                          <fault service="/d" do="drop" on="response"/>)");
  EXPECT_THAT(
      events_,
      ElementsAre("2 s: 2 missed: there was 1 message on '/b' in that time",
                  "4 s: 1 missed: there were 2 messages on '/a'", "4 s: 3 missed: there were no messages on '/c'",
                  "4 s: 4 missed: there was 1 request of '/d'", "4 s: 5 missed: there were no responses of '/d'"));
}

TEST_F(MessageFaultsRun, HitsOfTheLastMomentCount) {
  runner_.default_script({.exits_after = 4s});
  at(4s, [this](const NodeSide& node) {
    node.fault(1).first_time = node.fault(1).latest_time = loop_.now().count();
    node.fault(1).hit = 1;
  });
  run_with(R"(<executable cmd="p"/>)", R"(<fault topic="/a" do="drop" count="2"/>)");
  EXPECT_THAT(events_, ElementsAre("4 s: 1 hit 1, 4 s to 4 s", "4 s: 1 over"));
}

TEST_F(MessageFaultsRun, WithoutItsFilesItIsMissed) {
  runner_.default_script({.exits_after = 1s});
  log_directory_ = "/nowhere";
  run_with(R"(<executable cmd="p"/>)", R"(<fault topic="/a" do="drop"/>)");
  EXPECT_THAT(events_,
              ElementsAre("0 s: 1 missed: cannot make the pipe '/nowhere/message_faults.wake': No such file or "
                          "directory"));
}

}  // namespace
}  // namespace launch
