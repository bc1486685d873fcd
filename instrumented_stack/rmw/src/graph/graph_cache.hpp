// SPDX-License-Identifier: Apache-2.0
// The known graph: participants, nodes and endpoints that discovery has found so far, and those of this process.
//
// Endpoints come from DDS discovery. Nodes come from the topic ros_discovery_info, on which every participant announces
// the names of its nodes and the endpoints of each. Thread safe.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "event/status_event.hpp"
#include "rmw/types.h"
#include "rmw_dds_common/msg/participant_entities_info.hpp"
#include "types/gid.hpp"

namespace rmw_fastrtps {

class GraphCache {
 public:
  using EntitiesInfo = rmw_dds_common::msg::ParticipantEntitiesInfo;

  enum class Kind { kWriter, kReader };

  // Names as DDS has them: `rt/chatter`, `std_msgs::msg::dds_::String_`.
  struct Endpoint {
    Kind kind;
    std::string topic;
    std::string type;
    rmw_qos_profile_t qos;
    // Set for an own endpoint, else null. It is notified of endpoints at the other side of the topic that have another
    // type. Fast DDS 2.9 does not report them.
    std::shared_ptr<StatusEventOf<rmw_incompatible_type_status_t>> incompatible_type = nullptr;
    std::string type_hash = {};  // `RIHS01_…`; empty if it is not announced
  };

  // An endpoint with its node. The names are empty if no node is known to have it.
  struct OwnedEndpoint {
    Gid gid;
    Endpoint endpoint;
    std::string node_name;
    std::string node_namespace;
  };

  // DDS topic names with their DDS type names.
  using Topics = std::map<std::string, std::set<std::string>>;

  struct Node {
    std::string name;
    std::string namespace_;
    std::string enclave;
  };

  // `on_change` is called after every change, without a lock held.
  explicit GraphCache(std::function<void()> on_change) : on_change_(std::move(on_change)) {}

  // Two endpoints have found, or lost, each other: a change that the graph itself does not show. An endpoint is known
  // before Fast DDS matches it, so the change of the graph alone comes too early for whoever waits for a match.
  void match_changed() { on_change_(); }

  void add_participant(const Gid& gid, std::string enclave);
  // Also forgets the participant's nodes and endpoints.
  void remove_participant(const Gid& gid);
  void add_endpoint(const Gid& gid, Endpoint endpoint);
  void remove_endpoint(const Gid& gid);
  // Replaces the known nodes of a participant by those it has announced. Messages after the participant's end are
  // ignored, because discovery and the topic are not ordered.
  void update_nodes(const EntitiesInfo& info);

  // Changes of a participant of this process. Each returns the new announcement of that participant.
  EntitiesInfo add_node(const Gid& participant, const std::string& namespace_, const std::string& name);
  EntitiesInfo remove_node(const Gid& participant, const std::string& namespace_, const std::string& name);
  EntitiesInfo add_node_endpoint(const Gid& participant, const std::string& namespace_, const std::string& name,
                                 Kind kind, const Gid& endpoint);
  EntitiesInfo remove_node_endpoint(const Gid& participant, const std::string& namespace_, const std::string& name,
                                    Kind kind, const Gid& endpoint);

  std::size_t count(Kind kind, std::string_view topic) const;
  std::vector<Node> nodes() const;
  Topics topics() const;
  std::vector<OwnedEndpoint> endpoints(Kind kind, std::string_view topic) const;
  // The topics that nodes of that name write or read. Empty optional if there is no such node.
  std::optional<Topics> topics_of_node(const std::string& namespace_, const std::string& name, Kind kind) const;

 private:
  using NodeInfo = rmw_dds_common::msg::NodeEntitiesInfo;

  struct Participant {
    std::string enclave;
    std::vector<NodeInfo> nodes;
  };

  // The writers and the readers of a topic, each by their types, of which there is usually one. Points into endpoints_.
  struct EndpointsOfTopic {
    using ByType = std::map<std::string, std::unordered_set<const Endpoint*>>;
    ByType writers;
    ByType readers;

    ByType& of(Kind kind) { return kind == Kind::kWriter ? writers : readers; }
    const ByType& of(Kind kind) const { return kind == Kind::kWriter ? writers : readers; }
    bool empty() const { return writers.empty() && readers.empty(); }
  };

  // Null if no node is known to have the endpoint. The lock must be held.
  const NodeInfo* owner_of(const Gid& endpoint, Kind kind) const;

  // Changes the nodes of an own participant under the lock, then reports the change.
  template <typename Change>
  EntitiesInfo change_nodes(const Gid& gid, Change change);

  // The lock must be held for these:
  std::vector<const Endpoint*> incompatible_with(const Endpoint& endpoint) const;
  void enter_topic(const Endpoint& endpoint);
  void leave_topic(const Endpoint& endpoint);

  std::function<void()> on_change_;
  mutable std::mutex mutex_;
  std::map<Gid, Participant> participants_;
  std::deque<Gid> gone_;  // the last participants that were removed
  std::map<Gid, Endpoint> endpoints_;
  std::map<std::string, EndpointsOfTopic, std::less<>> endpoints_by_topic_;
};

}  // namespace rmw_fastrtps
