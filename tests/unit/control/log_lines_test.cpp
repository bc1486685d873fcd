// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/log_lines.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

namespace {

using launch::past_lines;
using testing::ElementsAre;
using testing::IsEmpty;

class LogLinesTest : public testing::Test {
 protected:
  LogLinesTest() {
    std::string name = (std::filesystem::temp_directory_path() / "log-XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
    log_ = (directory_ / "launch.log").string();
    std::ofstream(log_) << kText;
  }
  ~LogLinesTest() override { std::filesystem::remove_all(directory_); }
  LogLinesTest(const LogLinesTest&) = delete;
  LogLinesTest& operator=(const LogLinesTest&) = delete;

  static constexpr std::size_t kAll = 100;
  inline static const std::string kText =
      "1.0 [INFO] [talker-1]: process started with pid [7]\n"
      "1.1 [talker-1] one\n"
      "1.2 [other-2] two\n"
      "1.3 [talker-1] three\n"
      "no line of a process\n"
      "1.4 [talker-1] [talker-1] four\n";
  std::filesystem::path directory_;
  std::string log_;
};

TEST_F(LogLinesTest, AreThoseOfTheProcessesAndNotOfTheLauncher) {
  EXPECT_THAT(past_lines(log_, {}, {"talker-1"}, kAll),
              ElementsAre("[talker-1] one", "[talker-1] three", "[talker-1] [talker-1] four"));
  EXPECT_THAT(past_lines(log_, {}, {"talker-1", "other-2"}, 3),
              ElementsAre("[other-2] two", "[talker-1] three", "[talker-1] [talker-1] four"));
  EXPECT_THAT(past_lines(log_, {}, {"talker"}, kAll), IsEmpty());
  EXPECT_THAT(past_lines(log_ + "x", {}, {"talker-1"}, kAll), IsEmpty());
}

TEST_F(LogLinesTest, EndWhereTheLogEndedWhenTheFollowingBegan) {
  EXPECT_THAT(past_lines(log_, {0, kText.find("1.3")}, {"talker-1"}, kAll), ElementsAre("[talker-1] one"));
}

TEST_F(LogLinesTest, ALineThatIsCutAtTheBeginningIsLeftOut) {
  const std::size_t one = kText.find("1.1");
  EXPECT_THAT(past_lines(log_, {one, kText.find("1.3")}, {"talker-1"}, kAll), ElementsAre("[talker-1] one"));
  EXPECT_THAT(past_lines(log_, {one + 1, kText.find("1.3")}, {"talker-1"}, kAll), IsEmpty());
  EXPECT_THAT(past_lines(log_, {one + 1, kText.size()}, {"talker-1"}, kAll),
              ElementsAre("[talker-1] three", "[talker-1] [talker-1] four"));
  EXPECT_THAT(past_lines(log_, {kText.size() + 5, kText.size() + 9}, {"talker-1"}, kAll), IsEmpty());
}

}  // namespace
