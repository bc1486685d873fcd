// SPDX-License-Identifier: Apache-2.0
// Launch files of any size, made for measuring.
#pragma once

#include <string>

namespace bench {

// `count` nodes, each with three parameters (one of them a list, one with a substitution) and two remaps.
std::string nodes_as_xml(int count);
std::string nodes_as_yaml(int count);

// Writes launch files that include one another, `depth` of them, into `directory`; the path of the outermost.
std::string write_include_chain(const std::string& directory, int depth);

}  // namespace bench
