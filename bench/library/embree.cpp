// SPDX-License-Identifier: MIT
#include "embree.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "clock.h"

namespace bench {
namespace {

using Numbers = EmbreeScene::Numbers;

constexpr float infinite = std::numeric_limits<float>::infinity();

RTCIntersectContext context_for(bool coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

Answer answer_of(const Numbers& numbers, float t, unsigned geometry, unsigned primitive,
                 unsigned instance) {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
  return {t, numbers.are_instances ? instance : primitive / numbers.primitives_an_object};
}

/// Embree marks an occluded ray by a negative end.
Answer shadow_of(float t) {
  return t < 0 ? Answer{0, 0} : Answer{};
}

struct Asked {
  RTCScene scene;
  Numbers numbers;
  Question question;
  bool coherent;
  const std::vector<mk::Ray>& rays;
};

/// Ray by ray, or all in a stream.
class Singles : public Caster {
 public:
  Singles(const Asked& asked, bool stream)
      : Caster(stream ? "1M" : "1"), asked_(asked), stream_(stream), queries_(asked.rays.size()) {}

  void prepare() override {
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      const mk::Ray& from = asked_.rays[i];
      RTCRayHit& to = queries_[i];
      to.ray.org_x = static_cast<float>(from.origin.x);
      to.ray.org_y = static_cast<float>(from.origin.y);
      to.ray.org_z = static_cast<float>(from.origin.z);
      to.ray.dir_x = static_cast<float>(from.direction.x);
      to.ray.dir_y = static_cast<float>(from.direction.y);
      to.ray.dir_z = static_cast<float>(from.direction.z);
      to.ray.tnear = to.ray.time = 0;
      to.ray.tfar = infinite;
      to.ray.mask = ~0u;
      to.ray.id = to.ray.flags = 0;
      to.hit.geomID = to.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void cast() override {
    RTCIntersectContext context = context_for(asked_.coherent);
    const auto count = static_cast<unsigned>(queries_.size());
    if (asked_.question == Question::first_hit) {
      if (stream_)
        rtcIntersect1M(asked_.scene, &context, queries_.data(), count, sizeof(RTCRayHit));
      else
        for (RTCRayHit& query : queries_) rtcIntersect1(asked_.scene, &context, &query);
    } else {
      if (stream_)
        rtcOccluded1M(asked_.scene, &context, &queries_[0].ray, count, sizeof(RTCRayHit));
      else
        for (RTCRayHit& query : queries_) rtcOccluded1(asked_.scene, &context, &query.ray);
    }
  }

  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const RTCRayHit& query : queries_)
      all.push_back(asked_.question == Question::first_hit
                        ? answer_of(asked_.numbers, query.ray.tfar, query.hit.geomID,
                                    query.hit.primID, query.hit.instID[0])
                        : shadow_of(query.ray.tfar));
    return all;
  }

 private:
  Asked asked_;
  bool stream_;
  std::vector<RTCRayHit> queries_;
};

template <int>
struct PacketOf;
template <>
struct PacketOf<8> {
  using Type = RTCRayHit8;
  static constexpr auto intersect = rtcIntersect8;
  static constexpr auto occluded = rtcOccluded8;
};
template <>
struct PacketOf<16> {
  using Type = RTCRayHit16;
  static constexpr auto intersect = rtcIntersect16;
  static constexpr auto occluded = rtcOccluded16;
};

/// Packets of N, one call each, or all in a stream.
template <int N>
class Packets : public Caster {
 public:
  Packets(const Asked& asked, bool stream)
      : Caster((stream ? "NM of " : "") + std::to_string(N)),
        asked_(asked),
        stream_(stream),
        packets_((asked.rays.size() + N - 1) / N) {}

  void prepare() override {
    for (std::size_t i = 0; i < packets_.size() * N; ++i) {
      auto& to = packets_[i / N].ray;
      auto& hit = packets_[i / N].hit;
      const std::size_t lane = i % N, size = asked_.rays.size();
      const mk::Ray& from = asked_.rays[std::min(i, size - 1)];
      to.org_x[lane] = static_cast<float>(from.origin.x);
      to.org_y[lane] = static_cast<float>(from.origin.y);
      to.org_z[lane] = static_cast<float>(from.origin.z);
      to.dir_x[lane] = static_cast<float>(from.direction.x);
      to.dir_y[lane] = static_cast<float>(from.direction.y);
      to.dir_z[lane] = static_cast<float>(from.direction.z);
      to.tnear[lane] = to.time[lane] = 0;
      to.tfar[lane] = i < size ? infinite : -1;  // an empty interval beyond the last ray
      to.mask[lane] = ~0u;
      to.id[lane] = to.flags[lane] = 0;
      hit.geomID[lane] = hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void cast() override {
    RTCIntersectContext context = context_for(asked_.coherent);
    if (stream_) {
      rtcIntersectNM(asked_.scene, &context, reinterpret_cast<RTCRayHitN*>(packets_.data()), N,
                     static_cast<unsigned>(packets_.size()), sizeof(Packet));
      return;
    }
    alignas(64) int valid[N];
    std::fill(valid, valid + N, -1);
    for (Packet& packet : packets_) {
      if (&packet == &packets_.back())
        for (int lane = 0; lane < N; ++lane) valid[lane] = packet.ray.tfar[lane] < 0 ? 0 : -1;
      if (asked_.question == Question::first_hit)
        PacketOf<N>::intersect(valid, asked_.scene, &context, &packet);
      else
        PacketOf<N>::occluded(valid, asked_.scene, &context, &packet.ray);
    }
  }

  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (std::size_t i = 0; i < asked_.rays.size(); ++i) {
      const Packet& packet = packets_[i / N];
      const std::size_t lane = i % N;
      all.push_back(asked_.question == Question::first_hit
                        ? answer_of(asked_.numbers, packet.ray.tfar[lane], packet.hit.geomID[lane],
                                    packet.hit.primID[lane], packet.hit.instID[0][lane])
                        : shadow_of(packet.ray.tfar[lane]));
    }
    return all;
  }

 private:
  using Packet = typename PacketOf<N>::Type;
  Asked asked_;
  bool stream_;
  std::vector<Packet> packets_;
};

void attach(RTCGeometry geometry, RTCScene scene, unsigned number) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, number);
  rtcReleaseGeometry(geometry);
}

void* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t bytes,
             std::size_t count) {
  void* const made = rtcSetNewGeometryBuffer(geometry, type, 0, format, bytes, count);
  if (!made) throw std::runtime_error("Embree: no memory for a buffer");
  return made;
}

