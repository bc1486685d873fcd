// SPDX-License-Identifier: Apache-2.0
// The graph cache gets discovery and the messages of participants in any order.
#include "graph/graph_cache.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using rmw_fastrtps::Gid;
using rmw_fastrtps::GraphCache;

Gid gid_of(unsigned char number) {
  Gid gid{};
  gid[0] = number;
  return gid;
}

GraphCache::EntitiesInfo told_by(const Gid& participant, const std::string& node) {
  GraphCache::EntitiesInfo info;
  std::copy(participant.begin(), participant.end(), info.gid.data.begin());
  info.node_entities_info_seq.resize(1);
  info.node_entities_info_seq[0].node_namespace = "/";
  info.node_entities_info_seq[0].node_name = node;
  return info;
}

class Graph : public testing::Test {
 protected:
  std::vector<std::string> nodes() const {
    std::vector<std::string> names;
    for (const GraphCache::Node& node : graph_.nodes()) {
      names.push_back(node.name);
    }
    return names;
  }

  int changes_ = 0;
  GraphCache graph_{[this] { ++changes_; }};
};

TEST_F(Graph, KnowsNodesBeforeTheirParticipantIsDiscovered) {
  graph_.update_nodes(told_by(gid_of(1), "talker"));
  graph_.add_participant(gid_of(1), "/enclave");
  ASSERT_EQ(graph_.nodes().size(), 1u);
  EXPECT_EQ(graph_.nodes()[0].name, "talker");
  EXPECT_EQ(graph_.nodes()[0].enclave, "/enclave");
}

TEST_F(Graph, IgnoresWhatAParticipantToldBeforeItsEnd) {
  graph_.add_participant(gid_of(1), "/");
  graph_.update_nodes(told_by(gid_of(1), "talker"));
  graph_.remove_participant(gid_of(1));
  const int changes = changes_;
  graph_.update_nodes(told_by(gid_of(1), "talker"));
  EXPECT_EQ(nodes(), std::vector<std::string>());
  EXPECT_EQ(changes_, changes);
}

TEST_F(Graph, KnowsAParticipantAgainThatWasThoughtDead) {
  graph_.add_participant(gid_of(1), "/");
  graph_.remove_participant(gid_of(1));
  graph_.add_participant(gid_of(1), "/");
  graph_.update_nodes(told_by(gid_of(1), "talker"));
  EXPECT_EQ(nodes(), std::vector<std::string>{"talker"});
}

TEST_F(Graph, ForgetsTheEndpointsOfAParticipantWithIt) {
  Gid writer = gid_of(1);
  writer[15] = 3;
  graph_.add_participant(gid_of(1), "/");
  graph_.add_endpoint(writer, {GraphCache::Kind::kWriter, "rt/chatter", "type"});
  EXPECT_EQ(graph_.count(GraphCache::Kind::kWriter, "rt/chatter"), 1u);
  graph_.remove_participant(gid_of(1));
  EXPECT_EQ(graph_.count(GraphCache::Kind::kWriter, "rt/chatter"), 0u);
}

using IncompatibleType = rmw_fastrtps::StatusEventOf<rmw_incompatible_type_status_t>;

int32_t taken_from(IncompatibleType& event) {
  rmw_incompatible_type_status_t status{};
  event.take(&status);
  return status.total_count_change;
}

TEST_F(Graph, TellsEndpointsOfOthersOnTheirTopicWithAnotherType) {
  const auto publisher = std::make_shared<IncompatibleType>();
  const auto subscription = std::make_shared<IncompatibleType>();
  graph_.add_endpoint(gid_of(1), {GraphCache::Kind::kWriter, "rt/chatter", "String", {}, publisher});
  graph_.add_endpoint(gid_of(2), {GraphCache::Kind::kReader, "rt/other", "Int32", {}});
  graph_.add_endpoint(gid_of(3), {GraphCache::Kind::kWriter, "rt/chatter", "Int32", {}});
  graph_.add_endpoint(gid_of(4), {GraphCache::Kind::kReader, "rt/chatter", "String", {}});
  EXPECT_FALSE(publisher->is_ready());

  graph_.add_endpoint(gid_of(5), {GraphCache::Kind::kReader, "rt/chatter", "Int32", {}});
  graph_.add_endpoint(gid_of(5), {GraphCache::Kind::kReader, "rt/chatter", "Int32", {}});
  EXPECT_TRUE(publisher->is_ready());
  EXPECT_EQ(taken_from(*publisher), 1);
  EXPECT_FALSE(publisher->is_ready());

  graph_.add_endpoint(gid_of(6), {GraphCache::Kind::kReader, "rt/chatter", "UInt8", {}, subscription});
  EXPECT_EQ(taken_from(*subscription), 2);
  EXPECT_EQ(taken_from(*publisher), 1);

  // Discovery may find an own endpoint before its creation is reported, and again after it.
  const auto late = std::make_shared<IncompatibleType>();
  graph_.add_endpoint(gid_of(8), {GraphCache::Kind::kReader, "rt/chatter", "Int32", {}});
  EXPECT_EQ(taken_from(*publisher), 1);
  graph_.add_endpoint(gid_of(8), {GraphCache::Kind::kReader, "rt/chatter", "Int32", {}, late});
  graph_.add_endpoint(gid_of(8), {GraphCache::Kind::kReader, "rt/chatter", "Int32", {}});
  EXPECT_EQ(taken_from(*late), 1);
  EXPECT_FALSE(publisher->is_ready());

  graph_.remove_endpoint(gid_of(6));
  graph_.add_endpoint(gid_of(7), {GraphCache::Kind::kWriter, "rt/chatter", "Float32", {}});
  EXPECT_FALSE(subscription->is_ready());
}

}  // namespace
