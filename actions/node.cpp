// <node pkg="…" exec="…"/>: runs a ROS node: a program that understands --ros-args.
#include <fmt/format.h>

#include <cctype>

#include "actions/parameters.hpp"
#include "actions/process_fields.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

// The configuration that holds the namespace of the scope.
constexpr const char* kNamespaceConfiguration = "ros_namespace";

bool is_valid_name(std::string_view name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) {
    return false;
  }
  for (const char character : name) {
    if (!std::isalnum(static_cast<unsigned char>(character)) && character != '_') {
      return false;
    }
  }
  return true;
}

bool is_valid_namespace(std::string_view text) {
  if (text == "/") {
    return true;
  }
  while (!text.empty()) {
    if (text.front() != '/') {
      return false;
    }
    text.remove_prefix(1);
    const std::size_t end = text.find('/');
    if (!is_valid_name(text.substr(0, end))) {
      return false;
    }
    text.remove_prefix(end == std::string_view::npos ? text.size() : end);
  }
  return true;
}

// The namespace `given` means below `base`: absolute, without a slash at its end.
std::string combine_namespaces(const std::string& base, const std::string& given) {
  std::string combined;
  if (base.empty() || given.starts_with('/')) {
    combined = given;
  } else {
    combined = base == "/" ? "/" + given : base + "/" + given;
  }
  while (combined.size() > 1 && combined.ends_with('/')) {
    combined.pop_back();
  }
  return combined.starts_with('/') ? combined : "/" + combined;
}

class Node : public Action {
 public:
  explicit Node(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        package_(fields.optional_text("pkg")),
        executable_(fields.text("exec")),
        name_(fields.optional_text("name")),
        exec_name_(fields.optional_text("exec_name")),
        namespace_(fields.optional_text("namespace")),
        arguments_(fields.words("args")),
        ros_arguments_(fields.optional_words("ros_args")),
        process_(fields) {
    for (const Fields* parameter : fields.items("param")) {
      parameters_.emplace_back(*parameter);
    }
    for (const Fields* remap : fields.items("remap")) {
      remaps_.emplace_back(remap->text("from"), remap->text("to"));
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    ProcessSpec spec;
    spec.argv.push_back(program(scope));
    for (const Template& word : arguments_) {
      spec.argv.push_back(word.perform(scope));
    }
    if (ros_arguments_) {
      spec.argv.push_back("--ros-args");
      for (const Template& word : *ros_arguments_) {
        spec.argv.push_back(word.perform(scope));
      }
    }
    spec.argv.push_back("--ros-args");

    const std::optional<std::string> name = node_name(scope);
    const std::optional<std::string> name_space = node_namespace(scope);
    const auto remap = [&](const std::string& rule) { spec.argv.insert(spec.argv.end(), {"-r", rule}); };
    if (name) {
      remap("__node:=" + *name);
    }
    if (name_space) {
      remap("__ns:=" + *name_space);
    }
    std::string qualified_name;  // stays empty while either part is left to the program
    if (name && name_space) {
      qualified_name = (*name_space == "/" ? "" : *name_space) + "/" + *name;
      context.note_node(qualified_name);
    }
    for (const Parameters& parameters : parameters_) {
      parameters.append_to(spec, context, qualified_name);
    }
    for (const auto& [from, to] : remaps_) {
      remap(from.perform(scope) + ":=" + to.perform(scope));
    }

    if (exec_name_) {
      spec.name = exec_name_->perform(scope);
    }
    process_.request(context, std::move(spec));
  }

 private:
  std::string program(Scope& scope) const {
    const std::string executable = executable_.perform(scope);
    if (!package_) {
      return executable;
    }
    const std::string package = package_->perform(scope);
    try {
      return scope.packages->executable(executable, package, scope.environment);
    } catch (const std::runtime_error& error) {
      // The package is at fault when it can't be found by itself.
      try {
        scope.packages->prefix(package, scope.environment);
      } catch (const std::runtime_error&) {
        throw LaunchError(error.what(), package_->where(), did_you_mean(package, scope.packages->packages(scope.environment)));
      }
      throw LaunchError(error.what(), executable_.where(),
                        did_you_mean(executable, scope.packages->executables(package, scope.environment)));
    }
  }

  std::optional<std::string> node_name(Scope& scope) const {
    if (!name_) {
      return std::nullopt;
    }
    std::string name = name_->perform(scope);
    if (!is_valid_name(name)) {
      throw LaunchError(fmt::format("invalid node name '{}'", name), name_->where(),
                        "use letters, digits and underscores, not starting with a digit");
    }
    return name;
  }

  std::optional<std::string> node_namespace(Scope& scope) const {
    const auto pushed = scope.configurations.find(kNamespaceConfiguration);
    const std::string base = pushed == scope.configurations.end() ? std::string() : pushed->second;
    if (!namespace_ && base.empty()) {
      return std::nullopt;
    }
    std::string combined = namespace_ ? combine_namespaces(base, namespace_->perform(scope)) : combine_namespaces("", base);
    if (!is_valid_namespace(combined)) {
      throw LaunchError(fmt::format("the resulting namespace is invalid: '{}'", combined),
                        namespace_ ? namespace_->where() : where(),
                        "each part is letters, digits and underscores, not starting with a digit");
    }
    return combined;
  }

  std::optional<Template> package_;
  Template executable_;
  std::optional<Template> name_;
  std::optional<Template> exec_name_;
  std::optional<Template> namespace_;
  std::vector<Template> arguments_;
  std::optional<std::vector<Template>> ros_arguments_;
  std::vector<Parameters> parameters_;
  std::vector<std::pair<Template, Template>> remaps_;
  ProcessFields process_;
};

}  // namespace

ActionType node_action() {
  std::vector<AttributeSpec> attributes = {
      {"exec", AttributeType::kText, true, "", "the program, looked up in the package"},
      {"pkg", AttributeType::kText, false, "", "the package; none: exec is a path or found on PATH"},
      {"name", AttributeType::kText, false, "the program decides", "name of the node"},
      {"exec_name", AttributeType::kText, false, "base name of the program", "label of the process"},
      {"namespace", AttributeType::kText, false, "", "namespace of the node, below that of the scope"},
      {"args", AttributeType::kCommandLine, false, "", "more arguments, before --ros-args"},
      {"ros_args", AttributeType::kCommandLine, false, "", "more ROS arguments, after --ros-args"}};
  const std::vector<AttributeSpec> common = ProcessFields::attributes();
  attributes.insert(attributes.end(), common.begin(), common.end());
  std::vector<ItemSpec> items = ProcessFields::items();
  items.push_back(Parameters::item());
  items.push_back({"remap",
                   "renames a topic, a service or an action",
                   {{"from", AttributeType::kText, true, "", "the name in the program"},
                    {"to", AttributeType::kText, true, "", "the name to use"}}});
  return {
      .tag = "node",
      .help = "Runs a ROS node.",
      .attributes = std::move(attributes),
      .items = std::move(items),
      .make = [](const Fields& fields) { return std::make_shared<Node>(fields); },
  };
}

}  // namespace launch
