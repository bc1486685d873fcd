// SPDX-License-Identifier: Apache-2.0
// A package's description of one of its plugins.
#pragma once

#include <string>

namespace pluginlib {

struct ClassDesc {
  std::string lookup_name_;            // the name for loaders: the attribute `name`, else the class
  std::string derived_class_;          // "shapes::Square"
  std::string base_class_;             // "shapes::Shape"
  std::string package_;                // the package that exports it
  std::string description_;            // for people, without white space around it
  std::string library_name_;           // as in the description
  std::string resolved_library_path_;  // "UNRESOLVED" until it is loaded
  std::string plugin_manifest_path_;   // path of the description
};

}  // namespace pluginlib
