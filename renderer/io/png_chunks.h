// SPDX-License-Identifier: MIT
// Checks PNG chunks before stb_image reads them. Releases up to 2.27 copy empty chunks to a null
// pointer, read palette colours that do not exist, and allocate pixels that the file does not have.
#pragma once

#include <string>

namespace minkray {

/// Checks the size in the file's header, and makes the chunks of pixels and the palette readable
/// for stb_image. Data that does not begin as PNG files do stays as it is. Throws
/// std::runtime_error if there are no pixels, or too many, or if the file ends among them.
void mend_png(std::string& bytes);

}  // namespace minkray
