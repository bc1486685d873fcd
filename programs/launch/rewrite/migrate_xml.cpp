// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/migrate_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "programs/launch/rewrite/xml_pieces.hpp"

namespace launch {

namespace {

struct NewAttribute {
  std::string name;
  std::string value;  // as it stands between quotes
  char quote = '"';
};

struct NewTag {
  std::string name;
  std::vector<NewAttribute> attributes;
  std::string before;  // elements before it
  std::string inside;  // elements at its begin
  std::string behind;  // what closes `before`

  NewAttribute* find(std::string_view wanted) {
    const auto found =
        std::find_if(attributes.begin(), attributes.end(), [&](const auto& each) { return each.name == wanted; });
    return found == attributes.end() ? nullptr : &*found;
  }
  std::optional<NewAttribute> take(std::string_view wanted) {
    NewAttribute* const found = find(wanted);
    if (found == nullptr) {
      return std::nullopt;
    }
    NewAttribute taken = std::move(*found);
    attributes.erase(attributes.begin() + (found - attributes.data()));
    return taken;
  }
  void rename(std::string_view old, std::string_view fresh) {
    NewAttribute* const found = find(old);
    if (found != nullptr && find(fresh) == nullptr) {
      found->name = fresh;
    }
  }
};

struct Rename {
  std::string_view tag;  // empty: any
  std::string_view old;
  std::string_view fresh;
};

// Names of ROS 1, and names that only Python has or that earlier releases had.
constexpr std::array<Rename, 14> kAttributes = {{
    {"node", "type", "exec"},
    {"node", "ns", "namespace"},
    {"node", "node-name", "name"},
    {"node", "node_name", "name"},
    {"node", "node_namespace", "namespace"},
    {"node", "node_executable", "exec"},
    {"arg", "doc", "description"},
    {"arg", "desc", "description"},
    {"arg", "default_value", "default"},
    {"", "package", "pkg"},
    {"", "executable", "exec"},
    {"", "arguments", "args"},
    {"", "ros_arguments", "ros_args"},
    {"", "prefix", "launch-prefix"},
}};

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kTags = {{
    {"push-ros-namespace", "push_ros_namespace"},
    {"declare_argument", "arg"},
    {"declare_launch_argument", "arg"},
    {"set_remapping", "set_remap"},
}};

// What ROS 2 does without.
constexpr std::array<std::string_view, 3> kGone = {"clear_params", "pass_all_args", "subst_value"};

class Migration {
 public:
  explicit Migration(const std::shared_ptr<const SourceFile>& file) : file_(file), pieces_(xml_pieces(file->text())) {}

  Migrated migrate() {
    std::size_t at = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const XmlPiece& piece = pieces_[i];
      const std::size_t begin = offset(piece.text);
      result_.text += file_->text().substr(at, begin - at);
      at = begin + piece.text.size();
      switch (piece.kind) {
        case XmlPiece::Kind::kStart:
        case XmlPiece::Kind::kEmpty:
          tag(piece, i + 1 < pieces_.size() ? &pieces_[i + 1] : nullptr);
          break;
        case XmlPiece::Kind::kEnd:
          result_.text += fmt::format("</{}>{}", open_.back().name, open_.back().behind);
          open_.pop_back();
          break;
        default:
          result_.text += piece.text;
      }
    }
    result_.text += file_->text().substr(std::min(at, file_->text().size()));
    return std::move(result_);
  }

 private:
  struct Open {
    std::string given;
    std::string name;
    std::string behind;
  };

  std::size_t offset(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - file_->text().data());
  }
  SourceRange range(std::string_view part) const {
    const auto begin = static_cast<std::uint32_t>(offset(part));
    return {file_, begin, begin + static_cast<std::uint32_t>(part.size())};
  }

  void left(std::string_view part, std::string message, std::string help) {
    result_.left.push_back({Severity::kWarning, std::move(message), range(part), std::move(help)});
  }

  bool in(std::string_view tag) const { return !open_.empty() && open_.back().given == tag; }

