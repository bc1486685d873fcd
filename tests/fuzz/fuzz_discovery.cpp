// SPDX-License-Identifier: Apache-2.0
// What other processes announce: messages on ros_discovery_info, the user data of participants and endpoints, and type
// hashes in it. The input is a list of announcements: a byte for the kind, one for the sender, two for the length.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "fastcdr_versions/cdr.hpp"
#include "graph/graph_cache.hpp"
#include "participant/user_data.hpp"
#include "rosidl_runtime_c/type_hash.h"
#include "rosidl_typesupport_cpp/message_type_support.hpp"
#include "rosidl_typesupport_fastrtps_cpp/find_callbacks.hpp"

namespace {

using rmw_fastrtps::Gid;
using rmw_fastrtps::GraphCache;
using rmw_fastrtps::user_data_value;

Gid gid_of(std::uint8_t sender) {
  Gid gid{};
  gid.back() = sender;
  return gid;
}

void told_nodes(GraphCache& graph, std::string_view bytes) {
  const auto& type = *rosidl_typesupport_fastrtps_cpp::find_callbacks(
      rosidl_typesupport_cpp::get_message_type_support_handle<GraphCache::EntitiesInfo>());
  std::vector<char> copy(bytes.begin(), bytes.end());
  eprosima::fastcdr::FastBuffer buffer(copy.data(), copy.size());
  eprosima::fastcdr::Cdr cdr = fastcdr_versions::plain_cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS);
  GraphCache::EntitiesInfo info;
  if (type.cdr_deserialize(cdr, &info)) {
    graph.update_nodes(info);
  }
}

void check_hash(const std::string& text) {
  rosidl_type_hash_t hash;
  if (rosidl_parse_type_hash_string(text.c_str(), &hash) != RCUTILS_RET_OK) {
    return;
  }
  char* written = nullptr;
  if (rosidl_stringify_type_hash(&hash, rcutils_get_default_allocator(), &written) != RCUTILS_RET_OK ||
      text.size() != std::strlen(written)) {
    std::abort();
  }
  std::free(written);
}

void announce(GraphCache& graph, std::uint8_t kind, std::uint8_t sender, std::string_view text) {
  switch (kind % 6) {
    case 0:
      return graph.add_participant(gid_of(sender), user_data_value(text, "enclave"));
    case 1:
      return graph.remove_participant(gid_of(sender));
    case 2: {
      const std::string name(text.substr(0, text.find('\n')));
      const std::string hash = user_data_value(text, "typehash");
      check_hash(hash);
      const auto side = (sender & 1) == 0 ? GraphCache::Kind::kWriter : GraphCache::Kind::kReader;
      return graph.add_endpoint(gid_of(sender), {side, name, std::string(text), {}, nullptr, hash});
    }
    case 3:
      return graph.remove_endpoint(gid_of(sender));
    default:
      return told_nodes(graph, text);
  }
}

void ask(const GraphCache& graph) {
  for (const GraphCache::Node& node : graph.nodes()) {
    for (const auto kind : {GraphCache::Kind::kWriter, GraphCache::Kind::kReader}) {
      if (!graph.topics_of_node(node.namespace_, node.name, kind)) {
        std::abort();  // a node that is listed is there
      }
    }
  }
  for (const auto& [topic, types] : graph.topics()) {
    const std::size_t writers = graph.endpoints(GraphCache::Kind::kWriter, topic).size();
    const std::size_t readers = graph.endpoints(GraphCache::Kind::kReader, topic).size();
    if (writers != graph.count(GraphCache::Kind::kWriter, topic) ||
        readers != graph.count(GraphCache::Kind::kReader, topic) || writers + readers == 0 || types.empty()) {
      std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  GraphCache graph([] {});
  const std::uint8_t* const end = data + size;
  while (end - data >= 4) {
    const std::size_t length = std::min<std::size_t>(data[2] | data[3] << 8, static_cast<std::size_t>(end - data) - 4);
    announce(graph, data[0], data[1], {reinterpret_cast<const char*>(data) + 4, length});
    data += 4 + length;
  }
  ask(graph);
  return 0;
}
