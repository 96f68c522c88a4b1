// SPDX-License-Identifier: MIT
// Scans of cameras as COCO object annotations: https://cocodataset.org/#format-data
#pragma once

#include "renderer/sensor/scan_files.h"

namespace minkray {

/// Writes a mask (run lengths, column by column) and a box for each object that is the first echo
/// of any pixel. Categories are the objects' names; their id is the object's number + 1.
std::vector<unsigned char> coco_of(const ScanOutput& output);

}  // namespace minkray
