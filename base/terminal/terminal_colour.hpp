// SPDX-License-Identifier: Apache-2.0
// Whether text for a descriptor gets colours.
#pragma once

namespace launch {

// A terminal gets them, unless NO_COLOR is set and not empty (https://no-color.org). RCUTILS_COLORIZED_OUTPUT, which
// decides for the nodes, decides here, too: 0 is never, 1 is always.
bool shows_colour(int fd);

}  // namespace launch
