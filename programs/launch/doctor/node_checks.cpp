// SPDX-License-Identifier: Apache-2.0
// Which nodes of this machine cannot hear each other, and why: their middleware, domain, range of discovery, network
// and shared memory.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <sstream>

#include "programs/launch/doctor/machine.hpp"

namespace launch {
namespace {

constexpr const char* kNodes = "nodes";

struct Node {
  std::string label;       // "talker (12)"
  std::string middleware;  // "rmw_zenoh_cpp"
  std::map<std::string, std::string> environment;
  std::string user;
  std::string network;        // the namespace
  std::string shared_memory;  // the file system of /dev/shm
  bool is_of_this_stack = false;

  std::string variable(const std::string& name, const std::string& fallback = {}) const {
    const auto found = environment.find(name);
    return found == environment.end() || found->second.empty() ? fallback : found->second;
  }
  std::string domain() const { return variable("ROS_DOMAIN_ID", "0"); }
  bool is_dds() const { return middleware != "rmw_zenoh_cpp"; }
};

// The strings of a file in which a zero byte ends each.
std::vector<std::string> strings(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream all(text);
  for (std::string each; std::getline(all, each, '\0');) {
    found.push_back(each);
  }
  return found;
}

// Not what several middlewares share, and not the types of its messages
// (librmw_dds_common__rosidl_typesupport_introspection_cpp.so).
bool is_middleware(const std::string& name) {
  const bool ends_as_one = name.ends_with("_cpp") || name == "rmw_connextdds";
  return ends_as_one && name != "rmw_fastrtps_shared_cpp" && name.find("__") == std::string::npos;
}

// "" if the process has none. rmw_implementation only loads the others.
std::string middleware_in(const std::string& maps, bool& is_of_this_stack) {
  std::istringstream lines(maps);
  bool has_own = false;
  bool has_dds = false;
  for (std::string line; std::getline(lines, line);) {
    const std::string file = line.substr(line.find_last_of("/ ") + 1);
    if (file.starts_with("librmw_") && file.find(".so") != std::string::npos) {
      const std::string name = file.substr(3, file.find(".so") - 3);
      if (is_middleware(name)) {
        return name;
      }
    }
    has_own = has_own || file == "librmw.so";
    has_dds = has_dds || file.starts_with("libfastrtps.so") || file.starts_with("libfastdds.so");
  }
  is_of_this_stack = has_own && has_dds;
  return is_of_this_stack ? "rmw_fastrtps_cpp" : "";
}

std::string link_target(const std::filesystem::path& path) {
  std::error_code unknown;
  return std::filesystem::read_symlink(path, unknown).string();
}

std::optional<Node> node_of(const Machine& machine, const std::string& pid) {
  const std::string process = "proc/" + pid + "/";
  Node node;
  node.middleware = middleware_in(machine.text(process + "maps"), node.is_of_this_stack);
  if (node.middleware.empty()) {
    return std::nullopt;
  }
  std::string name;
  for (const std::string& word : strings(machine.text(process + "cmdline"))) {
    constexpr std::string_view kName = "__node:=";
    if (name.empty()) {
      name = word.substr(word.find_last_of('/') + 1);
    } else if (const std::size_t at = word.find(kName); at != std::string::npos) {
      name = word.substr(at + kName.size());
    }
  }
  node.label = fmt::format("{} ({})", name, pid);
  for (const std::string& setting : strings(machine.text(process + "environ"))) {
    const std::size_t equals = setting.find('=');
    node.environment.emplace(setting.substr(0, equals), equals == std::string::npos ? "" : setting.substr(equals + 1));
  }
  std::istringstream status(machine.text(process + "status"));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Uid:")) {
      std::istringstream(line.substr(4)) >> node.user;
    }
  }
  node.network = link_target(machine.path(process + "ns/net"));
  struct stat place {};
  if (::stat(machine.path(process + "root/dev/shm").c_str(), &place) == 0) {
    node.shared_memory = fmt::format("{}:{}", place.st_dev, place.st_ino);
  }
  return node;
}

std::vector<Node> nodes_of(const Machine& machine) {
  std::vector<Node> nodes;
  for (const std::string& pid : machine.entries("proc")) {
    if (pid.find_first_not_of("0123456789") == std::string::npos) {
      if (std::optional<Node> node = node_of(machine, pid)) {
        nodes.push_back(std::move(*node));
      }
    }
  }
  return nodes;
}

using Groups = std::map<std::string, std::vector<std::string>>;  // what they have in common, labels

Groups grouped(const std::vector<Node>& nodes, const std::function<std::string(const Node&)>& key) {
  Groups groups;
  for (const Node& node : nodes) {
    groups[key(node)].push_back(node.label);
  }
  return groups;
}