  void tag(const XmlPiece& piece, const XmlPiece* next) {
    NewTag made{.name = std::string(piece.name)};
    for (const XmlPiece::Attribute& attribute : piece.attributes) {
      made.attributes.push_back({std::string(attribute.name), substitutions(attribute.value), attribute.quote});
    }
    for (const auto& [old, fresh] : kTags) {
      made.name = made.name == old ? std::string(fresh) : made.name;
    }
    for (const Rename& rename : kAttributes) {
      if (rename.tag.empty() || rename.tag == made.name) {
        made.rename(rename.old, rename.fresh);
      }
    }
    for (const std::string_view gone : kGone) {
      made.take(gone);
    }
    const bool has_content =
        next != nullptr && piece.kind == XmlPiece::Kind::kStart && next->kind == XmlPiece::Kind::kText;
    by_tag(piece, made, has_content);
    const bool is_open = piece.kind == XmlPiece::Kind::kStart;
    write(made, is_open);
    if (is_open) {
      open_.push_back({std::string(piece.name), made.name, made.behind});
    }
  }

  void by_tag(const XmlPiece& piece, NewTag& made, bool has_content) {
    const bool in_node = in("node");
    if (made.name == "node") {
      node(piece, made);
    } else if (made.name == "arg" && !in("include") && made.find("value") != nullptr) {
      made.name = "let";  // a constant
      made.take("description");
    } else if (made.name == "param") {
      param(piece, made, in_node);
    } else if (made.name == "rosparam") {
      rosparam(piece, made, in_node, has_content);
    } else if (made.name == "remap" && !in_node && !in("composable_node") && !in("node_container")) {
      made.name = "set_remap";
    } else if (made.name == "env" && !in_node && !in("executable") && !in("include")) {
      made.name = "set_env";
    } else if (made.name == "group") {
      if (const auto ns = made.take("ns")) {
        made.inside = fmt::format("<push_ros_namespace namespace=\"{}\"/>", ns->value);
      }
    } else if (made.name == "include") {
      if (const auto ns = made.take("ns")) {
        made.before = fmt::format("<group><push_ros_namespace namespace=\"{}\"/>", ns->value);
        made.behind = "</group>";
      }
    } else if (made.name == "test" || made.name == "machine") {
      left(piece.name, fmt::format("'{}' is not known to ROS 2", made.name),
           made.name == "test" ? "tests are programs of their own, or files for launch test (docs/testing.md)"
                               : "launch has machines with a command that leads there (docs/machines.md)");
    }
  }

  void node(const XmlPiece& piece, NewTag& made) {
    if (const auto required = made.take("required"); required && required->value != "false") {
      if (required->value == "true" && made.find("on_exit") == nullptr) {
        made.attributes.push_back({"on_exit", "shutdown"});
      } else {
        left(piece.name, "'required' depends on an argument", "write on_exit=\"shutdown\" on a node with a condition");
      }
    }
    if (made.take("machine")) {
      left(piece.name, "'machine' is not known to ROS 2", "start a launch file on each machine");
    }
    if (NewAttribute* const cwd = made.find("cwd");
        cwd != nullptr && (cwd->value == "node" || cwd->value == "ROS_HOME")) {
      left(piece.name, fmt::format("'cwd=\"{}\"' is not known to ROS 2", cwd->value),
           "write the path of the directory");
      made.take("cwd");
    }
  }

