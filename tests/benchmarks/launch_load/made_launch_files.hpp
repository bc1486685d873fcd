// SPDX-License-Identifier: Apache-2.0
// Makes launch files of any size, for measurements.
#pragma once

#include <string>

namespace bench {

// `count` nodes, each with three parameters (one of them a list, one with a substitution) and two remaps.
std::string nodes_as_xml(int count);
std::string nodes_as_yaml(int count);

// Writes `depth` launch files that include one another into `directory`. Returns the path of the outermost.
std::string write_include_chain(const std::string& directory, int depth);

}  // namespace bench
