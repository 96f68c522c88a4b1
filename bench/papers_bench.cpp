// SPDX-License-Identifier: MIT
// Distances, overlap tests and shape casts beside Bullet 3.24 (float), FCL 0.7 and libccd 2.1 on
// the same random queries: time and error side by side. The reference for errors is our double
// answer; for distances its own certificate is printed, which is its proof.
//
// Times are the best of several interleaved rounds on one core and include what each library does
// for a query, but not making the shapes.
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <ccd/ccd.h>
#include <fcl/fcl.h>

#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <random>

#include "core/contact/distance.h"
#include "core/contact/shape_cast.h"
#include "core/derived/convert.h"

namespace minkray {
namespace {

constexpr int queries = 2000, rounds = 5;
/// Answers this far off, in sizes of the shapes, are counted as wrong.
constexpr double wrong = 1e-3;

/// One shape in every library's words.
struct Everywhere {
  const char* name;
  Shape<double> ours;
  std::shared_ptr<btConvexShape> bullet;
  std::shared_ptr<fcl::CollisionGeometryd> fcl;  ///< null: not compared
};

std::vector<Everywhere> make_shapes() {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  std::vector<Vec3<double>> points;
  auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 32; ++i) {
    points.push_back(Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized());
    const auto p = points.back().cast<float>();
    hull->addPoint({p.x(), p.y(), p.z()}, i == 31);
  }
  std::vector<Everywhere> shapes = {
      {"sphere", Sphere<double>{0.5}, std::make_shared<btSphereShape>(0.5f),
       std::make_shared<fcl::Sphered>(0.5)},
      {"box", Box<double>{{1, 0.5, 0.25}}, std::make_shared<btBoxShape>(btVector3(1, 0.5f, 0.25f)),
       std::make_shared<fcl::Boxd>(2, 1, 0.5)},
      {"cylinder", Cylinder<double>{0.5, 0.75},
       std::make_shared<btCylinderShapeZ>(btVector3(0.5f, 0.5f, 0.75f)),
       std::make_shared<fcl::Cylinderd>(0.5, 1.5)},
      {"cone", Cone<double>{0.5, 0.75}, std::make_shared<btConeShapeZ>(0.5f, 1.5f),
       std::make_shared<fcl::Coned>(0.5, 1.5)},
      {"hull 32", Hull<double>{PointCloud<double>(points)}, hull, nullptr},
  };
  return shapes;
}

struct Query {
  Affine<double> a, b;
  Vec3<double> motion;  ///< of b
};

std::vector<Query> make_queries() {
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto direction = [&] {
    return Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized();
  };
  const auto turn = [&] {
    return rotation_matrix(normal(engine), normal(engine), normal(engine), normal(engine));
  };
  std::vector<Query> list;
  for (int i = 0; i < queries; ++i) {
    const Vec3<double> where = direction() * (1 + 3 * uniform(engine));
    list.push_back({{turn(), Vec3<double>::Zero()},
                    {turn(), where},
                    Vec3<double>(-2 * where + 0.7 * direction())});
  }
  return list;
}

btTransform to_bullet(const Affine<double>& pose) {
  const Mat3<float> m = pose.linear.cast<float>();
  const Vec3<float> t = pose.translation.cast<float>();
  return btTransform(
      btMatrix3x3(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)),
      btVector3(t.x(), t.y(), t.z()));
}

fcl::Transform3d to_fcl(const Affine<double>& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = pose.linear;
  result.translation() = pose.translation;
  return result;
}

/// A number for each query; NaN for "no answer".
using Answers = std::vector<double>;

struct Contestant {
  std::string name;
  std::function<double(const Query&)> ask;
  Answers answers = Answers(queries);
  double seconds = std::numeric_limits<double>::infinity();
};

void race(std::vector<Contestant>& contestants, const std::vector<Query>& list) {
  for (int round = 0; round < rounds; ++round)
    for (Contestant& contestant : contestants) {
      const std::clock_t start = std::clock();  // processor time: other load does not count
      for (std::size_t i = 0; i < list.size(); ++i) contestant.answers[i] = contestant.ask(list[i]);
      contestant.seconds =
          std::min(contestant.seconds, double(std::clock() - start) / CLOCKS_PER_SEC);
    }
}