  void param(const XmlPiece& piece, NewTag& made, bool in_node) {
    if (const auto command = made.take("command")) {
      made.attributes.push_back({"value", command->value.find('\'') == std::string::npos
                                              ? fmt::format("$(command '{}')", command->value)
                                              : fmt::format("$(command {0}{1}{0})", "&quot;", command->value)});
    }
    if (const auto file = made.take("textfile")) {
      made.attributes.push_back({"value", fmt::format("$(file-content {})", file->value)});
    }
    if (made.take("binfile")) {
      left(piece.name, "'binfile' is not known to ROS 2", "let the node read the file");
    }
    if (NewAttribute* const type = made.find("type"); type != nullptr) {
      type->value = type->value == "double" ? "float" : type->value == "string" ? "str" : type->value;
      if (type->value == "yaml") {
        made.take("type");
      }
    }
    if (NewAttribute* const name = made.find("name"); name != nullptr) {
      name->value.erase(0, name->value.starts_with('~') ? 1 : 0);
      std::replace(name->value.begin() + (name->value.starts_with('/') ? 1 : 0), name->value.end(), '/', '.');
      if (!in_node && name->value.starts_with('/')) {
        name->value.erase(0, 1);
      }
    }
    const bool in_package = in("composable_node") || in("node_container") || in("lifecycle_node") || in("param");
    if (!in_node && !in_package) {
      made.name = "set_parameter";
      made.take("type");
      left(piece.name, "a parameter of the master is one of each node of its scope in ROS 2",
           "put it into the node that reads it, if only one does");
    }
  }

  void rosparam(const XmlPiece& piece, NewTag& made, bool in_node, bool has_content) {
    const auto command = made.take("command");
    const auto file = made.take("file");
    const auto ns = made.take("ns");
    const auto param = made.take("param");
    if (has_content || !file || (command && command->value != "load") || ns || param) {
      left(piece.name, "this 'rosparam' has no form in ROS 2",
           has_content ? "write <param name=\"…\" value=\"…\"/> for each parameter, or a parameter file"
                       : "write a parameter file with the name of the node and ros__parameters");
      return;
    }
    made.name = in_node ? "param" : "set_parameters_from_file";
    made.attributes.push_back({in_node ? "from" : "filename", file->value});
    left(piece.name, "a parameter file of ROS 2 has the name of the node and 'ros__parameters' above the parameters",
         "write them into the file: /**: {ros__parameters: {…}}");
  }

  std::string substitutions(std::string_view value) {
    std::string result;
    for (std::size_t at = 0; at < value.size();) {
      if (!value.substr(at).starts_with("$(")) {
        result += value[at++];
        continue;
      }
      const std::size_t end = std::min(value.find_first_of(" )", at), value.size());
      const std::string_view name = value.substr(at + 2, end - at - 2);
      const std::size_t close = std::min(value.find(')', at), value.size());
      at = end;
      if (name == "find") {
        result += "$(find-pkg-share";
      } else if (name == "arg") {
        result += "$(var";
      } else if (name == "optenv") {
        const std::string_view words = value.substr(end, close - end);
        const std::size_t second = words.find(' ', 1);
        result += "$(env" + std::string(words.substr(0, second)) + " ";
        const std::string_view rest = second == std::string_view::npos ? "" : words.substr(second + 1);
        const bool is_word = !rest.empty() && rest.find(' ') == std::string_view::npos;
        result += is_word ? std::string(rest) : fmt::format("'{}'", rest);
        at = close;
      } else if (name == "eval" && !value.substr(end).starts_with(" '") && !value.substr(end).starts_with(" \"")) {
        left(value, "an expression of ROS 1", "write $(eval '…'), and '$(var x)' for arg('x') and for x");
        result += "$(eval";
      } else {
        result += fmt::format("$({}", name);
      }
    }
    return result;
  }

  void write(const NewTag& made, bool is_open) {
    result_.text += made.before + "<" + made.name;
    for (const NewAttribute& attribute : made.attributes) {
      result_.text += fmt::format(" {}={}{}{}", attribute.name, attribute.quote, attribute.value, attribute.quote);
    }
    if (is_open) {
      result_.text += ">" + made.inside;
    } else if (made.inside.empty()) {
      result_.text += "/>" + made.behind;
    } else {
      result_.text += fmt::format(">{}</{}>{}", made.inside, made.name, made.behind);
    }
  }

  const std::shared_ptr<const SourceFile>& file_;
  std::vector<XmlPiece> pieces_;
  std::vector<Open> open_;
  Migrated result_;
};

}  // namespace

Migrated migrate_xml(const std::shared_ptr<const SourceFile>& file) {
  parse_xml(file);
  return Migration(file).migrate();
}

}  // namespace launch
