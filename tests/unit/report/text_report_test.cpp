// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/report/example_reports.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(TextReport, HasNoControlCharactersOfNames) {
  Report report{"/traces/run", {}, ""};
  CallbackResult callback;
  callback.node = "/ping\n\x1b[2J";
  callback.owner = CallbackResult::Owner::kTimer;
  callback.durations = {7, 1'000.0, 0.0, 1'000, 1'000, 1'000, 1'000, 1'000, true};
  report.results.ros2.callbacks = {callback};
  report.results.overview = overview_of(2, {{71, "ping", 1, false, "left"}});
  EXPECT_THAT(text_report(report, {.all = true}),
              ::testing::AllOf(HasSubstr("\n  /ping??[2J, timer"), Not(HasSubstr("\x1b"))));
}

TEST(TextReport, ShowsEverythingOnDemand) {
  EXPECT_EQ(text_report(report_with_results(), {.all = true}),
            R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     10 of 1 process
Losses     no events lost

Worth a look
  No response       /add: 1 of 2 requests from /ns/node got no response
                    next: no service took them: let the client wait for the service

Callbacks                             rate  count      p50      p99      max  jitter  missed    load
  /ns/node, subscr..e_raw/compressed     -  70000  1.40 us  3.00 us  99.0 ms       -       -  5.25 %
  /ns/node, client of /add               -      1  1.00 us  1.00 us  1.00 us       -       -  0.00 %
  callback 0xcb                          -      -        -        -        -       -       -       -

Topics                                rate   sent  received  dropped     p50     p99      max
  /camera/front/image_raw/compressed     -  70010     70001        -  140 us  300 us  1.00 ms
  /rosout                                -      -         -        -       -       -        -

Services                   calls  unanswered      p50      p99      max
  /add, asked by /ns/node      2           1  3.00 us  3.00 us  3.00 us

Events by process                              total  ping [71]

Start of processes                       spawn  rcl_init  first node     ready    callback     message
  ping-1 [71]                                -         -     12.0 ms   20.0 ms           -           -
  sh-2 [72]                                  -         -           -         -           -           -
  (spawn: until exec; all others after exec: ready, an executor looks for work; the first callback; the first
  message that it publishes)

Callbacks                              count    mean  stddev     min     p50     p90     p99     max
node unknown, ping [71]
  callback 0xcb                            0
    1 more without an end
/ns/node, ping [71]
  subscription /camera/front/image_raw/compressed
                                       70000 1.50 us  250 ns 1.00 us 1.40 us 2.00 us 3.00 us 99.0 ms
    Node::on_image(Image const&)
    5 of them intra-process
  client of /add                           1 1.00 us       - 1.00 us 1.00 us 1.00 us 1.00 us 1.00 us

Topics                  published received  untaken    mean     min     p50     p90     p99     max
  /camera/front/image_raw/compressed
                            70010    70001       10  150 us  100 us  140 us  200 us  300 us 1.00 ms
    1 of those received have no publication in the trace
  (times: from rmw_publish to callback_start; untaken: by any subscription in the trace)
  (1 topic without messages)

Services                               count    mean  stddev     min     p50     p90     p99     max
/add, /ns/node asks unknown
  round trip                               1 3.00 us       - 3.00 us 3.00 us 3.00 us 3.00 us 3.00 us
    way to the service                     0
    in the service                         0
    way back                               0
    1 request without a response
  (from rmw_send_request to rmw_take_response; in the service: from rmw_take_request on)

Served by executors                    count    mean  stddev     min     p50     p90     p99     max
/ns/node, ping [71]
  client of /add                           2 2.00 us       - 2.00 us 2.00 us 2.00 us 2.00 us 2.00 us
node unknown, ping [71]
  waitable 0xabc                           7
  (until the response is sent, or the client's callback has ended)

Notes
  The session had no context vpid or vtid: processes and threads can't be told apart.
  4 messages of publishers or subscriptions whose creation is not in the trace: was it started late?
  ros2:rmw_publish has no field timestamp (recorded by another version of ros2_tracing?)
)");
}

TEST(TextReport, SaysWhatHappenedWhileItRan) {
  using Kind = LauncherEventResult::Kind;
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(2, {{71, "ping", 1, false, ""}});
  report.results.launcher_events = {
      {kBegin + 250'000'000, Kind::kCondition, "on_late of chain /camera -> /planner -> /brake above 50ms",
       "a way through /camera -> /planner -> /brake took 81.3 ms, more than 50 ms", "a.launch.xml", 7},
      {kBegin + 251'000'000, Kind::kScheduling, "planner-2", "nice 5", "a.launch.xml", 8},
      {kBegin + 900'000'000, Kind::kRespawn, "camera-1", "exit code 1", "a.launch.xml", 3},
      {kBegin + 1'900'000'000, Kind::kExit, "camera-1", "SIGINT", "a.launch.xml", 3}};
  EXPECT_THAT(text_report(report, {}), HasSubstr(R"(
While it ran
    +0.250 s  on_late of chain /camera -> /planner -> /brake above 50ms
              a way through /camera -> /planner -> /brake took 81.3 ms, more than 50 ms
    +0.251 s  planner-2: its threads get processors by nice 5
    +0.900 s  camera-1: ended, exit code 1, and is started again
)"));
  EXPECT_THAT(text_report(report, {.top = 1}), HasSubstr("more than 50 ms\n              and 2 more\n"));
  EXPECT_THAT(text_report(report, {.all = true}), HasSubstr("\n    +1.900 s  camera-1: ended, SIGINT\n"));
  EXPECT_THAT(text_report(report, {.node = "/ping"}), Not(HasSubstr("While it ran")));
}

TEST(TextReport, ARequestInFlightIsNotUnanswered) {
  Report report = report_with_results();
  report.results.ros2.calls[0].in_flight = 1;
  const std::string text = text_report(report, {.all = true});
  EXPECT_THAT(text, HasSubstr("\n  /add, asked by /ns/node      2           -  3.00 us"));
  EXPECT_THAT(text, HasSubstr("\n    1 request in flight at the end\n"));
  EXPECT_THAT(text, Not(HasSubstr("No response")));
  EXPECT_THAT(text, Not(HasSubstr("without a response")));
}

// A subscription takes the copy that comes through the middleware, too, and drops it.
TEST(TextReport, AMessageThatGoesBothWaysIsReceivedOnce) {
  Report report{"/traces/run", {}, ""};
  TopicResult topic;
  topic.name = "/chatter";
  topic.published = 7;
  topic.intra_process_published = 7;
  topic.received = 14;
  topic.intra_process_received = 7;
  report.results.ros2.topics = {topic};
  for (const char* const node : {"/within", "/outside"}) {
    SubscriptionResult subscription;
    subscription.node = node;
    subscription.topic = "/chatter";
    subscription.received = subscription.delivered = 7;
    report.results.ros2.subscriptions.push_back(subscription);
  }
  EXPECT_THAT(text_report(report, {.all = true}),
              HasSubstr("\nTopics      rate  sent  received  dropped  p50  p99  max\n"
                        "  /chatter     -     7        14        -    -    -    -\n"));
}

TEST(TextReport, FitsTheWidth) {
  for (const std::size_t width : {60U, 80U, 100U, 200U}) {
    for (const bool compact : {false, true}) {
      std::istringstream lines(text_report(report_with_results(), {.width = width, .compact = compact}));
      for (std::string line; std::getline(lines, line);) {
        if (line == "Notes") {
          break;
        }
        EXPECT_LE(line.size(), width) << line;
      }
    }
  }
}

TEST(TextReport, HasColorsIfTheTerminalHas) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(412, {{71, "ping", 412, false}});
  EXPECT_THAT(text_report(report, {.color = true}), HasSubstr("Losses     \033[32mno events lost\033[0m\n"));
  EXPECT_THAT(text_report(report), Not(HasSubstr("\033")));
}

TEST(TextReport, SortsAndChooses) {
  const auto first_words = [](const ReportOptions& options) {
    std::istringstream lines(text_report(busy_report(), options));
    std::string found;
    bool in_table = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("Callbacks")) {
        in_table = true;
      } else if (line.empty()) {
        in_table = false;
      } else if (in_table) {
        found += line.substr(2, line.find(',') - 2) + " ";
      }
    }
    return found;
  };
  EXPECT_EQ(first_words({}), "/slow /often /rare ");
  EXPECT_EQ(first_words({.top = 2}), "/slow /often ");
  EXPECT_EQ(first_words({.top = 0}), "/slow /often /rare ");
  EXPECT_EQ(first_words({.sort = "count"}), "/often /slow /rare ");
  EXPECT_EQ(first_words({.sort = "max"}), "/rare /slow /often ");
  EXPECT_EQ(first_words({.sort = "name"}), "/often /rare /slow ");
  EXPECT_EQ(first_words({.node = "/[or]*"}), "/often /rare ");
  EXPECT_EQ(first_words({.topic = "/scan"}), "/often ");
  EXPECT_EQ(first_words({.topic = "/none"}), "");
}

// Those that a label cannot tell apart.
TEST(TextReport, ChainsOfOneLabelSayWhatTheyDifferIn) {
  Report report = busy_report();
  ChainResult chain = report.results.ros2.chains.front();
  const auto through = [&chain](const std::vector<std::string>& nodes, const std::string& topic) {
    ChainResult other = chain;
    other.steps.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      other.steps[i].node = nodes[i];
      other.steps[i].topic = i == 0 ? "" : topic;
    }
    return other;
  };
  report.results.ros2.chains = {through({"/map", "/a", "/b", "/brake"}, "/x"),
                                through({"/map", "/a", "/c", "/brake"}, "/x"), through({"/lidar", "/brake"}, "/left"),
                                through({"/lidar", "/brake"}, "/right")};
  const std::string text = text_report(report, {.width = 130});
  EXPECT_THAT(text, HasSubstr(R"(
Chains                                    count      p50      p99      max  reaction p99  age max
  /map -> 2 more -> /brake  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms
    through /b
  /map -> 2 more -> /brake  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms
    through /c
  /lidar -> /brake  timer 100 ms             20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms
    by /left
  /lidar -> /brake  timer 100 ms             20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms
    by /right

)"));
  const std::string chosen = text_report(report, {.top = 1, .chain = {"/map", "/brake"}});
  EXPECT_THAT(chosen, HasSubstr("\nChains   "));
  EXPECT_THAT(chosen, HasSubstr("\n    through /c\n"));
}

TEST(TextReport, FollowsTheChosenChain) {
  EXPECT_EQ(text_report(busy_report(), {.chain = {"/slow", "/often"}}), R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     50000 of 2 processes
Losses     no events lost

Chains                           count      p50      p99      max  reaction p99  age max
  /slow -> /often  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms

Step by step                           count    mean  stddev     min     p50     p90     p99     max
  /slow, timer 100 ms
    until it publishes                    20 40.0 ms    0 ns 40.0 ms 40.0 ms 45.0 ms 45.0 ms 50.0 ms
    /scan on its way                      20  200 us    0 ns  200 us  200 us 3.00 ms 3.00 ms 5.00 ms
  /often, subscription /scan
  response                                20 41.0 ms    0 ns 41.0 ms 41.0 ms 48.0 ms 48.0 ms 55.0 ms
  reaction                                19  141 ms    0 ns  141 ms  141 ms  148 ms  148 ms  255 ms
  age                                     20 41.0 ms    0 ns 41.0 ms 41.0 ms 48.0 ms 48.0 ms 55.0 ms
)");
  EXPECT_THAT(text_report(busy_report(), {.chain = {"/often", "/slow"}}),
              HasSubstr("\nNo chain leads from /often to /slow.\n"));
}

TEST(TextReport, SaysWhatIsWorthALook) {
  EXPECT_EQ(text_report(busy_report()), R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     50000 of 2 processes
Losses     no events lost

Worth a look
  Busiest executor  /slow [71]: 95 % busy, once for 80.0 ms in /slow, timer 100 ms
                    next: give some of its nodes an executor of their own, or it several threads
  Dominating        /slow, timer 100 ms
                    its 20 runs take 50 % of the time, usually 50.0 ms each, at most 70.0 ms
                    next: shorten /slow, timer 100 ms (Slow..mer), or give it an executor of its own
  Dropped messages  /scan to /often
                    40 of 2040: 30 pushed out of its queue, 8 lost by the publisher, 2 not executed
                    next: a longer queue than 0, or shorter callbacks in its thread
  Longest wait      /scan to /often
                    messages wait 100 us for a busy executor, at p99 2.00 ms of 3.00 ms in all
                    next: launch report DIR --html FILE shows what its thread does meanwhile
  No response       /reset: 1 of 10 requests from /slow got no response
                    next: does the callback of /rare answer each request, and does the client spin?

Chains                           count      p50      p99      max  reaction p99  age max
  /slow -> /often  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms

Callbacks                            rate  count      p50      p99      max  jitter  missed     load
  /slow, timer 100 ms              9.5 Hz     20  50.0 ms  60.0 ms  70.0 ms  100 ms       1  50.00 %
  /often, subscription /scan    17.98 kHz   2000  20.0 us  30.0 us  40.0 us       -       -   2.00 %
  /rare, service /reset                 -     10  1.00 ms  2.00 ms  90.0 ms       -       -   0.50 %

Topics      rate  sent  received  dropped     p50      p99      max
  /scan  1020 Hz  2040      2002       40  200 us  3.00 ms  5.00 ms

Executors        busy  callbacks  longest busy                   in
  /slow [71]  95.00 %         20       80.0 ms  /slow, timer 100 ms

Services                  calls  unanswered      p50      p99      max
  /reset, asked by /slow     10           1  2.00 ms  3.00 ms  95.0 ms

Lifecycle nodes  state at the end  time in active  changes
  /rare                    active          1.90 s        1
)");
}

}  // namespace
}  // namespace tracing