void commit(RTCScene scene) {
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(scene);
}

void add_mesh(RTCDevice device, RTCScene scene, const Mesh& mesh,
              RTCBuildQuality quality = RTC_BUILD_QUALITY_HIGH) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, quality);
  auto* to = static_cast<float*>(buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                        3 * sizeof(float), mesh.vertices.size()));
  for (const Vec& vertex : mesh.vertices)
    for (const double x : {vertex.x, vertex.y, vertex.z}) *to++ = static_cast<float>(x);
  auto* indices = static_cast<unsigned*>(buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles)
    indices = std::copy(triangle.begin(), triangle.end(), indices);
  attach(geometry, scene, 0);
}

}  // namespace

EmbreeScene::EmbreeScene() : device_(rtcNewDevice("threads=1")), scene_(nullptr) {
  if (!device_) throw std::runtime_error("Embree: no device");
  scene_ = rtcNewScene(device_);
}

EmbreeScene::EmbreeScene(EmbreeScene&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)),
      scene_(std::exchange(other.scene_, nullptr)),
      numbers_(other.numbers_) {}

EmbreeScene::~EmbreeScene() {
  if (scene_) rtcReleaseScene(scene_);
  if (device_) rtcReleaseDevice(device_);
}

EmbreeScene EmbreeScene::instances(const Subject& subject, const std::vector<Mesh>& meshes) {
  EmbreeScene made;
  made.numbers_.are_instances = true;
  std::vector<RTCScene> shapes;
  for (const Mesh& mesh : meshes) {
    shapes.push_back(rtcNewScene(made.device_));
    add_mesh(made.device_, shapes.back(), mesh);
    commit(shapes.back());
  }
  unsigned number = 0;
  for (const Placed& object : subject.objects) {
    RTCGeometry geometry = rtcNewGeometry(made.device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, shapes[object.body]);
    float columns[12];
    for (int i = 0; i < 12; ++i) columns[i] = static_cast<float>(object.pose.rows[i % 3][i / 3]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    attach(geometry, made.scene_, number++);
  }
  commit(made.scene_);
  for (const RTCScene shape : shapes) rtcReleaseScene(shape);  // instances keep them
  return made;
}

EmbreeScene EmbreeScene::spheres(const Subject& subject) {
  EmbreeScene made;
  RTCGeometry geometry = rtcNewGeometry(made.device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  auto* to = static_cast<float*>(buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4,
                                        4 * sizeof(float), subject.objects.size()));
  for (const Placed& object : subject.objects) {
    for (const auto& row : object.pose.rows) *to++ = static_cast<float>(row[3]);
    *to++ = static_cast<float>(subject.bodies[object.body].radius);
  }
  attach(geometry, made.scene_, 0);
  commit(made.scene_);
  return made;
}

EmbreeScene EmbreeScene::flat(const Subject& subject, const Mesh& mesh) {
  Mesh all;
  for (const Placed& object : subject.objects) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (const Vec& vertex : mesh.vertices) all.vertices.push_back(at(object.pose, vertex));
    for (const auto& [a, b, c] : mesh.triangles)
      all.triangles.push_back({first + a, first + b, first + c});
  }
  EmbreeScene made = triangles(all);
  made.numbers_.primitives_an_object = static_cast<unsigned>(mesh.triangles.size());
  return made;
}

double EmbreeScene::seconds_to_build(const Mesh& mesh) {
  EmbreeScene made;
  const Clock clock;
  add_mesh(made.device_, made.scene_, mesh, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitScene(made.scene_);
  return clock.processor();
}

EmbreeScene EmbreeScene::triangles(const Mesh& mesh, Edges edges, std::size_t objects) {
  EmbreeScene made;
  if (edges == Edges::robust) rtcSetSceneFlags(made.scene_, RTC_SCENE_FLAG_ROBUST);
  add_mesh(made.device_, made.scene_, mesh);
  commit(made.scene_);
  made.numbers_.primitives_an_object = static_cast<unsigned>(mesh.triangles.size() / objects);
  return made;
}

void EmbreeScene::add_casters(Casters& to, const std::vector<mk::Ray>& rays, Question question,
                              bool coherent) const {
  const Asked asked{scene_, numbers_, question, coherent, rays};
  to.push_back(std::make_unique<Singles>(asked, false));
  to.push_back(std::make_unique<Singles>(asked, true));
  to.push_back(std::make_unique<Packets<8>>(asked, false));
  if (question == Question::occlusion) return;
  to.push_back(std::make_unique<Packets<16>>(asked, false));
  to.push_back(std::make_unique<Packets<8>>(asked, true));
  to.push_back(std::make_unique<Packets<16>>(asked, true));
}

std::unique_ptr<Caster> EmbreeScene::single(const std::vector<mk::Ray>& rays) const {
  return std::make_unique<Singles>(Asked{scene_, numbers_, Question::first_hit, false, rays},
                                   false);
}

}  // namespace bench
