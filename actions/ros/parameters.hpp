// SPDX-License-Identifier: Apache-2.0
// The <param> items of a node: values, nested values and parameter files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actions/parameters/parameter_file.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/language/parameter_value.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// One <param>: it gives a node one parameter file.
class Parameters {
 public:
  static ItemSpec item();

  // Throws LaunchError for forms that exclude each other and for values that have no parameter type.
  explicit Parameters(const Fields& fields);

  // Appends --params-file and its file to a node's argv: the named file, or one to be generated. `qualified_name` is
  // the name of the node, or empty when it isn't known; the parameters then hold for any name of the node.
  // Notes in `node` what it gives by name.
  void append_to(ProcessSpec& spec, LaunchContext& context, const std::string& qualified_name,
                 NodeDescription& node) const;
  // Appends typed values, as nodes that are loaded into a container get them; files are read now.
  void append_to(std::vector<NamedParameter>& parameters, LaunchContext& context, const KnownNodeName& node) const;

 private:
  // A name with a value, or a name with nested parameters.
  struct Tree {
    Template name;
    std::optional<ParameterValueSource> value;
    std::string text;  // of a value with a separator
    std::string separator;
    SourceRange where;
    std::vector<Tree> nested;
  };
  static Tree parse_tree(const Fields& fields);
  static void perform_tree(const Tree& tree, const std::string& prefix, Scope& scope,
                           std::vector<NamedParameter>& parameters);
  std::string text_there(const std::string& path, LaunchContext& context) const;
  // The text of a file, with its substitutions performed.
  std::string performed_file(const std::string& path, LaunchContext& context) const;
  static void find_useless_separators(const Tree& tree, LaunchContext& context);

  std::optional<Template> file_;
  bool allow_substitutions_ = false;
  SourceRange where_;
  std::optional<Tree> tree_;
};

}  // namespace launch
