// SPDX-License-Identifier: Apache-2.0
// The picture of a graph: three columns, each with its boxes below one another. All lengths are pixels.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/quoted_text.hpp"
#include "programs/launch/graph/graph.hpp"

namespace launch {

namespace {

constexpr double kCharacter = 7.2;  // generous width of a character of text of kText pixels
constexpr int kText = 12;
constexpr double kLine = 16;    // height of a line
constexpr double kPadding = 8;  // inside a box
constexpr double kGap = 10;     // between the boxes of a column
constexpr double kIndent = 22;  // of an included file
constexpr double kColumnGap = 120;

struct Rectangle {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;

  double right() const { return x + width; }
  double middle() const { return y + height / 2; }
};

double width_of(const LaunchGraph::Box& box) {
  std::size_t longest = 0;
  for (const std::string& line : box.lines) {
    longest = std::max(longest, line.size());
  }
  return static_cast<double>(longest) * kCharacter + 2 * kPadding;
}

class Picture {
 public:
  explicit Picture(const LaunchGraph& graph) : graph_(graph) {
    place_files();
    begin_column();
    place_nodes();
    begin_column();
    for (const LaunchGraph::Box& topic : graph_.topics) {
      place(topic, 0, "topic");
    }
    for (const LaunchGraph::Edge& edge : graph_.edges) {
      draw(edge);
    }
  }

  std::string text() const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"{2}\">\n"
        "<style>rect{{fill:#fff;stroke:#444}} .file{{stroke:#999;stroke-dasharray:4 2}} "
        ".namespace{{fill:#f4f6fa;stroke:"
        "#bcd}} .machine{{fill:#fbfaf5;stroke:#987;stroke-width:2}} .topic{{stroke:none;fill:#eef4ff}} "
        "path{{fill:none;stroke:#aaa}} .remaps{{stroke:#36c}} "
        ".loads{{stroke:#444;stroke-dasharray:2 3}} .waits{{stroke:#444;stroke-dasharray:6 3}} "
        ".left-out{{stroke:#bbb;stroke-dasharray:4 3}} "
        ".handler{{fill:#fff6e6;stroke:#e90}} .handles{{stroke:#e90}} .note{{fill:#36c;font-size:10px}}</style>\n"
        "<defs><marker id=\"arrow\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" "
        "orient=\"auto\"><path d=\"M0 0L8 4L0 8z\" "
        "style=\"fill:#aaa;stroke:none\"/></marker></defs>\n{3}{4}{5}</svg>\n",
        widest_ + kGap, lowest_ + kGap, kText, backgrounds_, edges_, boxes_);
  }

 private:
  void begin_column() {
    column_ = widest_ + kColumnGap;
    next_ = kGap;
  }

