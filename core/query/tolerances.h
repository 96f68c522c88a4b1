// SPDX-License-Identifier: MIT
// Every tolerance of the solvers, with its unit and its reason. All are relative: to the shape's
// size, or to the numbers they are compared with. Numbers that steer a search without changing its
// results are next to the search; the checker of certificates, which must not depend on what it
// checks, has its own (core/proof/check_certificate.h).
#pragma once

#include <limits>
#include <type_traits>

namespace minkray::tolerance {

/// Machine epsilon: the distance from 1 to the next number.
template <class T>
inline constexpr T epsilon = std::numeric_limits<T>::epsilon();

/// eps_tol of the GJK ray cast: the loop ends when |v|^2 <= eps_tol * max|x - p|^2 (a ratio of
/// squared lengths). The paper proposes ten times the machine epsilon, since Johnson's determinants
/// have errors of |v|^2 proportional to max|x-p|^2. Our closest point is rounded to a few epsilon
/// of |x - p| itself, so eps_tol is the square of that.
template <class T>
inline constexpr T gjk_squared = T(16) * epsilon<T>* T(16) * epsilon<T>;

/// Support points are rounded relative to the shape's size R, however close to x they are: the loop
/// also ends when |v| <= this * R.
template <class T>
inline constexpr T gjk_rounding = T(4) * epsilon<T>;

/// If |v| no longer shrinks and the lower bound no longer moves, rounding decides: a hit if |v| <=
/// this * R, exhausted otherwise. Nearly flat simplices lose up to six bits more than single
/// support points.
template <class T>
inline constexpr T gjk_stalled = T(256) * epsilon<T>;
/// Results in long double are returned, and proven, in double.
template <>
inline constexpr long double gjk_stalled<long double> = 256 * epsilon<double>;

/// A tetrahedron lower than this, relative to its vertices' largest coordinate, is flat: a vertex,
/// a normal and their product are rounded by about as much.
template <class T>
inline constexpr T flat_simplex = T(8) * epsilon<T>;

/// The GJK ray cast converges linearly: on smooth shapes it needed up to 60 support points for the
/// tolerance above, and twice as many for extents of 1:1000.
inline constexpr int gjk_max_iterations = 1000;

/// The jet cast ends when the model's hit lies no further than this beyond the best lower bound, as
/// a distance between planes in units of the bounding radius: the rounding of a supporting plane's
/// offset (a few roundings each of the support point, its move to the ray, and the plane).
template <class T>
inline constexpr T jet_gap = T(4) * epsilon<T>;

/// Uncertainty of the distance between a plane and a ray's point, in units of the bounding radius:
/// half an epsilon of R each for the support point, its way from the centre and the ray's point,
/// one for the difference of up to 2 R, three for its product with the normal. Intervals include
/// it.
template <class T>
inline constexpr T plane_rounding = T(8) * epsilon<T>;

/// Slope of a supporting plane (its normal's component against the ray) up to which the plane does
/// not determine where along the ray the shape begins, except clearly beyond rounding. Rays at
/// plates of 1:1000 needed 1e-4 in float; for rays in the plane of a face, the slope is a few
/// epsilon.
template <class T>
inline constexpr T least_slope = std::is_same_v<T, float> ? T(0x1p-16) : T(0x1p-36);

/// Hits whose normal's component against the ray is less than this are checked again if the shape
/// may have corners: rounding across the plane is longer along the ray by the inverse of the slope,
/// and past a corner the ray leaves the shape's neighbourhood. Concerns rays within 3e-5 R of a
/// round silhouette; the uncertainty of other hits along the ray is up to 2^7 times that across.
template <class T>
inline constexpr T uncertain_slope = T(0x1p-7);

/// Same for shapes without flat faces, whose surface turns away from the ray as their planes become
/// steep, and for the planes between which an origin is inside. Float needs none.
template <class T>
inline constexpr T uncertain_smooth_slope = std::is_same_v<T, float> ? T(0) : T(0x1p-12);

/// Rounding of images under maps, in units of the summands' magnitude: three products and their
/// sums, the inverse map's numbers, half an epsilon each; and as much for the entries of a rotation
/// computed from a quaternion.
template <class T>
inline constexpr T map_rounding = T(4) * epsilon<T>;

/// Rounding of a support point that is computed from larger coordinates than its own.
template <class T>
inline constexpr T support_rounding = T(2) * epsilon<T>;

/// Bounds the displacement of a point by the transpose of a matrix that keeps lengths
/// (core/math/affine.h), in units of its distance from the centre.
template <class T>
inline constexpr T transposed_rounding = T(4) * epsilon<T>;

/// Bounds the displacement of a shape by the rounding of a rotation's entries, in units of the
/// distance of its centre from the origin of its frame.
template <class T>
inline constexpr T turned_rounding = T(8) * epsilon<T>;

/// Rounding of a near ray's parameter, in units of its parts.
template <class T>
inline constexpr T offset_rounding = T(4) * epsilon<T>;

/// Loss of a ray's place, in units of the bounding radius, up to which it only widens a hit's
/// interval. For a larger loss, all rays within it must agree on the result. A thousand roundings:
/// few rays pass an edge so closely.
template <class T>
inline constexpr T small_loss = T(1024) * epsilon<T>;

/// Largest distance along the ray between model and best plane for a hit, whatever the planes'
/// slopes, in units of the bounding radius. Equals a gap of jet_gap at a slope of 1e-3 in float and
/// 1e-6 in double.
template <class T>
inline constexpr T jet_gap_along = std::is_same_v<T, float> ? T(0x1p-11) : T(0x1p-30);

/// Depth to which a line that is tangent within rounding is pushed into the shape to find where it
/// enters, in units of the bounding radius: more than jet_gap.
template <class T>
inline constexpr T tangent_push = T(8) * epsilon<T>;

/// Distance from the ray, in units of the bounding radius, up to which a point of the model counts
/// as on it, and by which a feature must reach further than another to matter: a few roundings of a
/// position. Also the sine below which a direction counts as perpendicular to the ray.
template <class T>
inline constexpr T model_rounding = T(8) * epsilon<T>;

/// Squared change of the unit direction at which the search on a hull of sums, which converges
/// quadratically, has no digits left to gain: the error of the value is that square.
template <class T>
inline constexpr T settled_squared = T(4) * epsilon<T>;

/// Squared distance, in units of the bounding radius, up to which the ray may cross a tangent plane
/// of a hull of sums from the point where the plane touches: the surface is lower there by half of
/// it, divided by the radius of curvature.
template <class T>
inline constexpr T on_the_ray_squared = T(0.36) * epsilon<T>;

/// Size up to which, and down to its inverse, shapes are cast at without scaling: fourth powers,
/// with room for the square of epsilon, are in the range of T.
template <class T>
inline constexpr T ordinary_size = std::is_same_v<T, float> ? T(0x1p16) : T(0x1p128);

/// Reach of a disk along a direction, relative to its size, up to which the direction counts as
/// its axis: a few roundings of either.
template <class T>
inline constexpr T flat_disk = T(8) * epsilon<T>;

/// Support calls of the jet cast before the GJK ray cast takes over.
inline constexpr int jet_max_iterations = 48;

/// Support calls of the portal cast, which converges linearly on curved shapes, before the GJK ray
/// cast takes over: smooth shapes needed up to 60 in double.
inline constexpr int portal_max_iterations = 256;

/// Margin around a bounding ball within which a ray still counts as a hit, relative to the radius.
template <class T>
inline constexpr T ball_padding = T(8) * epsilon<T>;

/// Margin beyond a ray's end within which the ray still meets the shape, in units of the bounding
/// radius: a few roundings of a position. The result's t is not beyond t_max.
template <class T>
inline constexpr T end_slack = T(8) * epsilon<T>;

/// Distance of an origin, in units of the bounding radius and in the shape's own frame, up to which
/// moving a ray near the shape loses no digits: the first step's error is 2^-24 or 2^-53 of the
/// distance, the second step's error the same share of the first's.
template <class T>
inline constexpr T far_origin = std::is_same_v<T, float> ? T(0x1p24) : T(0x1p53);

/// Distance of an origin beyond which casts are exhausted: the pair t_base and t_offset no longer
/// determines the hit point on the shape (float), or the ray moved in long double has lost its
/// digits (double).
template <class T>
inline constexpr T farthest_origin = std::is_same_v<T, float> ? T(0x1p46) : T(0x1p62);

/// Distance of a shape from the frame's origin, in its radii, beyond which float is too coarse near
/// the shape: steps of float there are 2^-24 of the distance, or 3e-5 of the radius.
inline constexpr double far_out = 0x1p9;

/// Distance from a bounding box, relative to the sizes of the summands, up to which a line counts
/// as meeting it: origin and direction, mapped, are sums of up to four rounded numbers, and their
/// cross product and the box's reach round a few times more.
template <class T>
inline constexpr T box_padding = T(8) * epsilon<T>;

/// Uncertainty that closed forms assume of a position near the shape, in units of the form's
/// radius: E / R of docs/forms.md ("Casts with an error bound"). Float rays, computed in double:
/// origins up to form_far away are moved with an error of 2^-33 R, and up to 5 times that along the
/// ray. Double rays: rounding of the two steps and of some twenty operations after them, 2^-53
/// each.
template <class T>
inline constexpr double form_rounding = std::is_same_v<T, float> ? 0x1p-30 : 0x1p-49;

/// Share of the squared direction. A component across an axis whose square is a smaller share moves
/// the ray by less than E / 4 while it passes the shape: (E / R)^2 / 16.
template <class T>
inline constexpr double form_parallel = form_rounding<T>* form_rounding<T> / 16;

/// Distance of an origin, in units of the form's radius, up to which closed forms are used: 2^-53
/// of that distance is the error of 2^-33 in form_rounding for float rays.
inline constexpr double form_far = 0x1p20;

/// Largest ratio of a map's rounding to that of a form's own points at which forms are used: 2^-30
/// of the radius, since the forms' bounds neglect squares of errors.
inline constexpr double form_worst_map = 0x1p19;

/// Increases of the bound of t due to the rounding of the bound (a share of it) and of t (epsilons
/// of the offset; for double rays, also the rounding of the ray's length and its inverse).
inline constexpr double form_margin = 0x1p-20;
template <class T>
inline constexpr double form_digits = (std::is_same_v<T, float> ? 1 : 8) * double(epsilon<T>);

/// Limit of lengths of directions, and of their inverses, for rays in double.
inline constexpr double form_longest_step = 1e250;

/// Error bound of r^2 - |x|^2, x the line's closest point, in units of E r: the error is 2 r |dx|
/// and a few roundings of r^2. Lines nearer to tangency are in doubt.
inline constexpr double form_tangent = 4;

/// Share of their distance by which two planes may cross within the cylinder that they cut:
/// rounding in double of planes that touch.
inline constexpr double form_touching = 0x1p-50;

/// Limits of tapered forms for which docs/forms.md derives bounds: the apex' height in units of the
/// radius, the smaller ball's radius in units of the larger one's, and the sine of the mantle's
/// slope.
inline constexpr double tapered_farthest_apex = 8;
inline constexpr double tapered_least_ball = 0x1p-10;
inline constexpr double tapered_steepest = 0.99;

/// Rounding, across the plane, of the point where a line crosses a polytope's plane, in units of
/// the polytope's radius: 1 for the plane's offset, 5 for the line's height and 3 for its slope
/// (three products and their sum each), 2 for the way, and one more; 2^-53 each.
inline constexpr double polytope_rounding = 12 * 0x1p-53;

/// Least height of a triangle, in radii of its polytope, at which rounded polytopes use their
/// features: the rounding that makes adjacent features ambiguous is proportional to its inverse.
inline constexpr double rounded_polytope_height = 0x1p-12;

/// Error E of a line, in units of the radius that a polytope is grown by, above which normals of
/// its features are less precise than points.
inline constexpr double rounded_line_error = 0x1p-40;

/// Bounds the displacement of a polytope's corner, seen along a line with the error E, in units of
/// E: E of the line, and 20 * 2^-53 of the radius for the view's axes and its products; E includes
/// 12 of these.
inline constexpr double polytope_beside = 4;

/// The GJK distance ends when |v|^2 - v.w <= this * |v| (|v| + R): v.w is a difference of numbers
/// of size |v| (|v| + R), each rounded to an epsilon of that. The distance is then known to a few
/// epsilon of itself and of the objects' size.
template <class T>
inline constexpr T distance_gap = T(4) * epsilon<T>;

/// Limit of iterations. Searches on polytopes end by themselves; the worst smooth shapes
/// (ellipsoids of 1:1000) needed fewer than 200.
inline constexpr int distance_max_iterations = 400;

/// Limit of support points. Algorithm 1 needed some 1500 in its nested queries for grazing rays.
inline constexpr int first_solution_max_supports = 10000;

/// Distances by which shapes are moved apart to find the point of contact, relative to the sum of
/// their sizes: hits are precise to a few epsilon, stalled ones to gjk_stalled.
template <class T>
inline constexpr T contact_back_off[] = {T(8) * epsilon<T>, T(64) * epsilon<T>,
                                         T(512) * epsilon<T>};

/// Sine below which two edges of a face count as parallel: support points that are differences of
/// two shapes' points are rounded, even if they are collinear.
template <class T>
inline constexpr T collinear = T(4) * epsilon<T>;

/// Distance along the ray from the ball's centre, in its radii, at which proofs end.
inline constexpr double proof_reach = 2;

/// Factor by which a proof may exceed double's rounding: the middle of a sliver is so much less
/// precise than its corners.
inline constexpr double proof_roundings = 16;

/// Precision at which the search for a proof stops, in machine epsilons of the size: a quarter of
/// what the checker allows.
inline constexpr double proof_good_enough = 16;

/// Distance along the normal, in epsilons of the claim's precision, up to which a hit that was
/// found again counts as the claimed one.
inline constexpr double proof_close_to_claim = 32;

/// Distance, in machine epsilons of the size, up to which a spanned point counts as the hit point:
/// support points are rounded as coarsely.
inline constexpr double proof_on_the_spot = 2;

/// Uncertainty of a position in float lanes, in units of the magnitude of its summands: 32
/// roundings by 2^-24: twelve for the way to the form (listed in docs/forms.md), twenty for what
/// the form does with it.
inline constexpr float screen_rounding = 0x1p-19f;

/// Largest error of positions, as a share of a form's least radius: squares of errors, which the
/// forms' bounds neglect, are then far below the bounds.
inline constexpr float screen_largest_share = 0x1p-6f;

/// Limits of squared lengths of directions in a form's frame, and of radii, between which numbers
/// in float lanes do not over- or underflow.
inline constexpr float screen_shortest_squared = 1e-8f;
inline constexpr float screen_longest_squared = 1e8f;
inline constexpr double screen_least_radius = 1e-7;
inline constexpr double screen_largest_radius = 1e7;

/// Uncertainty of t in float lanes, in units of its own size: t is a sum of two numbers.
inline constexpr float screen_digits = 0x1p-21f;

/// Margin of the box around a shape without a form, as a share of the shape's radius: more than the
/// error that any solver allows of a float hit.
inline constexpr double screen_box_margin = 0x1p-13;

}  // namespace minkray::tolerance
