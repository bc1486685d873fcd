// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/chains/chain_definition.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <stdexcept>

namespace tracing {
namespace {

namespace fs = std::filesystem;

class Chains : public ::testing::Test {
 protected:
  Chains() {
    std::string name = fs::temp_directory_path() / "chains_test_XXXXXX";
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("cannot create " + name);
    }
    directory_ = name;
  }
  ~Chains() override { fs::remove_all(directory_); }
  void write(const std::string& text) { std::ofstream(directory_ / kChainsFile) << text; }
  // The error without the path.
  std::string error() {
    try {
      read_chains(directory_);
    } catch (const std::runtime_error& error) {
      const std::string text = error.what();
      return text.substr(text.find("read: ") + 6);
    }
    return "";
  }
  fs::path directory_;
};

const ChainDefinition kReaction{"reaction", {"/camera", "/fusion*", "/brake"}, 50'500'000};
const ChainDefinition kPath{"path", {"/a", "/b"}, std::nullopt};

TEST_F(Chains, AreReadAsTheyWereWritten) {
  write_chains({kReaction, kPath}, directory_ / "new/trace");
  EXPECT_EQ(read_chains(directory_ / "new/trace"), (std::vector{kReaction, kPath}));
  EXPECT_EQ(read_chains(directory_), (std::vector{kReaction, kPath})) << "of a directory above";
}

TEST_F(Chains, OfATraceAreThoseOfItsParts) {
  write_chains({kReaction}, directory_);
  fs::create_directories(directory_ / "snapshot/snapshot-1/deeper");
  EXPECT_EQ(read_chains(directory_ / "snapshot"), std::vector{kReaction});
  EXPECT_EQ(read_chains(directory_ / "snapshot/snapshot-1"), std::vector{kReaction});
  EXPECT_TRUE(read_chains(directory_ / "snapshot/snapshot-1/deeper").empty());
}

TEST_F(Chains, NamesWithoutASlashAreBelowTheRoot) {
  write(R"({"chains": [{"name": "brake", "nodes": ["lidar*", "*/fusion", "/front/brake"]}]})");
  EXPECT_EQ(read_chains(directory_),
            std::vector{(ChainDefinition{"brake", {"/lidar*", "*/fusion", "/front/brake"}, std::nullopt})});
}

TEST_F(Chains, AreThereOnce) {
  write_chains({kReaction}, directory_ / "a");
  write_chains({kReaction, kPath}, directory_ / "b");
  EXPECT_EQ(read_chains(directory_), (std::vector{kReaction, kPath}));
}

TEST_F(Chains, OfADamagedFileAreAnError) {
  write("{");
  EXPECT_EQ(error(), "it has no list 'chains'");
  write(R"({"chains": [{"nodes": ["/a", "/b"]}]})");
  EXPECT_EQ(error(), "a chain has no name");
  write(R"({"chains": [{"name": "x", "nodes": ["/a"]}]})");
  EXPECT_EQ(error(), "chain 'x' has less than two nodes");
  write(R"({"chains": [{"name": "x", "nodes": ["/a", 7]}]})");
  EXPECT_EQ(error(), "the nodes of chain 'x' are not all texts");
  write(R"({"chains": [{"name": "x", "nodes": ["/a", "/b"], "budget_ms": 0}]})");
  EXPECT_EQ(error(), "budget_ms of chain 'x' is not a number above 0");
}

}  // namespace
}  // namespace tracing