void print(const char* what, const std::vector<Contestant>& contestants) {
  std::printf("\n%s\n  %-34s %10s %12s %12s %8s %8s\n", what, "", "ns/query", "mean error",
              "worst error", "wrong", "verdict");
  const Answers& reference = contestants.front().answers;
  for (const Contestant& contestant : contestants) {
    double sum = 0, worst = 0;
    int count = 0, off = 0, verdicts = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const bool has = !std::isnan(contestant.answers[i]), should = !std::isnan(reference[i]);
      verdicts += has != should;
      if (!has || !should) continue;
      const double error = std::abs(contestant.answers[i] - reference[i]);
      sum += error;
      worst = std::max(worst, error);
      off += error > wrong;
      ++count;
    }
    std::printf("  %-34s %10.0f %12.1e %12.1e %8d %8d\n", contestant.name.c_str(),
                1e9 * contestant.seconds / queries, count ? sum / count : 0.0, worst, off,
                verdicts);
  }
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

template <class T>
Contestant our_distance(const Everywhere& a, const Everywhere& b, SubalgorithmKind kind,
                        const char* name) {
  const CentredShape<T> A = centred(convert<T>(a.ours)), B = centred(convert<T>(b.ours));
  return {
      name, [=](const Query& query) {
        const auto place = [](const CentredShape<T>& shape, const Affine<double>& pose) {
          const Affine<T> at = pose.template cast<T>();
          return CentredShape<T>{
              Transform<T>{Nested<T>(shape.about_centre), Affine<T>{at.linear, Vec3<T>::Zero()}},
              at(shape.centre), shape.radius};
        };
        return double(distance_between(place(A, query.a), place(B, query.b), {}, kind).distance);
      }};
}

void compare_distances(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list) {
  std::vector<Contestant> contestants = {
      our_distance<double>(a, b, SubalgorithmKind::projection, "minkray double, projection"),
      our_distance<double>(a, b, SubalgorithmKind::johnson, "minkray double, johnson"),
      our_distance<double>(a, b, SubalgorithmKind::signed_volumes,
                           "minkray double, signed volumes"),
      our_distance<float>(a, b, SubalgorithmKind::projection, "minkray float, projection"),
      our_distance<float>(a, b, SubalgorithmKind::johnson, "minkray float, johnson"),
      our_distance<float>(a, b, SubalgorithmKind::signed_volumes, "minkray float, signed volumes"),
  };
  contestants.push_back(
      {"Bullet btGjkPairDetector (float)", [&](const Query& query) {
         btVoronoiSimplexSolver simplex;
         btGjkPairDetector detector(a.bullet.get(), b.bullet.get(), &simplex, nullptr);
         btGjkPairDetector::ClosestPointInput input;
         input.m_transformA = to_bullet(query.a);
         input.m_transformB = to_bullet(query.b);
         btPointCollector output;
         detector.getClosestPoints(input, output, nullptr);
         return output.m_hasResult ? std::max(0.0, double(output.m_distance)) : 0.0;
       }});
  if (a.fcl && b.fcl)
    for (const auto solver : {fcl::GJKSolverType::GST_INDEP, fcl::GJKSolverType::GST_LIBCCD})
      contestants.push_back({solver == fcl::GJKSolverType::GST_INDEP ? "FCL distance, own GJK"
                                                                     : "FCL distance, libccd",
                             [&, solver](const Query& query) {
                               fcl::DistanceRequestd request;
                               request.gjk_solver_type = solver;
                               request.enable_signed_distance = false;
                               fcl::DistanceResultd result;
                               try {
                                 fcl::distance(a.fcl.get(), to_fcl(query.a), b.fcl.get(),
                                               to_fcl(query.b), request, result);
                               } catch (const std::exception&) {
                                 return none;
                               }
                               return std::max(0.0, result.min_distance);
                             }});
  race(contestants, list);
  print((std::string("distance ") + a.name + " to " + b.name).c_str(), contestants);
}

/// A shape of ours for libccd, which asks for supports in the world.
struct CcdShape {
  const Shape<double>* shape;
  Affine<double> pose;
};

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* support) {
  const auto* placed = static_cast<const CcdShape*>(object);
  const Vec3<double> d(direction->v[0], direction->v[1], direction->v[2]);
  const Vec3<double> p =
      placed->pose(placed->shape->support<double>(placed->pose.linear.transpose() * d));
  ccdVec3Set(support, p.x(), p.y(), p.z());
}

void compare_overlaps(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list) {
  const Contestant ours =
      our_distance<double>(a, b, SubalgorithmKind::projection, "minkray double");
  std::vector<Contestant> contestants = {
      {"minkray double, distance",
       [&](const Query& query) { return ours.ask(query) > 0 ? none : 0.0; }},
      {"libccd ccdGJKIntersect, our supports", [&](const Query& query) {
         ccd_t ccd;
         CCD_INIT(&ccd);
         ccd.support1 = ccd.support2 = ccd_support;
         ccd.max_iterations = 1000;
         const CcdShape A{&a.ours, query.a}, B{&b.ours, query.b};
         return ccdGJKIntersect(&A, &B, &ccd) ? 0.0 : none;
       }}};
  race(contestants, list);
  print((std::string("overlap of ") + a.name + " and " + b.name).c_str(), contestants);
}

