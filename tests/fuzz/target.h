// SPDX-License-Identifier: MIT
// List of the fuzz targets. Each takes any bytes, does with them what a user or a caller could,
// and returns a description of an error in the outcome: empty, if every promise was kept.
// libFuzzer runs them (tests/fuzz/entry.cpp) on inputs that it invents, the suite
// (tests/fuzz/replay_test.cpp) on those that are kept.
#pragma once

#include <string>
#include <string_view>

namespace minkray::fuzz {

/// A scene file: read into a scene that can be described and written, or refused with messages.
std::string check_scene(std::string_view bytes);

/// Lines of queries: each answered, in float and in double, or refused with messages.
std::string check_queries(std::string_view bytes);

/// A mesh file, its first byte selecting OBJ or STL: read into points whose hull holds them all,
/// or rejected with a message.
std::string check_mesh(std::string_view bytes);

/// A mesh file of any format that robots' files name: read, split into parts and made hulls of, or
/// rejected with a message. The first two bytes select the format and the split.
std::string check_mesh_parts(std::string_view bytes);

/// A robot's file, or the contents of its root element: read into a model and a scene
/// (tests/fuzz/robot_promises.h), or rejected with messages.
std::string check_mjcf(std::string_view bytes);
std::string check_urdf(std::string_view bytes);
std::string check_sdf(std::string_view bytes);
/// A glTF file, text or binary.
std::string check_gltf(std::string_view bytes);

/// Shapes, nestings and rays made of the bytes (tests/fuzz/shape_from_bytes.h), cast by all
/// accurate solvers and in packets; the answers checked by tests/fuzz/cast_promises.h.
std::string check_cast(std::string_view bytes);

/// Two shapes made of the bytes: their signed distance compared with planes of their own support
/// mappings.
std::string check_contact(std::string_view bytes);

/// An image file, a part file or a checkpoint, or edits of one (tests/fuzz/image_target.cpp): read
/// into what is written and read again the same, or refused with a message that names the file.
std::string check_image(std::string_view bytes);

/// Calls of the C interface, right and wrong ones: what minkray_c.h promises of each
/// (tests/fuzz/c_abi_program.h).
std::string check_c_abi(std::string_view bytes);

/// Checks one cast, given as a line for `minkray cast`, in float and in double.
std::string check_cast_query(std::string_view line);

}  // namespace minkray::fuzz
