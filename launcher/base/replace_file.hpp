// SPDX-License-Identifier: Apache-2.0
// Writes a file as a whole at a place that others can guess.
//
// Somebody else may have put a link there, so that a program of root's writes through it into a file of root's. The
// text therefore goes into a new file beside the place, which is then renamed: a link at either place is never
// followed. Readers see the file as it was before or the whole new one, also when two processes write it at once.
#pragma once

#include <string>
#include <string_view>

#include "launcher/base/unique_fd.hpp"

namespace launch {

// Puts a file with this text at `path`, in place of a file or a link that is there. Its directory must exist. The mode
// is 0666 less the umask. Throws std::system_error; what was at `path` is then as it was.
void replace_file(const std::string& path, std::string_view text);
// The same for the file `name` in an open directory.
void replace_file(const UniqueFd& directory, const std::string& name, std::string_view text);

// Opens a directory, for replace_file(); what does not exist of it is made. On the way to it a link is followed only if
// this user or root owns it. Throws std::system_error.
UniqueFd open_or_make_directory(const std::string& path);

}  // namespace launch
