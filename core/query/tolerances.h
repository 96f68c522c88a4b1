// SPDX-License-Identifier: MIT
// Every tolerance of the solvers, with its unit and its reason. All are relative: to the shape's
// size, or to the numbers that are compared. Numbers that guide a search without changing its
// results are in the file of the search. The checker of certificates must be independent of the
// solvers, so it has its own tolerances (core/proof/check_certificate.h).
#pragma once

#include <limits>
#include <type_traits>

namespace minkray::tolerance {

/// Machine epsilon: the distance from 1 to the next number.
template <class T>
inline constexpr T epsilon = std::numeric_limits<T>::epsilon();

/// eps_tol of the GJK ray cast: the loop ends when |v|^2 <= eps_tol * max|x - p|^2 (a ratio of
/// squared lengths). The paper proposes ten times the machine epsilon, since Johnson's determinants
/// have errors of |v|^2 proportional to max|x-p|^2. Our closest point has errors of only a few
/// epsilon of |x - p|, so eps_tol is the square of these.
template <class T>
inline constexpr T gjk_squared = T(16) * epsilon<T>* T(16) * epsilon<T>;

/// The loop also ends when |v| <= this * R, since support points are rounded relative to the
/// shape's size R, however close to x they are.
template <class T>
inline constexpr T gjk_rounding = T(4) * epsilon<T>;

/// If |v| no longer shrinks and the lower bound no longer rises, only rounding is left. The result
/// is then a hit if |v| <= this * R, otherwise exhausted. Nearly flat simplices lose up to six bits
/// more than single support points.
template <class T>
inline constexpr T gjk_stalled = T(256) * epsilon<T>;
/// Results in long double are returned, and proven, in double.
template <>
inline constexpr long double gjk_stalled<long double> = 256 * epsilon<double>;

/// A tetrahedron counts as flat if its height is less than this, relative to its vertices' largest
/// coordinate. The rounding of a vertex, a normal and their product is about as large.
template <class T>
inline constexpr T flat_simplex = T(8) * epsilon<T>;

/// The GJK ray cast converges linearly: on smooth shapes it needed up to 60 support points for the
/// tolerance above, and twice as many for extents of 1:1000.
inline constexpr int gjk_max_iterations = 1000;

/// The jet cast ends when the model's hit lies at most this far beyond the best lower bound: a
/// distance between planes, in units of the bounding radius. Equals the rounding of a supporting
/// plane's offset (a few roundings each of the support point, its move to the ray, and the plane).
template <class T>
inline constexpr T jet_gap = T(4) * epsilon<T>;

/// Uncertainty of the distance between a plane and a ray's point, in units of the bounding radius
/// R; intervals of hits include it. Sums half an epsilon each for the support point, its vector
/// from the centre and the ray's point, one epsilon for their difference (up to 2 R), and three for
/// the product with the normal.
template <class T>
inline constexpr T plane_rounding = T(8) * epsilon<T>;

/// The slope of a supporting plane is its normal's component against the ray. A plane with at most
/// this slope is nearly parallel to the ray, so rounding decides where along the ray it is crossed.
/// For rays in the plane of a face, the slope is a few epsilon.
template <class T>
inline constexpr T least_slope = T(0x1p-36);

/// Hits at planes with a smaller slope are checked again if the shape may have corners. The
/// uncertainty along the ray is the rounding across the plane, divided by the slope; over this
/// length the ray may pass a corner and leave the shape. Affects rays within 3e-5 R of a round
/// silhouette. For other hits the uncertainty along the ray is at most 2^7 times that across the
/// plane.
template <class T>
inline constexpr T uncertain_slope = T(0x1p-7);

/// Same for shapes without flat faces, whose surface turns away from the ray at small slopes. Also
/// for the two planes that prove that the ray's origin is inside.
template <class T>
inline constexpr T uncertain_smooth_slope = T(0x1p-12);

/// Rounding of images under maps, in units of the summands' magnitude. Half an epsilon each for
/// three products, their sums and the inverse map's numbers; the same again for the entries of a
/// rotation matrix that was computed from a quaternion.
template <class T>
inline constexpr T map_rounding = T(4) * epsilon<T>;

/// Rounding of a support point that is computed from larger coordinates, in units of the latter.
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

/// Uncertainty (loss) of a ray's position, in units of the bounding radius. A smaller loss only
/// widens the interval of a hit. For a larger loss, all rays within the loss must have the same
/// status. Equals a thousand roundings, since few rays pass an edge so closely.
template <class T>
inline constexpr T small_loss = T(1024) * epsilon<T>;

/// Largest distance along the ray between the model's hit and the best plane for a hit, for any
/// slope of the planes. In units of the bounding radius. Equals a gap of jet_gap at a slope of
/// 1e-6.
template <class T>
inline constexpr T jet_gap_along = T(0x1p-30);

/// A line that is tangent within rounding is moved this deep into the shape to find where it
/// enters. In units of the bounding radius; more than jet_gap.
template <class T>
inline constexpr T tangent_push = T(8) * epsilon<T>;

/// A few roundings of a position, in units of the bounding radius. A point of the model at most
/// this far from the ray counts as on the ray. A feature must reach further than another by more
/// than this to matter. Also the sine below which a direction counts as perpendicular to the ray.
template <class T>
inline constexpr T model_rounding = T(8) * epsilon<T>;

/// The search on a hull of sums ends at this squared change of the unit direction. The search
/// converges quadratically, so the error of the value is then about as small as rounding.
template <class T>
inline constexpr T settled_squared = T(4) * epsilon<T>;

/// Limit for hits on a hull of sums: the squared distance between the point where the ray crosses a
/// tangent plane and the point where that plane touches. In units of the squared bounding radius.
/// At this distance from the point of contact, the surface is below the plane by half of the
/// squared distance divided by the radius of curvature.
template <class T>
inline constexpr T on_the_ray_squared = T(0.36) * epsilon<T>;

/// Shapes whose size is from 1 / this to this are cast at without scaling: fourth powers of sizes,
/// times the square of epsilon, are then in the range of T.
template <class T>
inline constexpr T ordinary_size = T(0x1p128);

/// A direction counts as the axis of a disk if the disk's reach along it is at most this, relative
/// to the disk's size: a few roundings of either.
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

/// A shape that begins at most this far beyond the ray's end is still hit, in units of the bounding
/// radius: a few roundings of a position. The result's t is not beyond t_max.
template <class T>
inline constexpr T end_slack = T(8) * epsilon<T>;

/// Distance of an origin up to which moving the ray near the shape loses no digits, in the shape's
/// own frame and in units of the bounding radius. The first step's error is 2^-24 (float) or 2^-53
/// (double) of the distance; the second step's error is the same fraction of the first step's
/// error.
template <class T>
inline constexpr T far_origin = std::is_same_v<T, float> ? T(0x1p24) : T(0x1p53);

/// Distance of an origin beyond which casts are exhausted: the ray moved in long double has lost
/// its digits.
inline constexpr double farthest_origin = 0x1p62;

/// Distance up to which a line counts as meeting a bounding box, relative to the sizes of the
/// summands. The mapped origin and direction are sums of up to four rounded numbers; their cross
/// product and the box's reach add a few roundings.
template <class T>
inline constexpr T box_padding = T(8) * epsilon<T>;

/// Error of a position near the shape that closed forms allow for, in units of the form's radius: E
/// / R of docs/forms.md ("Casts with an error bound"). Rounding of the two steps that move the ray
/// and of some twenty operations after them, 2^-53 each.
inline constexpr double form_rounding = 0x1p-49;

/// (E / R)^2 / 16. A component of the direction counts as zero if its square is less than this
/// share of the squared direction: it moves the ray by less than E / 4 while the ray passes the
/// shape.
inline constexpr double form_parallel = form_rounding * form_rounding / 16;

/// Distance of an origin, in units of the form's radius, up to which closed forms are used.
inline constexpr double form_far = 0x1p20;

/// Largest ratio of a map's rounding to the rounding of the form's own points for which forms are
/// used. The error is then at most 2^-30 of the radius, and forms' bounds may neglect its square.
inline constexpr double form_worst_map = 0x1p19;

/// The bound of t is rounded, too, and is increased by form_margin times itself. form_digits allows
/// for the rounding of t, relative to the offset and the shift.
inline constexpr double form_margin = 0x1p-20;
inline constexpr double form_digits = 8 * epsilon<double>;

/// Largest length of directions, and of their inverses, for closed forms.
inline constexpr double form_longest_step = 1e250;

/// Error bound of r^2 - |x|^2, where x is the line's point closest to the centre, in units of E r:
/// 2 r |dx| and a few roundings of r^2. The form does not decide lines nearer to tangency.
inline constexpr double form_tangent = 4;

/// Two planes that cut a cylinder may cross inside it by this fraction of their distance, since the
/// numbers of planes that touch are rounded to double.
inline constexpr double form_touching = 0x1p-50;

/// Limits of the tapered forms for which docs/forms.md derives bounds: the height of the apex in
/// units of the radius, the ratio of the smaller ball's radius to the larger one's, and the sine of
/// the slope of the lateral surface.
inline constexpr double tapered_farthest_apex = 8;
inline constexpr double tapered_least_ball = 0x1p-10;
inline constexpr double tapered_steepest = 0.99;

/// Rounding, across the plane, of the point where a line crosses a polytope's plane, in units of
/// the polytope's radius. In multiples of 2^-53: 1 for the plane's offset, 5 for the line's height
/// and 3 for its slope (three products and their sum each), 2 for the length along the line, and 1
/// more.
inline constexpr double polytope_rounding = 12 * 0x1p-53;

/// Rounded polytopes use their features only if each triangle's height is at least this, in units
/// of the polytope's radius. The rounding that confuses adjacent features is proportional to 1 /
/// height.
inline constexpr double rounded_polytope_height = 0x1p-12;

/// If the error E of a line is above this, in units of the radius by which a polytope is rounded,
/// normals of the polytope's features are less precise than points.
inline constexpr double rounded_line_error = 0x1p-40;

/// Bounds the displacement of a polytope's corner, projected along a line with the error E, in
/// units of E. The sum of E itself and of 20 * 2^-53 of the radius for the projection's axes and
/// products; E is at least 12 * 2^-53 of the radius.
inline constexpr double polytope_beside = 4;

/// The GJK distance ends when |v|^2 - v.w <= this * |v| (|v| + R). v.w is a difference of numbers
/// of size |v| (|v| + R), each rounded to an epsilon of that size. The error of the distance is
/// then a few epsilon of the distance and of the objects' size.
template <class T>
inline constexpr T distance_gap = T(4) * epsilon<T>;

/// Limit of iterations. Searches on polytopes end by themselves; the worst smooth shapes
/// (ellipsoids of 1:1000) needed fewer than 200.
inline constexpr int distance_max_iterations = 400;

/// Limit of support points. Algorithm 1 needed some 1500 in its nested queries for grazing rays.
inline constexpr int first_solution_max_supports = 10000;

/// Distances by which shapes are moved apart to find the point of contact, relative to the sum of
/// their sizes. Hits are precise to a few epsilon, and hits of stalled casts to gjk_stalled.
template <class T>
inline constexpr T contact_back_off[] = {T(8) * epsilon<T>, T(64) * epsilon<T>,
                                         T(512) * epsilon<T>};

/// Sine below which two edges of a face count as parallel. Support points that are differences of
/// two shapes' points are rounded, so edges on one line may form a slight angle.
template <class T>
inline constexpr T collinear = T(4) * epsilon<T>;

/// Length of the part of a ray that proofs use, measured both ways from its point closest to the
/// bounding ball's centre, in radii of the ball.
inline constexpr double proof_reach = 2;

/// Factor by which the error of a proof may exceed the rounding of double: the middle of a sliver
/// triangle is less precise than its corners by this factor.
inline constexpr double proof_roundings = 16;

/// Precision at which the search for a proof stops, in machine epsilons of the size: a quarter of
/// the checker's tolerance.
inline constexpr double proof_good_enough = 16;

/// The proof search computes its own hit. This counts as the claimed hit up to this distance along
/// the normal, in epsilons of the claim's precision.
inline constexpr double proof_close_to_claim = 32;

/// A point spanned by support points counts as the hit point up to this distance, in machine
/// epsilons of the size: support points are rounded as coarsely.
inline constexpr double proof_on_the_spot = 2;

/// Uncertainty of a position in float lanes, in units of the magnitude of its summands. 32
/// roundings by 2^-24: twelve for the position relative to the form (listed in docs/forms.md), and
/// twenty for the form's operations.
inline constexpr float screen_rounding = 0x1p-19f;

/// Largest error of positions for which lanes are used, relative to a form's least radius. Squares
/// of errors, which the forms' bounds neglect, are then far below the bounds.
inline constexpr float screen_largest_share = 0x1p-6f;

/// Limits of squared lengths of directions in a form's frame, and of its radii. Within these
/// limits, numbers in float lanes neither overflow nor underflow.
inline constexpr float screen_shortest_squared = 1e-8f;
inline constexpr float screen_longest_squared = 1e8f;
inline constexpr double screen_least_radius = 1e-7;
inline constexpr double screen_largest_radius = 1e7;

/// Uncertainty of t in float lanes, in units of its own size: t is a sum of two numbers.
inline constexpr float screen_digits = 0x1p-21f;

/// Margin of the box around a shape without a form, relative to the shape's radius: more than the
/// error that any solver allows for a hit in float.
inline constexpr double screen_box_margin = 0x1p-13;

}  // namespace minkray::tolerance
