// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/free_name.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

namespace tracing {
namespace {

class FreeName : public ::testing::Test {
 protected:
  FreeName() {
    std::string name = testing::TempDir() + "free_name_XXXXXX";
    directory_ = ::mkdtemp(name.data());
    config_.session_name = "run-20260102030405";
    config_.has_timestamp = true;
    config_.base_path = directory_;
  }
  ~FreeName() override { std::filesystem::remove_all(directory_); }

  std::string directory_;
  TraceConfig config_;
};

TEST_F(FreeName, ThoseThatClaimOneNameAtOnceGetNumbers) {
  TraceConfig second = config_;
  TraceConfig third = config_;
  launch::UniqueFd first_claim = claim_free_name(config_);
  const launch::UniqueFd second_claim = claim_free_name(second);
  EXPECT_EQ(config_.session_name, "run-20260102030405");
  EXPECT_EQ(second.session_name, "run-20260102030405-2");
  first_claim.reset();
  const launch::UniqueFd third_claim = claim_free_name(third);
  EXPECT_EQ(third.session_name, "run-20260102030405");
}

TEST_F(FreeName, ATraceThatExistsKeepsItsName) {
  std::filesystem::create_directory(directory_ + "/run-20260102030405");
  std::filesystem::create_directory(directory_ + "/run-20260102030405-2");
  const launch::UniqueFd claim = claim_free_name(config_);
  EXPECT_EQ(config_.session_name, "run-20260102030405-3");
}

TEST_F(FreeName, ANameWithoutATimeStampIsWhatTheUserWants) {
  std::filesystem::create_directory(directory_ + "/run-20260102030405");
  config_.has_timestamp = false;
  EXPECT_FALSE(claim_free_name(config_));
  config_.has_timestamp = true;
  config_.append_trace = true;
  EXPECT_FALSE(claim_free_name(config_));
  EXPECT_EQ(config_.session_name, "run-20260102030405");
}

}  // namespace
}  // namespace tracing
