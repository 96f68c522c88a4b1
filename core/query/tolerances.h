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
/// squared lengths). The paper proposes ten times the machine epsilon, for errors of |v|^2 in
/// proportion to max|x-p|^2, as Johnson's determinants have them. Our closest point is rounded to
/// a few epsilon of |x - p| itself, so its square may be required.
template <class T>
inline constexpr T gjk_squared = T(16) * epsilon<T>* T(16) * epsilon<T>;

/// Support points are themselves rounded to the shape's size R, however close to x they lie: the
/// loop also ends when |v| <= this * R.
template <class T>
inline constexpr T gjk_rounding = T(4) * epsilon<T>;

/// If |v| no longer shrinks and the lower bound no longer moves, rounding decides: a hit if |v| <=
/// this * R, exhausted otherwise. Nearly flat simplices lose up to six bits more than single
/// support points.
template <class T>
inline constexpr T gjk_stalled = T(256) * epsilon<T>;
/// Long double answers are given, and proven, in double.
template <>
inline constexpr long double gjk_stalled<long double> = 256 * epsilon<double>;

/// A tetrahedron lower than this, relative to its vertices' largest coordinate, is flat: a vertex,
/// a normal and their product are rounded by about as much.
template <class T>
inline constexpr T flat_simplex = T(8) * epsilon<T>;

/// The GJK ray cast converges linearly: on smooth shapes it was seen to need 60 support points for
/// the tolerance above, and up to twice that for extents of 1:1000.
inline constexpr int gjk_max_iterations = 1000;

/// The jet cast ends when the model's hit lies no further than this beyond the best lower bound, as
/// a distance between planes in units of the bounding radius: what rounding leaves of a support
/// plane's offset (a few roundings each of the support point, its move to the ray, and the plane).
template <class T>
inline constexpr T jet_gap = T(4) * epsilon<T>;

/// Uncertainty of the distance between a plane and a ray's point, in units of the bounding radius:
/// half an epsilon of R each for the support point, its way from the centre and the ray's point,
/// one for the difference of up to 2 R, three for its product with the normal. Intervals allow for
/// it.
template <class T>
inline constexpr T plane_rounding = T(8) * epsilon<T>;

/// Slope up to which a supporting plane does not determine where along the ray the shape begins,
/// except for what lies clearly beyond rounding: its normal's component against the ray. Rays at
/// plates of 1:1000 were found to need 1e-4 in float; rays in the plane of a face have a few
/// epsilon.
template <class T>
inline constexpr T least_slope = std::is_same_v<T, float> ? T(0x1p-16) : T(0x1p-36);

/// Hits whose normal's component against the ray is less than this are checked again where the
/// shape may have corners: rounding across the plane is so much longer along the ray, and past a
/// corner the ray leaves the shape's neighbourhood. Rays within 3e-5 R of a round silhouette;
/// other hits are known along the ray to 2^7 times their uncertainty across it.
template <class T>
inline constexpr T uncertain_slope = T(0x1p-7);

/// This is the same of shapes without flat faces, whose surface turns away from the ray as their
/// planes become steep, and of the planes between which an origin is inside; float needs none.
template <class T>
inline constexpr T uncertain_smooth_slope = std::is_same_v<T, float> ? T(0) : T(0x1p-12);

/// Rounding of images under maps, in units of the summands' magnitude: three products and their
/// sums, the inverse map's numbers, half an epsilon each; and as much for the entries of a
/// rotation that was made of a quaternion.
template <class T>
inline constexpr T map_rounding = T(4) * epsilon<T>;

/// Rounding of a support point that is made of larger coordinates than it ends up with.
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

/// Losses of a ray's place, in units of the bounding radius, up to which they only widen a hit's
/// interval; beyond that, all rays within the loss must agree on the result. A thousand roundings:
/// rays that pass an edge so near are as rare.
template <class T>
inline constexpr T small_loss = T(1024) * epsilon<T>;

/// The last word on a hit, whatever the planes' slopes: model and best plane agree so well along
/// the ray, in units of the bounding radius. A gap of jet_gap at a slope of 1e-3 in float and 1e-6
/// in double.
template <class T>
inline constexpr T jet_gap_along = std::is_same_v<T, float> ? T(0x1p-11) : T(0x1p-30);

/// Depth to which a line that is tangent within rounding is pushed into the shape to find where it
/// enters, in units of the bounding radius: more than jet_gap.
template <class T>
inline constexpr T tangent_push = T(8) * epsilon<T>;