  void place(const LaunchGraph::Box& box, double indent, std::string_view kind) {
    Rectangle place{column_ + indent, next_, width_of(box),
                    static_cast<double>(box.lines.size()) * kLine + 2 * kPadding - 4};
    boxes_ +=
        fmt::format("<rect class=\"{}\" x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" rx=\"{}\"/>\n",
                    box.left_out ? fmt::format("{} left-out", kind) : kind, place.x, place.y, place.width, place.height,
                    kind == "node" ? 12 : 2);
    for (std::size_t i = 0; i < box.lines.size(); ++i) {
      boxes_ += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\"{}>{}</text>\n", place.x + kPadding,
                            place.y + kPadding + kLine * static_cast<double>(i) + kText - 3,
                            i == 0 ? "" : " fill=\"#777\"", as_xml_text(box.lines[i]));
    }
    next_ += place.height + kGap;
    note_extent(place);
    places_.emplace(box.id, place);
  }

  void note_extent(const Rectangle& place) {
    widest_ = std::max(widest_, place.right());
    lowest_ = std::max(lowest_, place.y + place.height);
  }

  // Begins with the files that nothing includes. Below each file come the files that it includes, further to the right.
  void place_files() {
    std::map<std::string, std::vector<std::string>> included;  // by the includer
    std::map<std::string, bool> has_includer;
    for (const LaunchGraph::Edge& edge : graph_.edges) {
      if (edge.relation == LaunchGraph::Relation::kIncludes) {
        included[edge.from].push_back(edge.to);
        has_includer[edge.to] = true;
      }
    }
    std::map<std::string, const LaunchGraph::Box*> files;
    for (const auto& [path, file] : graph_.files) {
      files.emplace(file.id, &file);
    }
    const auto place_tree = [&](const auto& self, const std::string& id, double indent) -> void {
      if (places_.contains(id)) {
        return;
      }
      place(*files.at(id), indent, "file");
      for (const std::string& child : included[id]) {
        self(self, child, indent + kIndent);
      }
    };
    for (const auto& [id, file] : files) {
      if (!has_includer[id]) {
        place_tree(place_tree, id, 0);
      }
    }
    for (const auto& [id, file] : files) {
      place_tree(place_tree, id, 0);  // files that include one another in a circle
    }
  }

  void place_nodes() {
    const std::vector<std::string> machines = graph_.machines();
    const bool framed = machines.size() > 1 || (!machines.empty() && !machines.front().empty());
    for (const std::string& machine : machines) {
      if (!framed) {
        place_machine(machine);
        continue;
      }
      const double left = column_;
      const double begin = next_;
      next_ += kLine + kGap;
      column_ += kGap;
      const std::string outside = std::exchange(backgrounds_, "");
      const double inside = place_machine(machine);
      const std::string title = title_of_machine(machine);
      column_ = left;
      // Behind the frames of its namespaces.
      const std::string frames = std::exchange(backgrounds_, outside);
      frame("machine", title, begin, std::max(inside, kCharacter * static_cast<double>(title.size())));
      backgrounds_ += frames;
    }
    for (const LaunchGraph::Box& handler : graph_.handlers) {
      place(handler, 0, "handler");
    }
  }

  // The nodes and other processes of one machine. Returns how wide they are.
  double place_machine(const std::string& machine) {
    double widest = 0;
    for (const auto& [name_space, nodes] : graph_.nodes) {
      const bool framed = name_space != "/";
      const double begin = next_;
      double width = 0;
      for (const LaunchGraph::Box& node : nodes) {
        if (node.machine != machine) {
          continue;
        }
        if (width == 0) {
          next_ += framed ? kLine + kGap : 0;
          width = framed ? static_cast<double>(name_space.size()) * kCharacter : 0;
        }
        place(node, framed ? kGap : 0, "node");
        width = std::max(width, width_of(node));
      }
      if (framed && width > 0) {
        frame("namespace", name_space, begin, width);
        width += 2 * kGap;
      }
      widest = std::max(widest, width);
    }
    for (const LaunchGraph::Box& process : graph_.processes) {
      if (process.machine == machine) {
        place(process, 0, "process");
        widest = std::max(widest, width_of(process));
      }
    }
    return widest;
  }

  // Around what was placed in the column since `begin`.
  void frame(std::string_view kind, std::string_view title, double begin, double width) {
    const Rectangle around{column_, begin, width + 2 * kGap, next_ - begin};
    backgrounds_ += fmt::format(
        "<rect class=\"{}\" x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\"/>\n"
        "<text x=\"{:.0f}\" y=\"{:.0f}\" font-weight=\"bold\">{}</text>\n",
        kind, around.x, around.y, around.width, around.height, around.x + kGap, around.y + kLine, as_xml_text(title));
    note_extent(around);
    next_ += kGap;
  }

  void draw(const LaunchGraph::Edge& edge) {
    const auto from = places_.find(edge.from);
    const auto to = places_.find(edge.to);
    if (from == places_.end() || to == places_.end()) {
      return;
    }
    const Rectangle& a = from->second;
    const Rectangle& b = to->second;
    switch (edge.relation) {
      case LaunchGraph::Relation::kIncludes:
        edges_ += fmt::format("<path d=\"M{:.0f} {:.0f}V{:.0f}H{:.0f}\" marker-end=\"url(#arrow)\"/>\n", a.x + kGap,
                              a.y + a.height, b.middle(), b.x);
        break;
      case LaunchGraph::Relation::kLoads:
        bow(a, b, "class=\"loads\"", edge.label);
        break;
      case LaunchGraph::Relation::kWaitsFor:
        bow(a, b, "class=\"waits\" marker-end=\"url(#arrow)\"", edge.label);
        break;
      case LaunchGraph::Relation::kHandles:
      case LaunchGraph::Relation::kStarts:
        bow(a, b, "class=\"handles\" marker-end=\"url(#arrow)\"", edge.label);
        break;
      case LaunchGraph::Relation::kAsksFor:
      case LaunchGraph::Relation::kRemaps: {
        const bool remaps = edge.relation == LaunchGraph::Relation::kRemaps;
        const double half = (a.right() + b.x) / 2;
        edges_ += fmt::format("<path {} d=\"M{:.0f} {:.0f}C{:.0f} {:.0f} {:.0f} {:.0f} {:.0f} {:.0f}\"/>\n",
                              remaps ? "class=\"remaps\"" : "marker-end=\"url(#arrow)\"", a.right(), a.middle(), half,
                              a.middle(), half, b.middle(), b.x, b.middle());
        if (!edge.label.empty()) {
          edges_ += fmt::format("<text class=\"note\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", b.x - 70, b.middle() - 3,
                                as_xml_text(edge.label));
        }
        break;
      }
    }
  }

  // A line between two boxes of the middle column.
  void bow(const Rectangle& a, const Rectangle& b, std::string_view style, const std::string& note) {
    const double out = std::max(a.right(), b.right()) + 30;
    widest_ = std::max(widest_, out + static_cast<double>(note.size()) * kCharacter);
    edges_ += fmt::format("<path {} d=\"M{:.0f} {:.0f}C{:.0f} {:.0f} {:.0f} {:.0f} {:.0f} {:.0f}\"/>\n", style,
                          a.right(), a.middle(), out, a.middle(), out, b.middle(), b.right(), b.middle());
    if (!note.empty()) {
      edges_ += fmt::format("<text class=\"note\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", out - 6,
                            (a.middle() + b.middle()) / 2, as_xml_text(note));
    }
  }

  const LaunchGraph& graph_;
  std::map<std::string, Rectangle> places_;
  double column_ = kGap;  // left border of the column
  double next_ = kGap;    // where the next box of the column begins
  double widest_ = 0;
  double lowest_ = 0;
  std::string backgrounds_;
  std::string boxes_;
  std::string edges_;
};

}  // namespace

std::string graph_as_svg(const LaunchGraph& graph) {
  return Picture(graph).text();
}

}  // namespace launch
