// SPDX-License-Identifier: MIT
// Scans of cameras as COCO's object annotations: https://cocodataset.org/#format-data
#pragma once

#include "renderer/sensor/scan_files.h"

namespace minkray {

/// A mask (run lengths, column by column) and a box of each object that is the first echo of any
/// pixel; categories are the objects' names, with the number + 1 as id.
std::vector<unsigned char> coco_of(const ScanOutput& output);

}  // namespace minkray
