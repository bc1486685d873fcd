// Who is there: the participants, nodes and endpoints that discovery has found so far, and those of this process.
//
// Endpoints come from DDS discovery, nodes from the topic ros_discovery_info, in which every participant tells the
// names of its nodes and the endpoints of each. Thread safe.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gid.hpp"
#include "rmw/types.h"
#include "rmw_dds_common/msg/participant_entities_info.hpp"

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
  };

  // One with its node. Empty names if no node is known to have it.
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

  // `on_change` is called after every change, under no lock.
  explicit GraphCache(std::function<void()> on_change) : on_change_(std::move(on_change)) {}

  void add_participant(const Gid& gid, std::string enclave);
  // Also forgets its nodes and endpoints.
  void remove_participant(const Gid& gid);
  // Returns when the participant is not, or no longer, known: true; at the deadline: false.
  bool wait_until_unknown(const Gid& gid, std::chrono::steady_clock::time_point deadline);
  void add_endpoint(const Gid& gid, Endpoint endpoint);
  void remove_endpoint(const Gid& gid);
  // What a participant has told of its nodes; replaces what was known.
  void update_nodes(const EntitiesInfo& info);

  // Changes of a participant of this process. Each returns what that participant now has to announce.
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
  // The topics that a node writes or reads; of all nodes of that name. Nothing if there is no such node.
  std::optional<Topics> topics_of_node(const std::string& namespace_, const std::string& name, Kind kind) const;

 private:
  using NodeInfo = rmw_dds_common::msg::NodeEntitiesInfo;

  struct Participant {
    std::string enclave;
    std::vector<NodeInfo> nodes;
  };

  // Null if no node is known to have it. Under the lock.
  const NodeInfo* owner_of(const Gid& endpoint, Kind kind) const;

  // Changes the nodes of an own participant under the lock, then tells of the change.
  template <typename Change>
  EntitiesInfo change_nodes(const Gid& gid, Change change);

  std::function<void()> on_change_;
  mutable std::mutex mutex_;
  std::condition_variable participant_removed_;
  std::map<Gid, Participant> participants_;
  std::map<Gid, Endpoint> endpoints_;
};

}  // namespace rmw_fastrtps
