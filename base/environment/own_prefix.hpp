// SPDX-License-Identifier: Apache-2.0
// Where this program is installed, and the files that are installed with it.
//
// A program looks for its companions beside itself, so that an install tree can be moved as a whole and two of them can
// stand on one machine. The place comes from /proc/self/exe, which is right for every way in which a program is
// started.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// The folder that holds the `bin`, `lib/launch` or `lib/launch_companion` of this program: "/usr/local" for
// /usr/local/bin/launch, links resolved. "" when /proc cannot be read, so that own_prefix() + "/share" is an absolute
// path in any case.
std::string own_prefix();

// The path of `name` in this program's lib/launch, which holds the programs and libraries that nobody starts by hand.
// The function does not check that the file exists.
std::string own_library_file(std::string_view name);

// For an error that begins with who needs the file: "needs launch-test, which is not in /usr/lib/launch: this
// installation has been built without tests in launch files".
std::string needs_missing_file(std::string_view name);

}  // namespace launch
