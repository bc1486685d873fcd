// SPDX-License-Identifier: Apache-2.0
#include "graph/graph_cache.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace rmw_fastrtps {
namespace {

// Far more participants than can end between two messages of one of them.
constexpr std::size_t kRememberedParticipants = 1000;

template <typename Nodes>
auto find_node(Nodes& nodes, const std::string& namespace_, const std::string& name) {
  return std::find_if(nodes.begin(), nodes.end(),
                      [&](const auto& node) { return node.node_namespace == namespace_ && node.node_name == name; });
}

GraphCache::Kind opposite(GraphCache::Kind kind) {
  return kind == GraphCache::Kind::kWriter ? GraphCache::Kind::kReader : GraphCache::Kind::kWriter;
}

Gid gid_in(const rmw_dds_common::msg::Gid& message) {
  Gid gid;
  std::copy(message.data.begin(), message.data.end(), gid.begin());
  return gid;
}

template <typename NodeInfo>
auto& endpoints_of(NodeInfo& node, GraphCache::Kind kind) {
  return kind == GraphCache::Kind::kWriter ? node.writer_gid_seq : node.reader_gid_seq;
}

void tell_incompatible(const GraphCache::Endpoint& endpoint, std::size_t count) {
  if (endpoint.incompatible_type && count != 0) {
    endpoint.incompatible_type->update([count](rmw_incompatible_type_status_t& status) {
      status.total_count += static_cast<std::int32_t>(count);
      status.total_count_change += static_cast<std::int32_t>(count);
    });
  }
}

}  // namespace

void GraphCache::add_participant(const Gid& gid, std::string enclave) {
  {
    std::lock_guard lock(mutex_);
    std::erase(gone_, gid);
    participants_[gid].enclave = std::move(enclave);
  }
  on_change_();
}

void GraphCache::remove_participant(const Gid& gid) {
  {
    std::lock_guard lock(mutex_);
    participants_.erase(gid);
    gone_.push_back(gid);
    if (gone_.size() > kRememberedParticipants) {
      gone_.pop_front();
    }
    std::erase_if(endpoints_, [&](const auto& entry) {
      const bool of_participant = same_participant(entry.first, gid);
      if (of_participant) {
        leave_topic(entry.second);
      }
      return of_participant;
    });
  }
  on_change_();
}

void GraphCache::add_endpoint(const Gid& gid, Endpoint endpoint) {
  {
    std::lock_guard lock(mutex_);
    const auto found = endpoints_.find(gid);
    if (found == endpoints_.end()) {
      enter_topic(endpoints_.emplace(gid, std::move(endpoint)).first->second);
    } else {
      // Discovery also finds our own endpoints, and reports an endpoint again when it changes. Topic and type never
      // change.
      Endpoint& known = found->second;
      known.qos = endpoint.qos;
      if (endpoint.incompatible_type) {
        known.incompatible_type = std::move(endpoint.incompatible_type);
        tell_incompatible(known, incompatible_with(known).size());
      }
    }
  }
  on_change_();
}

void GraphCache::remove_endpoint(const Gid& gid) {
  {
    std::lock_guard lock(mutex_);
    if (const auto found = endpoints_.find(gid); found != endpoints_.end()) {
      leave_topic(found->second);
      endpoints_.erase(found);
    }
  }
  on_change_();
}

std::vector<const GraphCache::Endpoint*> GraphCache::incompatible_with(const Endpoint& endpoint) const {
  std::vector<const Endpoint*> incompatible;
  const auto topic = endpoints_by_topic_.find(endpoint.topic);
  if (topic == endpoints_by_topic_.end()) {
    return incompatible;
  }
  for (const auto& [type, others] : topic->second.of(opposite(endpoint.kind))) {
    if (type != endpoint.type) {
      incompatible.insert(incompatible.end(), others.begin(), others.end());
    }
  }
  return incompatible;
}

void GraphCache::enter_topic(const Endpoint& endpoint) {
  for (const Endpoint* other : incompatible_with(endpoint)) {
    tell_incompatible(*other, 1);
    tell_incompatible(endpoint, 1);
  }
  endpoints_by_topic_[endpoint.topic].of(endpoint.kind)[endpoint.type].insert(&endpoint);
}

void GraphCache::leave_topic(const Endpoint& endpoint) {
  const auto topic = endpoints_by_topic_.find(endpoint.topic);
  auto& by_type = topic->second.of(endpoint.kind);
  const auto of_type = by_type.find(endpoint.type);
  of_type->second.erase(&endpoint);
  if (of_type->second.empty()) {
    by_type.erase(of_type);
  }
  if (topic->second.empty()) {
    endpoints_by_topic_.erase(topic);
  }
}

void GraphCache::update_nodes(const EntitiesInfo& info) {
  Gid gid;
  std::copy(info.gid.data.begin(), info.gid.data.end(), gid.begin());
  {
    std::lock_guard lock(mutex_);
    if (std::find(gone_.begin(), gone_.end(), gid) != gone_.end()) {
      return;
    }
    auto& nodes = participants_[gid].nodes;
    nodes.assign(info.node_entities_info_seq.begin(), info.node_entities_info_seq.end());
  }
  on_change_();
}