// "rmw_fastrtps_cpp: talker (12); rmw_zenoh_cpp: listener (13), map (14)"
std::string text_of(const Groups& groups) {
  std::vector<std::string> texts;
  for (const auto& [key, labels] : groups) {
    constexpr std::size_t kMost = 4;
    std::vector<std::string> shown(labels.begin(), labels.begin() + std::min(labels.size(), kMost));
    if (labels.size() > kMost) {
      shown.push_back(fmt::format("{} more", labels.size() - kMost));
    }
    texts.push_back(fmt::format("{}: {}", key, fmt::join(shown, ", ")));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

MachineCheck check(const char* name, bool ok, std::string found, std::string advice) {
  return {kNodes, name, ok, std::move(found), ok ? "" : std::move(advice)};
}

MachineCheck check_middleware(const std::vector<Node>& nodes) {
  const Groups groups = grouped(nodes, [](const Node& node) { return node.middleware; });
  const bool all_dds = std::all_of(nodes.begin(), nodes.end(), [](const Node& node) { return node.is_dds(); });
  const std::string effect =
      all_dds ? ". Topics pass between them, services and the graph not always" : ". They do not hear each other";
  return check("middleware", groups.size() == 1, text_of(groups) + (groups.size() == 1 ? "" : effect),
               "give all nodes the same RMW_IMPLEMENTATION");
}

MachineCheck check_domains(const std::vector<Node>& nodes) {
  const Groups groups = grouped(nodes, [](const Node& node) { return node.domain(); });
  return check("domains", groups.size() == 1,
               text_of(groups) + (groups.size() == 1 ? "" : ". They do not hear each other"),
               "give the nodes that belong together the same ROS_DOMAIN_ID");
}

// Nodes of one machine hear each other, unless one hears nobody, or only some of them keep to the loopback interface.
MachineCheck check_range(const std::vector<Node>& nodes) {
  const Groups groups = grouped(nodes, [](const Node& node) {
    if (node.variable("ROS_AUTOMATIC_DISCOVERY_RANGE") == "OFF" && node.variable("ROS_STATIC_PEERS").empty()) {
      return "ROS_AUTOMATIC_DISCOVERY_RANGE=OFF";
    }
    return node.variable("ROS_LOCALHOST_ONLY") == "1" ? "ROS_LOCALHOST_ONLY=1" : "any other node of this machine";
  });
  const bool hears_nobody = groups.contains("ROS_AUTOMATIC_DISCOVERY_RANGE=OFF");
  const bool ok = groups.size() == 1 && !hears_nobody;
  return check("discovery", ok,
               text_of(groups) + (ok             ? ""
                                  : hears_nobody ? ". Whoever has OFF finds nobody"
                                                 : ". They may not find each other"),
               "give all nodes the same range, SUBNET or LOCALHOST");
}

MachineCheck check_networks(const std::vector<Node>& nodes) {
  const Groups networks = grouped(nodes, [](const Node& node) { return node.network; });
  if (networks.size() > 1) {
    return check("networks", false,
                 text_of(networks) + ". Nodes of different networks find each other only by a bridge between them",
                 "run containers with --network=host and --ipc=host, or name peers in ROS_STATIC_PEERS");
  }
  const Groups memories = grouped(nodes, [](const Node& node) { return node.shared_memory; });
  const bool all_adapt =
      std::all_of(nodes.begin(), nodes.end(), [](const Node& node) { return node.is_of_this_stack; });
  if (memories.size() > 1) {
    std::vector<std::string> sides;
    for (const auto& [memory, labels] : memories) {
      sides.push_back(fmt::format("{}", fmt::join(labels, ", ")));
    }
    return check("networks", all_adapt,
                 fmt::format("one network, and a /dev/shm each: {}. {}", fmt::join(sides, "; "),
                             all_adapt ? "Nodes of this stack use UDP then"
                                       : "Nodes find each other, and their messages are lost"),
                 "run containers with --ipc=host, or set FASTDDS_BUILTIN_TRANSPORTS=UDPv4");
  }
  return check("networks", true, "all are in one network and share /dev/shm", "");
}

MachineCheck check_users(const std::vector<Node>& nodes) {
  const Groups groups = grouped(nodes, [](const Node& node) { return "user " + node.user; });
  const bool all_adapt = std::all_of(nodes.begin(), nodes.end(), [](const Node& node) {
    return node.is_of_this_stack || node.middleware != "rmw_fastrtps_cpp";
  });
  const bool ok = groups.size() == 1 || all_adapt;
  return check("users", ok,
               text_of(groups) + (ok ? "" : ". They cannot open each other's shared memory, so messages are lost"),
               "run them as one user, or set FASTDDS_BUILTIN_TRANSPORTS=UDPv4");
}

// A check of nodes that may hear each other. Where one domain fails, the others are not shown.
MachineCheck check_each_domain(const std::vector<Node>& nodes, MachineCheck (*check_domain)(const std::vector<Node>&)) {
  std::map<std::string, std::vector<Node>> domains;
  for (const Node& node : nodes) {
    domains[node.domain()].push_back(node);
  }
  if (domains.size() == 1) {
    return check_domain(nodes);
  }
  std::vector<std::string> right;
  std::vector<std::string> wrong;
  MachineCheck all;
  for (const auto& [domain, members] : domains) {
    MachineCheck one = check_domain(members);
    (one.ok ? right : wrong).push_back(fmt::format("domain {}: {}", domain, one.found));
    if (all.name.empty() || (all.ok && !one.ok)) {
      all = std::move(one);
    }
  }
  all.found = fmt::format("{}", fmt::join(wrong.empty() ? right : wrong, "; "));
  return all;
}

}  // namespace

std::vector<MachineCheck> check_nodes(const Machine& machine) {
  std::vector<Node> nodes = nodes_of(machine);
  if (nodes.empty()) {
    return {check("middleware", true, "no node of this machine can be seen", "")};
  }
  return {check_middleware(nodes), check_domains(nodes), check_each_domain(nodes, check_range),
          check_each_domain(nodes, check_networks), check_each_domain(nodes, check_users)};
}

}  // namespace launch
