// SPDX-License-Identifier: Apache-2.0
// Reads the text of .msg, .srv and .action files.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/message_types/interface_type.hpp"

namespace launch {

// Finds the message that a field has as its type, by its full name. May throw LaunchError.
using FindMessage = std::function<std::shared_ptr<const MessageType>(const std::string& name)>;

// The parts between the lines "---": one of a message, two of a service, three of an action. Their names are empty.
// Throws LaunchError with the place in the file.
std::vector<MessageType> parse_interface_file(const std::shared_ptr<const SourceFile>& file, const std::string& package,
                                              const FindMessage& find_message);

// Reads the text of .idl files: the part of OMG IDL that ROS 2's packages use.
//
// Such a file has `module PACKAGE { module msg { … }; };`, in it structs, `typedef`s and modules `X_Constants`. Of the
// annotations, only `@default (value=…)` has an effect. Numbers may be computed from others.
// The parts of the interface as parse_interface_file() returns them: the structs `parts`, in this order. Throws
// LaunchError with the place in the file.
std::vector<MessageType> parse_idl_file(const std::shared_ptr<const SourceFile>& file, const std::string& package,
                                        const std::vector<std::string>& parts, const FindMessage& find_message);

}  // namespace launch
