#include "launcher/cli/graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>

#include "launcher/base/diagnostic.hpp"

namespace launch {

namespace {

std::string as_id(std::string_view text) {
  std::string result = "\"";
  for (const char character : text) {
    if (character == '\n') {
      result += "\\n";
      continue;
    }
    if (character == '"' || character == '\\') {
      result += '\\';
    }
    result += character;
  }
  return result + "\"";
}

std::string joined(const std::string& name_space, const std::string& name) {
  const std::string base = name_space.empty() || name_space.front() != '/' ? "/" + name_space : name_space;
  return base == "/" ? "/" + name : base + "/" + name;
}

// The remaps of names in the arguments of a node: `-r from:=to`, without those of its own name and namespace.
std::vector<std::pair<std::string, std::string>> remaps_of(const std::vector<std::string>& argv) {
  std::vector<std::pair<std::string, std::string>> remaps;
  for (std::size_t i = 1; i < argv.size(); ++i) {
    const std::size_t separator = argv[i].find(":=");
    if ((argv[i - 1] == "-r" || argv[i - 1] == "--remap") && separator != std::string::npos &&
        argv[i].find("__n") == std::string::npos) {
      remaps.emplace_back(argv[i].substr(0, separator), argv[i].substr(separator + 2));
    }
  }
  return remaps;
}

class Drawing {
 public:
  explicit Drawing(const LaunchPlan& plan) { add(plan); }

  std::string text() const;

 private:
  void add(const LaunchPlan& plan) {
    std::set<std::size_t> nodes;
    for (const NodeDescription& node : plan.nodes) {
      nodes.insert(node.process);
      const ProcessSpec& spec = plan.processes[node.process];
      add_node(joined(node.name_space.value_or(""), node.name.value_or(spec.name)), node.name_space.value_or("/"),
               node.package ? fmt::format("{} {}", *node.package, node.executable) : node.executable, spec.origin,
               remaps_of(spec.argv));
    }
    for (std::size_t i = 0; i < plan.processes.size(); ++i) {
      if (!nodes.contains(i)) {
        const std::string id = fmt::format("process {}", processes_++);
        outside_ += fmt::format("  {} [shape=box, label={}];\n", as_id(id), as_id(plan.processes[i].name));
        asked_by(plan.processes[i].origin, id);
      }
    }
    for (const LoadRequest& request : plan.loads) {
      for (const ComposableNode& component : request.nodes) {
        const std::string id = add_node(
            joined(component.name_space, component.name), component.name_space.empty() ? "/" : component.name_space,
            fmt::format("{} in {}", component.plugin, request.target), component.origin, component.remaps);
        edges_ +=
            fmt::format("  {} -> {} [style=dotted, label=\"loads\"];\n", as_id(joined("", request.target)), as_id(id));
      }
    }
  }

  std::string add_node(const std::string& full_name, std::string name_space, const std::string& program,
                       const SourceRange& origin, const std::vector<std::pair<std::string, std::string>>& remaps) {
    // Several nodes of one name are drawn as several: that is what one wants to see.
    std::string id = full_name;
    for (int again = 2; !ids_.insert(id).second; ++again) {
      id = fmt::format("{} ({})", full_name, again);
    }
    if (name_space.empty() || name_space.front() != '/') {
      name_space = "/" + name_space;
    }
    namespaces_[name_space] += fmt::format("  {} [label={}];\n", as_id(id), as_id(full_name + "\n" + program));
    asked_by(origin, id);
    for (const auto& [from, to] : remaps) {
      topics_.insert(to);
      edges_ +=
          fmt::format("  {} -> {} [dir=none, color=blue, label={}];\n", as_id(id), as_id("topic " + to), as_id(from));
    }
    return id;
  }

  void asked_by(const SourceRange& origin, const std::string& id) {
    if (origin) {
      edges_ += fmt::format("  {} -> {} [color=gray];\n", as_id(add_file(*origin.file)), as_id(id));
    }
  }

  // Files are told apart by their path; one that is included from several places has several arrows to it.
  std::string add_file(const SourceFile& file) {
    const std::string id = "file " + file.path();
    const std::string name = std::filesystem::path(file.path()).filename().string();
    files_.emplace(file.path(), fmt::format("  {} [shape=note, color=gray, label={}];\n", as_id(id), as_id(name)));
    if (const SourceRange& from = file.included_from(); from) {
      const std::string includer = add_file(*from.file);
      if (includes_.emplace(includer, id).second) {
        edges_ += fmt::format("  {} -> {} [color=gray, label=\"includes\"];\n", as_id(includer), as_id(id));
      }
    }
    return id;
  }

  std::map<std::string, std::string> files_;       // path, its line
  std::map<std::string, std::string> namespaces_;  // name, the lines of its nodes
  std::size_t processes_ = 0;
  std::string outside_;
  std::set<std::string> topics_;
  std::set<std::string> ids_;
  std::set<std::pair<std::string, std::string>> includes_;
  std::string edges_;
};

std::string Drawing::text() const {
  std::string text =
      "digraph launch {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n  edge [fontname=\"sans-serif\"];\n";
  for (const auto& [path, line] : files_) {
    text += line;
  }
  std::size_t number = 0;
  for (const auto& [name_space, lines] : namespaces_) {
    if (name_space == "/") {
      text += lines;
    } else {
      text += fmt::format("  subgraph cluster_{} {{\n  label={};\n{}  }}\n", number++, as_id(name_space), lines);
    }
  }
  text += outside_;
  for (const std::string& topic : topics_) {
    text += fmt::format("  {} [shape=plaintext, label={}];\n", as_id("topic " + topic), as_id(topic));
  }
  return text + edges_ + "}\n";
}

}  // namespace

std::string plan_as_dot(const LaunchPlan& plan) {
  return Drawing(plan).text();
}

std::string dot_as_svg(const std::string& dot) {
  std::string directory = (std::filesystem::temp_directory_path() / "launch-graph-XXXXXX").string();
  if (::mkdtemp(directory.data()) == nullptr) {
    throw LaunchError("can't create a temporary directory for the graph", {});
  }
  const auto remove = [](std::string* path) {
    std::error_code ignored;
    std::filesystem::remove_all(*path, ignored);
  };
  const std::unique_ptr<std::string, decltype(remove)> removed(&directory, remove);
  const std::string path = directory + "/graph.dot";
  std::ofstream(path) << dot;

  std::string svg;
  const auto close = [](std::FILE* pipe) { ::pclose(pipe); };
  std::unique_ptr<std::FILE, decltype(close)> pipe(
      ::popen(fmt::format("dot -Tsvg '{}' 2>/dev/null", path).c_str(), "r"), close);
  char buffer[4096];
  while (pipe != nullptr) {
    const std::size_t size = std::fread(buffer, 1, sizeof buffer, pipe.get());
    if (size == 0) {
      break;
    }
    svg.append(buffer, size);
  }
  if (svg.empty()) {
    throw LaunchError("the graph can't be drawn: Graphviz's dot can't be run", {},
                      "install the package graphviz, or take the DOT output");
  }
  return svg;
}

}  // namespace launch