template <class T>
Contestant our_cast(const Everywhere& a, const Everywhere& b, SolverKind solver, const char* name) {
  return {
      name, [&a, &b, solver, A = convert<T>(a.ours), B = convert<T>(b.ours)](const Query& query) {
        CastOptions<T> options;
        options.solver = solver;
        const PreparedPair<T> pair(centred(A, query.a.cast<T>()), centred(B, query.b.cast<T>()));
        const auto result = cast_shape<T>(pair, query.motion.cast<T>(), T(1), options);
        return result.cast.found() ? double(result.cast.t()) : none;
      }};
}

void compare_casts(const Everywhere& a, const Everywhere& b, const std::vector<Query>& all) {
  // Peers differ in what an overlap at the start is: those queries are left out.
  std::vector<Query> list;
  for (const Query& query : all)
    if (distance_between(centred(a.ours, query.a), centred(b.ours, query.b)).distance > 0.01)
      list.push_back(query);
  list.resize(queries, list.front());
  const auto bullet = [&](auto make) {
    return [&, make](const Query& query) {
      btVoronoiSimplexSolver simplex;
      auto cast = make(&simplex);
      btConvexCast::CastResult result;
      Affine<double> end = query.b;
      end.translation += query.motion;
      const btTransform A = to_bullet(query.a);
      const bool hit = cast.calcTimeOfImpact(A, A, to_bullet(query.b), to_bullet(end), result);
      return hit && result.m_fraction <= 1 ? double(result.m_fraction) : none;
    };
  };
  std::vector<Contestant> contestants = {
      our_cast<double>(a, b, SolverKind::paper, "minkray double, paper"),
      our_cast<double>(a, b, SolverKind::automatic, "minkray double, auto"),
      our_cast<float>(a, b, SolverKind::paper, "minkray float, paper"),
      our_cast<double>(a, b, SolverKind::first_solution, "minkray double, Algorithm 1"),
      {"Bullet btSubsimplexConvexCast", bullet([&](btVoronoiSimplexSolver* simplex) {
         return btSubsimplexConvexCast(a.bullet.get(), b.bullet.get(), simplex);
       })},
      {"Bullet btGjkConvexCast", bullet([&](btVoronoiSimplexSolver* simplex) {
         return btGjkConvexCast(a.bullet.get(), b.bullet.get(), simplex);
       })}};
  if (a.fcl && b.fcl)
    contestants.push_back({"FCL conservative advancement", [&](const Query& query) {
                             fcl::ContinuousCollisionRequestd request;
                             request.ccd_motion_type = fcl::CCDM_TRANS;
                             request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
                             request.gjk_solver_type = fcl::GST_INDEP;
                             fcl::ContinuousCollisionResultd result;
                             fcl::Transform3d end = to_fcl(query.b);
                             end.translation() += query.motion;
                             try {
                               fcl::continuousCollide(a.fcl.get(), to_fcl(query.a), to_fcl(query.a),
                                                      b.fcl.get(), to_fcl(query.b), end, request,
                                                      result);
                             } catch (const std::exception&) {
                               return none;
                             }
                             return result.is_collide ? result.time_of_contact : none;
                           }});
  race(contestants, list);
  print((std::string("shape cast of ") + b.name + " at " + a.name + ", t in [0, 1]").c_str(),
        contestants);
}

}  // namespace
}  // namespace minkray

int main() {
  using namespace minkray;
  const std::vector<Everywhere> shapes = make_shapes();
  const std::vector<Query> list = make_queries();
  double widest = 0;
  for (const Everywhere& a : shapes)
    for (const Query& query : list) {
      const auto result = distance_between(centred(a.ours, query.a), centred(a.ours, query.b));
      widest = std::max(widest, result.distance - result.lower);
    }
  std::printf(
      "%d queries each, best of %d interleaved rounds, one core.\n"
      "Errors are against the first row, whose distances are proven to %.0e by their planes;\n"
      "\"wrong\": off by more than %.0e; \"verdict\": answers where the first has none or the "
      "other way round.\n",
      queries, rounds, widest, wrong);
  const std::array<std::pair<int, int>, 5> pairs = {{{0, 1}, {1, 1}, {2, 3}, {4, 4}, {1, 2}}};
  for (const auto& [i, j] : pairs) {
    const Everywhere &a = shapes[static_cast<std::size_t>(i)],
                     &b = shapes[static_cast<std::size_t>(j)];
    compare_distances(a, b, list);
    compare_overlaps(a, b, list);
    compare_casts(a, b, list);
  }
}
