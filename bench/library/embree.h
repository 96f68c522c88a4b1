// SPDX-License-Identifier: MIT
// Embree 3 at its best: scenes built at its highest quality, and every kind of call. Its fastest
// intersection is used, and its robust one at meshes.
#pragma once

#include <embree3/rtcore.h>

#include "casters.h"
#include "subject.h"

namespace bench {

/// A scene whose objects have the numbers of the subject's.
class EmbreeScene {
 public:
  /// Each body's mesh once, and an instance of it for each object.
  static EmbreeScene instances(const Subject& subject, const std::vector<Mesh>& meshes);
  /// One geometry of Embree's own spheres.
  static EmbreeScene spheres(const Subject& subject);
  /// All triangles of all objects in one geometry: faster than instances where they are few, and
  /// larger. The subject has one body.
  static EmbreeScene flat(const Subject& subject, const Mesh& mesh);
  /// The triangles of one mesh, where they are; each of the objects has equally many of them.
  enum class Edges { fast, robust };
  static EmbreeScene triangles(const Mesh& mesh, Edges edges = Edges::fast,
                               std::size_t objects = 1);
  /// Processor time of a build of these at Embree's default quality.
  static double seconds_to_build(const Mesh& mesh);

  EmbreeScene(EmbreeScene&& other) noexcept;
  EmbreeScene& operator=(EmbreeScene&&) = delete;
  ~EmbreeScene();

  /// rtcIntersect1, 8 and 16, and the streams 1M and NM; rtcOccluded1, 8 and 1M, since 16 and NM
  /// were seen not to return on instances. The scene and the rays must outlive them.
  void add_casters(Casters& to, const std::vector<mk::Ray>& rays, Question question,
                   bool coherent) const;
  /// rtcIntersect1 alone.
  std::unique_ptr<Caster> single(const std::vector<mk::Ray>& rays) const;

  /// Identifies the object that is met: by the instance, or by a fixed number of primitives each.
  struct Numbers {
    bool are_instances = false;
    unsigned primitives_an_object = 1;
  };

 private:
  EmbreeScene();

  RTCDevice device_;
  RTCScene scene_;
  Numbers numbers_;
};

}  // namespace bench
