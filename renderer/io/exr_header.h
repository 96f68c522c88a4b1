// SPDX-License-Identifier: MIT
// Checks OpenEXR headers before the library reads them. The library allocates as much memory for a
// text as its length field: 1.8 GB for a file of 1.3 kB.
#pragma once

#include <functional>
#include <span>

namespace minkray {

/// Reads on, into all of the buffer; false at the end of the file.
using ReadOn = std::function<bool(std::span<char> buffer)>;

/// True if the file's headers have all attributes, each with the length that it claims and its type
/// needs. `read` begins at the file's first byte. True also for files that are not OpenEXR.
bool has_whole_exr_attributes(const ReadOn& read);

}  // namespace minkray