/// Distance from the ray, in units of the bounding radius, up to which a point of the model counts
/// as on it, and by which a feature must reach further than another to matter: a few roundings of
/// a position. Also the sine below which a direction counts as at right angles to the ray.
template <class T>
inline constexpr T model_rounding = T(8) * epsilon<T>;

/// Change of the direction (of 1; squared) at which the search on a hull of sums, which converges
/// quadratically, has used up the digits: the value's error is the square.
template <class T>
inline constexpr T settled_squared = T(4) * epsilon<T>;

/// Distance from its point, in units of the bounding radius, squared, at which the ray may cross
/// the tangent plane of a hull of sums: the surface is lower there by half of it over the radius
/// of curvature.
template <class T>
inline constexpr T on_the_ray_squared = T(0.36) * epsilon<T>;

/// Sizes up to which, and down to whose inverse, shapes are cast at as they are: fourth powers,
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
/// cast takes over: smooth shapes were seen to need up to 60 in double.
inline constexpr int portal_max_iterations = 256;

/// Margin around a bounding ball within which a ray still counts as a hit, relative to the radius.
template <class T>
inline constexpr T ball_padding = T(8) * epsilon<T>;

/// Margin beyond its end within which a ray still meets the shape, in units of the bounding
/// radius: a few roundings of a position. The result's t is not beyond t_max.
template <class T>
inline constexpr T end_slack = T(8) * epsilon<T>;

/// Distances of origins, in units of the bounding radius, up to which moving a ray near the shape
/// loses no digits, both in the shape's own frame: the first step's error is 2^-24 or 2^-53 of the
/// distance, the second's as much of that.
template <class T>
inline constexpr T far_origin = std::is_same_v<T, float> ? T(0x1p24) : T(0x1p53);

/// Distances beyond which no pair of numbers, t_base and t_offset, determines where on the shape a
/// ray arrives (float), or the ray moved in long double has lost its digits (double): a cast from
/// there is exhausted.
template <class T>
inline constexpr T farthest_origin = std::is_same_v<T, float> ? T(0x1p46) : T(0x1p62);

/// Radii from the frame's origin beyond which a shape's neighbourhood is rounded too coarsely in
/// float, whose steps there are 2^-24 of that: 3e-5 of the radius.
inline constexpr double far_out = 0x1p9;

/// Distance from a bounding box, relative to the sizes of the summands, up to which a line counts
/// as meeting it: origin and direction, mapped, are sums of up to four rounded numbers, and their
/// cross product and the box's reach round a few times more.
template <class T>
inline constexpr T box_padding = T(8) * epsilon<T>;

/// Uncertainty that closed forms assume of a position near the shape, in units of the form's
/// radius: E / R of docs/forms.md ("Casts with an error bound"). Float rays, computed in double:
/// origins up to form_far away are moved with an error of 2^-33 R, and leave up to 5 times that
/// along the ray. Double rays: the two steps' rounding and some twenty operations' after them,
/// 2^-53 each.
template <class T>
inline constexpr double form_rounding = std::is_same_v<T, float> ? 0x1p-30 : 0x1p-49;

/// The share of the squared direction below which the part of it across an axis moves the ray by
/// less than E / 4 while it passes the shape: (E / R)^2 / 16.
template <class T>
inline constexpr double form_parallel = form_rounding<T>* form_rounding<T> / 16;

/// Distances of origins, in units of the form's radius, up to which closed forms are used: from
/// there 2^-53 is form_rounding's 2^-33 for float rays.
inline constexpr double form_far = 0x1p20;

/// Largest ratio of a map's rounding to that of a form's own points at which forms are used, whose
/// bounds leave out squares of errors: 2^-30 of the radius.
inline constexpr double form_worst_map = 0x1p19;

/// Increase of the bound by the rounding of t's bound and of t: a share of itself, and epsilons of
/// the offset; for double rays also the rounding of the ray's length and its inverse.
inline constexpr double form_margin = 0x1p-20;
template <class T>
inline constexpr double form_digits = (std::is_same_v<T, float> ? 1 : 8) * double(epsilon<T>);

/// Rays in double have this limit for lengths of directions and for their inverses.
inline constexpr double form_longest_step = 1e250;

/// Bounds closeness to tangency: r^2 - |x|^2 of the closest point x is known to 2 r |dx| and a few
/// roundings of r^2, less than this times E r.
inline constexpr double form_tangent = 4;

/// The share of their distance by which two planes may cross within the cylinder that they cut:
/// what double rounds of where they touch.
inline constexpr double form_touching = 0x1p-50;

