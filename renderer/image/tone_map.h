// SPDX-License-Identifier: MIT
// Tone mapping: linear light of any magnitude to linear values up to 1.
#pragma once

#include <array>
#include <string_view>

#include "core/math/vec.h"
#include "core/support/named_kind.h"

namespace minkray {

enum class ToneMap : unsigned char { srgb, filmic, agx };

/// The list of all there are.
inline constexpr std::array tone_maps = {
    NamedKind<ToneMap>{ToneMap::srgb, "srgb", "clipped at white"},
    NamedKind<ToneMap>{ToneMap::filmic, "filmic",
                       "bright light rolls off as on film (ACES, after Narkowicz 2015)"},
    NamedKind<ToneMap>{ToneMap::agx, "agx",
                       "bright colours fade to white (AgX by Sobotka, after Wrensch 2023)"},
};

Vec3<double> tone_mapped(ToneMap kind, const Vec3<double>& light);

}  // namespace minkray
