// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/check/recorded_nodes.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_prefix.hpp"
#include "base/files/pipe.hpp"
#include "base/processes/spawn.hpp"

namespace launch {

namespace {

class Nodes {
 public:
  void add(const nlohmann::json& event) {
    const nlohmann::json& fields = event.at("fields");
    const auto of = [&](const char* field) { return fields.value(field, std::string()); };
    if (event.at("event") == "ros2:rcl_node_init") {
      const std::string space = of("namespace");
      add_node(event, (space == "/" ? "" : space) + "/" + of("node_name"));
      return;
    }
    const std::string name = fields.contains("topic_name") ? of("topic_name") : of("service_name");
    const auto newest = newest_.find(key(event));
    if (newest != newest_.end() && !name.empty()) {
      nodes_[newest->second].names.insert(name);
    }
  }

  std::vector<RecordedNode> take() { return std::move(nodes_); }

 private:
  using Key = std::tuple<std::string, std::int64_t, std::uint64_t>;  // host, process, handle

  static Key key(const nlohmann::json& event) {
    return {event.value("hostname", std::string()), event.value("vpid", std::int64_t{0}),
            event.at("fields").value("node_handle", std::uint64_t{0})};
  }

  // A trace that starts late tells of a node again; another node may get the handle of one that is gone.
  void add_node(const nlohmann::json& event, const std::string& name) {
    const auto [newest, is_new] = newest_.try_emplace(key(event), nodes_.size());
    if (is_new || nodes_[newest->second].name != name) {
      newest->second = nodes_.size();
      nodes_.push_back({name, event.value("procname", std::string()), {}});
    }
  }

  std::vector<RecordedNode> nodes_;
  std::map<Key, std::size_t> newest_;
};

Nodes nodes_of(const std::string& lines) {
  Nodes nodes;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    const nlohmann::json event =
        nlohmann::json::parse(lines.begin() + static_cast<std::ptrdiff_t>(begin),
                              lines.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (event.is_object() && event.contains("event")) {
      nodes.add(event);
    }
    begin = end + 1;
  }
  return nodes;
}

}  // namespace

std::optional<std::vector<RecordedNode>> read_recorded_nodes(const std::string& trace_directory) {
  Pipe pipe = make_pipe();
  const pid_t reader =
      spawn({.program = own_library_file("launch-trace-read"),
             .argv = {"launch check", trace_directory, "--format", "json", "--event", "ros2:rcl_*_init"},
             .descriptors = {{STDOUT_FILENO, pipe.write.get()}}});
  pipe.write.reset();
  const std::string lines = read_to_end(pipe.read);
  const int status = wait_for(reader);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return std::nullopt;
  }
  std::vector<RecordedNode> found = nodes_of(lines).take();
  if (found.empty()) {
    fmt::print(stderr, "{}",
               command_error("launch check", fmt::format("the trace '{}' has no nodes", trace_directory),
                             "launch --trace FILE records one"));
    return std::nullopt;
  }
  return found;
}

}  // namespace launch