template <typename Change>
GraphCache::EntitiesInfo GraphCache::change_nodes(const Gid& gid, Change change) {
  EntitiesInfo info;
  std::copy(gid.begin(), gid.end(), info.gid.data.begin());
  {
    std::lock_guard lock(mutex_);
    auto& nodes = participants_[gid].nodes;
    change(nodes);
    info.node_entities_info_seq.assign(nodes.begin(), nodes.end());
  }
  on_change_();
  return info;
}

GraphCache::EntitiesInfo GraphCache::add_node(const Gid& participant, const std::string& namespace_,
                                              const std::string& name) {
  return change_nodes(participant, [&](auto& nodes) {
    NodeInfo node;
    node.node_namespace = namespace_;
    node.node_name = name;
    nodes.push_back(std::move(node));
  });
}

GraphCache::EntitiesInfo GraphCache::remove_node(const Gid& participant, const std::string& namespace_,
                                                 const std::string& name) {
  return change_nodes(participant, [&](auto& nodes) {
    const auto node = find_node(nodes, namespace_, name);
    if (node != nodes.end()) {
      nodes.erase(node);
    }
  });
}

GraphCache::EntitiesInfo GraphCache::add_node_endpoint(const Gid& participant, const std::string& namespace_,
                                                       const std::string& name, Kind kind, const Gid& endpoint) {
  return change_nodes(participant, [&](auto& nodes) {
    const auto node = find_node(nodes, namespace_, name);
    if (node != nodes.end()) {
      rmw_dds_common::msg::Gid gid;
      std::copy(endpoint.begin(), endpoint.end(), gid.data.begin());
      endpoints_of(*node, kind).push_back(gid);
    }
  });
}

GraphCache::EntitiesInfo GraphCache::remove_node_endpoint(const Gid& participant, const std::string& namespace_,
                                                          const std::string& name, Kind kind, const Gid& endpoint) {
  return change_nodes(participant, [&](auto& nodes) {
    // Nothing else distinguishes nodes of the same name, so look in all of them.
    for (NodeInfo& node : nodes) {
      if (node.node_namespace == namespace_ && node.node_name == name) {
        std::erase_if(endpoints_of(node, kind),
                      [&](const auto& gid) { return std::equal(gid.data.begin(), gid.data.end(), endpoint.begin()); });
      }
    }
  });
}

std::size_t GraphCache::count(Kind kind, std::string_view topic) const {
  std::lock_guard lock(mutex_);
  std::size_t count = 0;
  if (const auto found = endpoints_by_topic_.find(topic); found != endpoints_by_topic_.end()) {
    for (const auto& [type, endpoints] : found->second.of(kind)) {
      count += endpoints.size();
    }
  }
  return count;
}

std::vector<GraphCache::Node> GraphCache::nodes() const {
  std::lock_guard lock(mutex_);
  std::vector<Node> result;
  for (const auto& [gid, participant] : participants_) {
    for (const NodeInfo& node : participant.nodes) {
      result.push_back({std::string(node.node_name), std::string(node.node_namespace), participant.enclave});
    }
  }
  return result;
}

GraphCache::Topics GraphCache::topics() const {
  std::lock_guard lock(mutex_);
  Topics result;
  for (const auto& [gid, endpoint] : endpoints_) {
    result[endpoint.topic].insert(endpoint.type);
  }
  return result;
}

std::vector<GraphCache::OwnedEndpoint> GraphCache::endpoints(Kind kind, std::string_view topic) const {
  std::lock_guard lock(mutex_);
  std::vector<OwnedEndpoint> result;
  for (const auto& [gid, endpoint] : endpoints_) {
    if (endpoint.kind == kind && endpoint.topic == topic) {
      OwnedEndpoint& owned = result.emplace_back(OwnedEndpoint{gid, endpoint, "", ""});
      if (const NodeInfo* node = owner_of(gid, kind)) {
        owned.node_name = node->node_name;
        owned.node_namespace = node->node_namespace;
      }
    }
  }
  return result;
}

std::optional<GraphCache::Topics> GraphCache::topics_of_node(const std::string& namespace_, const std::string& name,
                                                             Kind kind) const {
  std::lock_guard lock(mutex_);
  std::optional<Topics> result;
  for (const auto& [participant_gid, participant] : participants_) {
    for (const NodeInfo& node : participant.nodes) {
      if (node.node_namespace != namespace_ || node.node_name != name) {
        continue;
      }
      if (!result) {
        result.emplace();
      }
      for (const auto& message : endpoints_of(node, kind)) {
        // A node may announce an endpoint before discovery has found it.
        const auto endpoint = endpoints_.find(gid_in(message));
        if (endpoint != endpoints_.end()) {
          (*result)[endpoint->second.topic].insert(endpoint->second.type);
        }
      }
    }
  }
  return result;
}

const GraphCache::NodeInfo* GraphCache::owner_of(const Gid& endpoint, Kind kind) const {
  for (const auto& [gid, participant] : participants_) {
    if (!same_participant(gid, endpoint)) {
      continue;
    }
    for (const NodeInfo& node : participant.nodes) {
      const auto& gids = endpoints_of(node, kind);
      if (std::any_of(gids.begin(), gids.end(), [&](const auto& message) { return gid_in(message) == endpoint; })) {
        return &node;
      }
    }
  }
  return nullptr;
}

}  // namespace rmw_fastrtps
