// SPDX-License-Identifier: MIT
// A look at the chunks of PNG files before stb_image reads them: its releases up to 2.27 copy empty
// ones to a null pointer, take colours that a palette does not have from memory, and make room for
// pixels that the file does not have.
#pragma once

#include <string>

namespace minkray {

/// Checks the size that the file's header says, and makes the chunks of pixels and the palette what
/// stb_image can read. What does not begin as PNG files do stays as it is. Throws
/// std::runtime_error if there are no pixels, or too many, or if the file ends among them.
void mend_png(std::string& bytes);

}  // namespace minkray
