// SPDX-License-Identifier: Apache-2.0
// Names that a node gets from its command line, as the node means them.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace launch {

// "/left" and "talker" are "/left/talker". The namespace may lack its first slash.
std::string joined_name(const std::string& name_space, const std::string& name);

// A name of a topic or a service: relative names are below the namespace, "~" stands for the node.
std::string resolved_name(const std::string& name, const std::string& name_space, const std::string& node);

// The remaps of names in the arguments of a node, from and to: `-r from:=to`, without those of its own name and
// namespace.
std::vector<std::pair<std::string, std::string>> remaps_of(const std::vector<std::string>& argv);

}  // namespace launch
