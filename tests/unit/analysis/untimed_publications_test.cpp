// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/untimed_publications.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace tracing {
namespace {

constexpr std::int64_t kOneSecond = 1'000'000'000;
constexpr std::int64_t kWrite = 5'000;    // ns, from rcl_publish to the source timestamp
constexpr std::int64_t kWindow = 30'000;  // ns, from rcl_publish to the next event of the thread

class UntimedPublicationsTest : public ::testing::Test {
 protected:
  // Publisher 3 of thread 71 of process 0, unless something else is said.
  void publish(std::uint64_t number, std::int64_t rcl_ns, ThreadId thread = {0, 71}, ObjectId publisher = 3) {
    publications.add(made(number, rcl_ns, thread, publisher));
  }
  // The thread goes on after `after_ns`.
  void publish_and_go_on(std::uint64_t number, std::int64_t rcl_ns, ThreadId thread = {0, 71}, ObjectId publisher = 3,
                         std::int64_t after_ns = kWindow) {
    publish(number, rcl_ns, thread, publisher);
    publications.close(made(number, rcl_ns, thread, publisher), rcl_ns + after_ns);
  }
  // The number of the publication, 0 for none.
  std::uint64_t take(std::int64_t source_timestamp, std::int64_t taken_ns) {
    const std::optional<Publication> found = publications.take({source_timestamp, taken_ns, 9}, clocks);
    return found ? found->number : 0;
  }
  // Messages with all the time in the world between them, after which the clock of the process is confirmed.
  void confirm(ProcessId process, std::int64_t begin_ns) {
    for (std::uint32_t i = 0; i < SourceClock::kConfirmed; ++i) {
      const std::int64_t at = begin_ns + i * kOneSecond;
      publish_and_go_on(900 + i, at, {process, 71}, 3 + process);
      ASSERT_EQ(take(at + kWrite, at + 100'000), 900 + i);
    }
  }

  UntimedPublications publications{100};
  SourceClocks clocks;

 private:
  static Publication made(std::uint64_t number, std::int64_t rcl_ns, ThreadId thread, ObjectId publisher) {
    return {.number = number,
            .topic = 0,
            .publisher = publisher,
            .thread = thread,
            .rcl_ns = rcl_ns,
            .published_ns = rcl_ns + 500};
  }
};

TEST_F(UntimedPublicationsTest, FindsTheOneThatWasWrittenAtTheTime) {
  publish_and_go_on(1, 1 * kOneSecond);
  publish_and_go_on(2, 2 * kOneSecond);
  publish_and_go_on(3, 3 * kOneSecond);
  EXPECT_EQ(take(2 * kOneSecond + kWrite, 4 * kOneSecond), 2u);
  EXPECT_EQ(take(3 * kOneSecond + kWrite, 4 * kOneSecond), 3u);
  EXPECT_EQ(take(1 * kOneSecond + kWrite, 4 * kOneSecond), 1u) << "for a subscription that is late";
  EXPECT_EQ(publications.count(), 0u);
}

TEST_F(UntimedPublicationsTest, GivesEachPublicationOnce) {
  publish_and_go_on(1, 1 * kOneSecond);
  EXPECT_EQ(take(1 * kOneSecond + kWrite, 2 * kOneSecond), 1u);
  EXPECT_EQ(take(1 * kOneSecond + kWrite + 1, 2 * kOneSecond), 0u) << "a message of somebody else";
}

TEST_F(UntimedPublicationsTest, FindsNoneForAMessageFromBeforeTheTrace) {
  publish_and_go_on(1, 10 * kOneSecond);
  EXPECT_EQ(take(9 * kOneSecond, 10 * kOneSecond + kWindow), 0u);
  EXPECT_EQ(take(10 * kOneSecond + kWrite, 10 * kOneSecond + 2 * kWindow), 1u);
}

TEST_F(UntimedPublicationsTest, LeavesOutWhatGotLost) {
  for (std::uint64_t i = 1; i <= 10; ++i) {
    publish_and_go_on(i, static_cast<std::int64_t>(i) * kOneSecond);
  }
  EXPECT_EQ(take(2 * kOneSecond + kWrite, 11 * kOneSecond), 2u);
  EXPECT_EQ(take(9 * kOneSecond + kWrite, 11 * kOneSecond), 9u);
  EXPECT_EQ(publications.count(), 8u);
}

TEST_F(UntimedPublicationsTest, TellsPublishersOfOneThreadApart) {
  confirm(0, kOneSecond);
  publish(1, 20 * kOneSecond, {0, 71}, 3);
  publications.close({.number = 1, .thread = {0, 71}}, 20 * kOneSecond + 20'000);
  publish(2, 20 * kOneSecond + 20'000, {0, 71}, 4);
  publications.close({.number = 2, .thread = {0, 71}}, 20 * kOneSecond + 40'000);
  EXPECT_EQ(take(20 * kOneSecond + 20'000 + kWrite, 21 * kOneSecond), 2u);
  EXPECT_EQ(take(20 * kOneSecond + kWrite, 21 * kOneSecond), 1u);
}

TEST_F(UntimedPublicationsTest, FindsTheMessagesOfABurst) {
  confirm(0, kOneSecond);
  for (std::uint64_t i = 1; i <= 50; ++i) {
    publish_and_go_on(i, 20 * kOneSecond + static_cast<std::int64_t>(i) * 9'000, {0, 71}, 3, 9'000);
  }
  for (std::uint64_t i = 1; i <= 50; i += 2) {  // every other one is lost
    EXPECT_EQ(take(20 * kOneSecond + static_cast<std::int64_t>(i) * 9'000 + kWrite, 21 * kOneSecond), i);
  }
}

TEST_F(UntimedPublicationsTest, LeavesTheMessagesOfABurstOpenAsLongAsTheClockIsNotKnown) {
  for (std::uint64_t i = 1; i <= 5; ++i) {
    publish_and_go_on(i, 20 * kOneSecond + static_cast<std::int64_t>(i) * 9'000, {0, 71}, 3, 9'000);
  }
  EXPECT_EQ(take(20 * kOneSecond + 3 * 9'000 + kWrite, 21 * kOneSecond), 0u);
}

TEST_F(UntimedPublicationsTest, LeavesOpenWhatTwoThreadsPublishAtOnce) {
  confirm(0, kOneSecond);
  publish_and_go_on(1, 20 * kOneSecond, {0, 71});
  publish_and_go_on(2, 20 * kOneSecond + 2'000, {0, 72});
  EXPECT_EQ(take(20 * kOneSecond + 10'000, 21 * kOneSecond), 0u);
  EXPECT_EQ(take(20 * kOneSecond + 12'000, 21 * kOneSecond), 0u);
  publish_and_go_on(3, 22 * kOneSecond, {0, 71});
  publish_and_go_on(4, 22 * kOneSecond + kWindow + 10'000, {0, 72});
  EXPECT_EQ(take(22 * kOneSecond + kWrite, 23 * kOneSecond), 3u) << "one after the other";
  EXPECT_EQ(take(22 * kOneSecond + kWindow + 10'000 + kWrite, 23 * kOneSecond), 4u);
}

TEST_F(UntimedPublicationsTest, LeavesOpenWhatTwoProcessesPublishAtOneTime) {
  confirm(0, kOneSecond);
  confirm(1, 20 * kOneSecond);
  publish_and_go_on(1, 40 * kOneSecond, {0, 71}, 3);
  publish_and_go_on(2, 40 * kOneSecond, {1, 71}, 4);
  EXPECT_EQ(take(40 * kOneSecond + kWrite, 41 * kOneSecond), 0u);
}

TEST_F(UntimedPublicationsTest, PrefersAWriteThatTakesAsLongAsUsual) {
  confirm(0, kOneSecond);
  confirm(1, 20 * kOneSecond);
  // Process 0 works for 50 ms after it has published.
  publish_and_go_on(1, 40 * kOneSecond, {0, 71}, 3, 50'000'000);
  publish_and_go_on(2, 40 * kOneSecond + 30'000'000, {1, 71}, 4);
  EXPECT_EQ(take(40 * kOneSecond + 30'000'000 + kWrite, 41 * kOneSecond), 2u);
  EXPECT_EQ(take(40 * kOneSecond + kWrite, 41 * kOneSecond), 1u);
}

TEST_F(UntimedPublicationsTest, FindsWhatIsTakenBeforeItsThreadGoesOn) {
  publish(1, 1 * kOneSecond);
  EXPECT_EQ(take(1 * kOneSecond + kWrite, 1 * kOneSecond + 20'000), 1u);
}

TEST_F(UntimedPublicationsTest, AllowsForClocksThatDifferALittle) {
  for (const std::int64_t difference : {-20'000, 20'000}) {
    UntimedPublications of_process(100);
    const ThreadId thread{static_cast<ProcessId>(difference > 0 ? 1 : 2), 71};
    for (std::uint64_t i = 1; i <= 100; ++i) {
      const std::int64_t at = static_cast<std::int64_t>(i) * 1'000'000;  // 1 kHz
      const Publication publication{.number = i, .publisher = 3, .thread = thread, .rcl_ns = at, .published_ns = at};
      of_process.add(publication);
      of_process.close(publication, at + kWindow);
      const auto found = of_process.take({at + kWrite + difference, at + 100'000, 9}, clocks);
      ASSERT_TRUE(found) << i;
      EXPECT_EQ(found->number, i);
    }
  }
}

TEST_F(UntimedPublicationsTest, LearnsThatTheClockWasSet) {
  confirm(0, kOneSecond);
  std::uint64_t found = 0;
  for (std::uint64_t i = 1; i <= 20; ++i) {
    const std::int64_t at = static_cast<std::int64_t>(100 + i) * kOneSecond;
    publish_and_go_on(i, at);
    const std::uint64_t taken = take(at + kWrite + 3'600 * kOneSecond, at + 100'000);
    EXPECT_TRUE(taken == 0 || taken == i);
    found += taken == i ? 1 : 0;
  }
  EXPECT_EQ(found, 20 - SourceClock::kAgreeing);
}

TEST_F(UntimedPublicationsTest, TakesNoMessageOfSomebodyElseForAnOldPublication) {
  confirm(0, kOneSecond);
  publish(1, 50 * kOneSecond);  // the thread does nothing after it
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(take(60 * kOneSecond + i * 100'000'000, 60 * kOneSecond + i * 100'000'000 + 50'000), 0u);
  }
  EXPECT_EQ(clocks.of(0).least_ns(), kWrite) << "and nothing was learned from them";
}

TEST_F(UntimedPublicationsTest, LearnsNothingFromProcessesOfAnotherMachine) {
  clocks.compare_by([](ProcessId process, ProcessId other) { return process == other; });
  confirm(0, kOneSecond);
  for (std::uint64_t i = 1; i <= 20; ++i) {
    const std::int64_t at = static_cast<std::int64_t>(100 + i) * kOneSecond;
    publish_and_go_on(i, at);
    // Taken before the next one, which it is, was published.
    EXPECT_EQ(take(at + kOneSecond + kWrite, at + kOneSecond - 100'000), 0u);
  }
  EXPECT_EQ(clocks.of(0).least_ns(), kWrite);
}

TEST_F(UntimedPublicationsTest, ForgetsTheOldestOfAThread) {
  for (std::uint64_t i = 1; i <= 101; ++i) {
    publish_and_go_on(i, static_cast<std::int64_t>(i) * kOneSecond);
  }
  EXPECT_EQ(take(1 * kOneSecond + kWrite, 200 * kOneSecond), 0u);
  EXPECT_EQ(take(2 * kOneSecond + kWrite, 200 * kOneSecond), 2u);
  EXPECT_EQ(publications.count(), 100u) << "the forgotten one counts";
}

TEST_F(UntimedPublicationsTest, GivesAPublicationByItsNumber) {
  publish_and_go_on(1, 1 * kOneSecond);
  publish_and_go_on(2, 2 * kOneSecond);
  ASSERT_TRUE(publications.extract(1));
  EXPECT_FALSE(publications.extract(1));
  EXPECT_EQ(publications.count(), 1u);
}

// As programs that publish, sleep and publish again: the trace has no event of the thread in between.
TEST_F(UntimedPublicationsTest, TellsProcessesApartThatDoNothingElse) {
  std::mt19937 random(11);
  std::uniform_int_distribution<std::int64_t> jitter(0, 400'000);
  struct Sent {
    std::int64_t at;
    std::uint64_t number;
    ProcessId process;
  };
  std::vector<Sent> all;
  for (ProcessId process = 0; process < 4; ++process) {
    for (std::int64_t i = 0; i < 1'000; ++i) {
      all.push_back({i * 5'000'000 + process * 1'100'000 + jitter(random), 0, process});
    }
  }
  std::sort(all.begin(), all.end(), [](const Sent& a, const Sent& b) { return a.at < b.at; });
  std::uint64_t number = 0;
  std::size_t found = 0;
  for (Sent& one : all) {
    one.number = ++number;
    publish(one.number, one.at, {one.process, 71}, 3 + one.process);
    const std::uint64_t taken = take(one.at + kWrite + jitter(random) / 100, one.at + 300'000);
    EXPECT_TRUE(taken == 0 || taken == one.number) << taken << " for " << one.number;
    found += taken == one.number ? 1 : 0;
  }
  EXPECT_GT(found, all.size() * 99 / 100);
}

// Processes with one or two threads publish at random times on one topic. Writes take from 3 us on, sometimes
// milliseconds; a tenth of the messages is lost; each clock of a process differs by some microseconds.
TEST_F(UntimedPublicationsTest, IsHardlyEverWrong) {
  std::mt19937 random(7);
  const auto between = [&](std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random);
  };
  struct Written {
    std::uint64_t number;
    std::int64_t rcl_ns;
    std::int64_t end_ns;
    std::int64_t source_timestamp;
    ThreadId thread;
  };
  std::vector<Written> written;
  std::uint64_t number = 0;
  for (ProcessId process = 0; process < 4; ++process) {
    const std::int64_t offset = between(-5'000, 5'000);
    for (std::int64_t vtid = 1; vtid <= 1 + process % 2; ++vtid) {
      for (std::int64_t at = between(0, 20'000'000); at < 100 * kOneSecond; at += between(18'000'000, 22'000'000)) {
        const std::int64_t write = between(1, 50) == 1 ? between(100'000, 3'000'000) : between(3'000, 12'000);
        written.push_back({++number, at, at + write + between(3'000, 60'000), at + write + offset, {process, vtid}});
      }
    }
  }
  // In the order of time: publications, the end of each, and takes.
  struct Step {
    std::int64_t time_ns;
    int kind;
    const Written* what;
  };
  std::vector<Step> steps;
  for (const Written& one : written) {
    steps.push_back({one.rcl_ns, 0, &one});
    steps.push_back({one.end_ns, 1, &one});
    if (between(1, 10) > 1) {
      steps.push_back({one.end_ns + between(10'000, 5'000'000), 2, &one});
    }
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.time_ns < b.time_ns; });
  std::size_t taken = 0;
  std::size_t found = 0;
  std::size_t wrong = 0;
  for (const Step& step : steps) {
    const Publication publication{.number = step.what->number,
                                  .publisher = step.what->thread.process,
                                  .thread = step.what->thread,
                                  .rcl_ns = step.what->rcl_ns,
                                  .published_ns = step.what->rcl_ns};
    if (step.kind == 0) {
      publications.add(publication);
    } else if (step.kind == 1) {
      publications.close(publication, step.time_ns);
    } else {
      ++taken;
      const std::uint64_t result = take(step.what->source_timestamp, step.time_ns);
      found += result == 0 ? 0 : 1;
      wrong += result == 0 || result == step.what->number ? 0 : 1;
    }
  }
  RecordProperty("taken", static_cast<int>(taken));
  RecordProperty("found", static_cast<int>(found));
  RecordProperty("wrong", static_cast<int>(wrong));
  EXPECT_GT(taken, 20'000u);
  EXPECT_GT(found, taken * 97 / 100) << "of " << taken;
  EXPECT_LT(wrong, found / 1'000) << "of " << found;
}

}  // namespace
}  // namespace tracing