/// Limits of what docs/forms.md derives bounds for, of forms that narrow: their apex' height in
/// units of their radius, the smaller ball's radius in units of the larger one's, and the sine of a
/// mantle's slope.
inline constexpr double tapered_farthest_apex = 8;
inline constexpr double tapered_least_ball = 0x1p-10;
inline constexpr double tapered_steepest = 0.99;

/// Rounding of the crossing of a polytope's plane and a line, across the plane, in units of the
/// polytope's radius: the plane's offset 1, the line's height 5 and its slope 3 (three products
/// and their sum each), the way 2, 2^-53 each, and one more.
inline constexpr double polytope_rounding = 12 * 0x1p-53;

/// The least height of a triangle, in radii of its polytope, at which rounded polytopes use their
/// features: the rounding that hides adjacent features grows by its inverse.
inline constexpr double rounded_polytope_height = 0x1p-12;

/// The error E of a line, in units of the radius that a polytope is grown by, from which on the
/// normals of its features are known less well than points.
inline constexpr double rounded_line_error = 0x1p-40;

/// Bounds the displacement of a polytope's corner, viewed along a line that is known to E, in
/// units of E: E of the line, and 20 * 2^-53 of the radius for the view's axes and its products; E
/// includes 12 of these.
inline constexpr double polytope_beside = 4;

/// The GJK distance ends when |v|^2 - v.w <= this * |v| (|v| + R): v.w is a difference of numbers
/// of size |v| (|v| + R), each rounded to an epsilon of that. The distance is then known to a few
/// epsilon of itself and of the objects' size.
template <class T>
inline constexpr T distance_gap = T(4) * epsilon<T>;

/// Polytopes end by themselves, and of smooth shapes the worst seen (ellipsoids of 1:1000) needed
/// fewer than 200.
inline constexpr int distance_max_iterations = 400;

/// Algorithm 1 was seen to need some 1500 support points in its nested queries for grazing rays.
inline constexpr int first_solution_max_supports = 10000;

/// Distance by which the shapes are parted to find where they touched, relative to their sizes'
/// sum: hits are precise to a few epsilon, those that stalled to gjk_stalled.
template <class T>
inline constexpr T contact_back_off[] = {T(8) * epsilon<T>, T(64) * epsilon<T>,
                                         T(512) * epsilon<T>};

/// The sine below which two edges of a face are taken for parallel: support points that are
/// differences of two shapes' are each rounded, in a line or not.
template <class T>
inline constexpr T collinear = T(4) * epsilon<T>;

/// Proofs end so far along the ray from the ball's centre, in its radii: nothing further matters.
inline constexpr double proof_reach = 2;

/// Factor by which a proof may exceed double's rounding: the middle of a sliver is known so much
/// less precisely than its corners.
inline constexpr double proof_roundings = 16;

/// Precision at which the search for a proof stops, in machine epsilons of the size: a quarter of
/// what the checker allows.
inline constexpr double proof_good_enough = 16;

/// A hit found again this near to the claimed one, along the normal in epsilons of the claim's
/// precision, counts as the same.
inline constexpr double proof_close_to_claim = 32;

/// A spanned point no further off than this, in machine epsilons of the size, is as good as one on
/// the hit point: the support points are rounded as coarsely.
inline constexpr double proof_on_the_spot = 2;

/// Uncertainty of a position in float lanes, in units of the magnitude of its summands: 32
/// roundings by 2^-24: twelve for the way to the form (listed in docs/forms.md), twenty for what
/// the form does with it.
inline constexpr float screen_rounding = 0x1p-19f;

/// Positions must be known to this share of a form's least radius: squares of errors, which the
/// forms' bounds leave out, are then far below the bounds.
inline constexpr float screen_largest_share = 0x1p-6f;

/// Squared lengths of directions in a form's frame, and radii, between which all numbers of float
/// lanes are float's.
inline constexpr float screen_shortest_squared = 1e-8f;
inline constexpr float screen_longest_squared = 1e8f;
inline constexpr double screen_least_radius = 1e-7;
inline constexpr double screen_largest_radius = 1e7;

/// Uncertainty of t in float lanes, in units of its own size: t is a sum of two numbers.
inline constexpr float screen_digits = 0x1p-21f;

/// A box around a shape that has no form is made wider by this share of the shape's radius: more
/// than any solver allows a float hit to be off.
inline constexpr double screen_box_margin = 0x1p-13;

}  // namespace minkray::tolerance
