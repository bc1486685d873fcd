// SPDX-License-Identifier: Apache-2.0
// Writes a file as a whole at a place that others can guess.
//
// Somebody else may have put a link at the place, and a program that root runs would write through it into a file of
// root's. The text therefore goes into a new file beside the place, which is then renamed. A link is never followed at
// either name. Readers see the old file or the whole new one, even when two processes write it at once.
#pragma once

#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"

namespace launch {

// Puts a file with this text at `path`. The new file replaces a file or a link. The directory must exist. The mode is
// 0666 less the umask. If it throws std::system_error, `path` is unchanged.
void replace_file(const std::string& path, std::string_view text);
// The same for the file `name` in an open directory.
void replace_file(const UniqueFd& directory, const std::string& name, std::string_view text);

// Opens a directory for replace_file() and makes the parts of the path that do not exist. A link on the way is followed
// only if this user or root owns it. Throws std::system_error.
UniqueFd open_or_make_directory(const std::string& path);

}  // namespace launch
