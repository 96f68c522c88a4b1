// SPDX-License-Identifier: MIT
// All tolerances of the solvers, each with unit and reason. All are relative: to the shape's size,
// or to the numbers that are compared. Numbers that guide a search without changing the results are
// in the file of the search. The checker of certificates must be independent of the solvers, so it
// has its own tolerances (core/proof/check_certificate.h).
#pragma once

#include <limits>
#include <type_traits>

namespace minkray::tolerance {

/// Machine epsilon: the distance from 1 to the next number.
template <class T>
inline constexpr T epsilon = std::numeric_limits<T>::epsilon();

/// The GJK ray cast ends when |v|^2 <= gjk_squared * max|x - p|^2, in the letters of
/// core/gjk/gjk_ray_cast.h. The paper, which calls this tolerance eps_tol, proposes ten times the
/// machine epsilon, since with Johnson's determinants the error of |v|^2 is proportional to max|x -
/// p|^2. Our closest point v has an error of only a few epsilon of |x - p|, so the tolerance is the
/// square of that error.
template <class T>
inline constexpr T gjk_squared = T(16) * epsilon<T>* T(16) * epsilon<T>;

/// The GJK ray cast also ends when |v| <= gjk_rounding * R, since the rounding of support points is
/// relative to the shape's size R, however close to x the points are.
template <class T>
inline constexpr T gjk_rounding = T(4) * epsilon<T>;

/// If |v| no longer shrinks and the lower bound no longer rises, only rounding is left. The result
/// is then a hit if |v| <= gjk_stalled * R, otherwise exhausted. The points of nearly flat
/// simplices lose up to six bits more than single support points.
template <class T>
inline constexpr T gjk_stalled = T(256) * epsilon<T>;
/// Results in long double are returned, and proven, in double.
template <>
inline constexpr long double gjk_stalled<long double> = 256 * epsilon<double>;

/// A tetrahedron counts as flat if its height is less than this, relative to its vertices' largest
/// coordinate. The rounding of a vertex, a normal and their inner product is about as large.
template <class T>
inline constexpr T flat_simplex = T(8) * epsilon<T>;

/// Limit of iterations of the GJK ray cast. The cast converges linearly: smooth shapes needed up to
/// 60 support points, and twice as many for extents of 1:1000.
inline constexpr int gjk_max_iterations = 1000;

/// The jet cast ends when the plane at the model's hit lies at most this far behind the plane of
/// the best lower bound, in units of the bounding radius. Equals the rounding of a supporting
/// plane's offset (a few roundings each of the support point, its move to the ray, and the plane).
template <class T>
inline constexpr T jet_gap = T(4) * epsilon<T>;

/// Uncertainty of the distance between a plane and a ray's point, in units of the bounding radius
/// R; intervals of hits include this uncertainty. The sum of half an epsilon each for the support
/// point, its vector from the centre, and the ray's point; one epsilon for the difference of the
/// two points (up to 2 R); and three for the product with the normal.
template <class T>
inline constexpr T plane_rounding = T(8) * epsilon<T>;

/// The slope of a supporting plane is its normal's component against the ray. A plane with at most
/// this slope is nearly parallel to the ray, so rounding decides where the ray crosses the plane.
/// For rays in the plane of a face, the slope is a few epsilon.
template <class T>
inline constexpr T least_slope = T(0x1p-36);

/// Hits at planes with a smaller slope than this are checked again if the shape may have corners.
/// The uncertainty along the ray is the rounding across the plane, divided by the slope; over that
/// length the ray may pass a corner and leave the shape. Affects rays within 3e-5 R of a round
/// silhouette. For hits that are not checked again, the uncertainty along the ray is at most 2^7
/// times the rounding across the plane.
template <class T>
inline constexpr T uncertain_slope = T(0x1p-7);

/// Same as uncertain_slope, for shapes without flat faces: their surface turns away from the ray at
/// small slopes. Also used for the two planes that prove that the ray's origin is inside.
template <class T>
inline constexpr T uncertain_smooth_slope = T(0x1p-12);

/// Hits at planes with a smaller slope than this lose the stages' upper bound of t, and get another
/// if a triangle of support points proves one (enclosed_ray.h). Such a ray is within some 1e-12 R
/// of the surface over a length at which rounding of support points across the ray matters.
template <class T>
inline constexpr T bounded_slope = T(0x1p-20);

/// Rounding of points to which a map is applied, in units of the summands' magnitude. The sum of
/// half an epsilon each for three products, their sums and the inverse map's numbers, and the same
/// again for the entries of a rotation matrix that was computed from a quaternion.
template <class T>
inline constexpr T map_rounding = T(4) * epsilon<T>;

/// Rounding of a support point that is computed from larger coordinates, in units of the larger
/// coordinates.
template <class T>
inline constexpr T support_rounding = T(2) * epsilon<T>;

/// Bounds the displacement of a point by the transpose of a matrix that keeps lengths
/// (core/math/affine.h), in units of the point's distance from the centre.
template <class T>
inline constexpr T transposed_rounding = T(4) * epsilon<T>;

/// Bounds the displacement of a shape by the rounding of a rotation's entries, in units of the
/// distance from the origin of the shape's frame to the shape's centre.
template <class T>
inline constexpr T turned_rounding = T(8) * epsilon<T>;

/// Rounding of a ray's parameter near the shape, in units of the two parts whose sum is the
/// parameter (RayNearBall).
template <class T>
inline constexpr T offset_rounding = T(4) * epsilon<T>;

/// Limit of the loss (uncertainty of a ray's position), in units of the bounding radius. Up to this
/// limit, the loss only widens the interval of a hit. Above it, all rays within the loss must have
/// the same status. Equals a thousand roundings, since few rays pass an edge so closely.
template <class T>
inline constexpr T small_loss = T(1024) * epsilon<T>;

/// Largest distance along the ray between the model's hit and the best plane at which the result is
/// a hit, for any slope of the planes. In units of the bounding radius. Equals a gap of jet_gap at
/// a slope of 1e-6.
template <class T>
inline constexpr T jet_gap_along = T(0x1p-30);

/// A line that is tangent within rounding is moved this deep into the shape to find where it
/// enters. In units of the bounding radius; more than jet_gap.
template <class T>
inline constexpr T tangent_push = T(8) * epsilon<T>;

/// A few roundings of a position, in units of the bounding radius. A point of the model at most
/// this far from the ray counts as on the ray. A feature counts as reaching further than another
/// only if the difference is larger than this. Also the sine below which a direction counts as
/// perpendicular to the ray.
template <class T>
inline constexpr T model_rounding = T(8) * epsilon<T>;

/// The search on a hull of sums ends at this squared change of the unit direction. The search
/// converges quadratically, so the error of the value is then about as small as rounding.
template <class T>
inline constexpr T settled_squared = T(4) * epsilon<T>;

/// Limit for hits on a hull of sums: the squared distance between the point where the ray crosses a
/// tangent plane and the point where that plane touches the hull. In units of the squared bounding
/// radius. At this distance from the point of contact, the surface is below the plane by half of
/// the squared distance divided by the radius of curvature.
template <class T>
inline constexpr T on_the_ray_squared = T(0.36) * epsilon<T>;

/// Casts scale a shape to about unit size unless its size is from 1 / ordinary_size to
/// ordinary_size. In that range, fourth powers of sizes, times the square of epsilon, are in the
/// range of T.
template <class T>
inline constexpr T ordinary_size = T(0x1p128);

/// A direction counts as the axis of a disk if the disk's reach along the direction is at most
/// this, relative to the disk's size: a few roundings of reach and size.
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

/// Distance of a ray's origin, in the shape's own frame and in units of the bounding radius, up to
/// which the two steps that move the ray near the shape lose no digits. The first step's error is
/// 2^-24 (float) or 2^-53 (double) of the distance; the second step's error is the same fraction of
/// the first step's error.
template <class T>
inline constexpr T far_origin = std::is_same_v<T, float> ? T(0x1p24) : T(0x1p53);

/// Distance of a ray's origin beyond which casts are exhausted: moving the ray near the shape, in
/// long double, loses all digits.
inline constexpr double farthest_origin = 0x1p62;

/// Distance up to which a line counts as meeting a bounding box, relative to the sizes of the
/// summands. The mapped origin and direction are sums of up to four rounded numbers; the cross
/// product of the two and the box's reach add a few roundings.
template <class T>
inline constexpr T box_padding = T(8) * epsilon<T>;

/// Error E of a position near the shape that closed forms allow for, in units of the form's radius
/// R (docs/forms.md, "Casts with an error bound"). Includes the two steps that move the ray near
/// the shape and some twenty later operations, each with a rounding of 2^-53.
inline constexpr double form_rounding = 0x1p-49;

/// (E / R)^2 / 16. A component of the direction counts as zero if its square is less than this
/// share of the squared direction: such a component moves the ray by less than E / 4 while the ray
/// passes the shape.
inline constexpr double form_parallel = form_rounding * form_rounding / 16;

/// Distance of a ray's origin, in units of the form's radius, up to which closed forms are used.
inline constexpr double form_far = 0x1p20;

/// Closed forms are used if the ratio of a map's rounding to the rounding of the form's own points
/// is at most this. The error is then at most 2^-30 of the radius, and the forms' error bounds may
/// neglect the squared error.
inline constexpr double form_worst_map = 0x1p19;

/// Share by which a closed form's error bound of t is increased, since the bound itself is rounded.
inline constexpr double form_margin = 0x1p-20;

/// Rounding of t, in units of the two numbers that are added to t: the offset along the ray, and
/// the shift of the ray's origin.
inline constexpr double form_digits = 8 * epsilon<double>;

/// Largest length of directions, and of their inverses, for closed forms.
inline constexpr double form_longest_step = 1e250;

/// Error bound of r^2 - |x|^2, where x is the line's point closest to the centre, in units of E r.
/// The sum of 2 r |dx| and a few roundings of r^2. The form does not decide lines nearer to
/// tangency than this.
inline constexpr double form_tangent = 4;

/// Two planes that cut a cylinder may cross inside the cylinder by this fraction of the distance
/// between the planes, since the parameters of planes that only touch are rounded to double.
inline constexpr double form_touching = 0x1p-50;

/// Limits of the tapered forms for which docs/forms.md derives bounds: the height of the apex in
/// units of the radius, the ratio of the smaller ball's radius to the larger one's, and the sine of
/// the slope of the lateral surface.
inline constexpr double tapered_farthest_apex = 8;
inline constexpr double tapered_least_ball = 0x1p-10;
inline constexpr double tapered_steepest = 0.99;

/// Rounding, across the plane, of the point where a line crosses a polytope's plane, in units of
/// the polytope's radius. The sum of, in multiples of 2^-53: 1 for the plane's offset, 5 for the
/// line's height above the plane and 3 for the line's slope (three products and a sum each), 2 for
/// the length along the line, and 1 more.
inline constexpr double polytope_rounding = 12 * 0x1p-53;

/// Rounded polytopes use their features only if each triangle's height is at least this, in units
/// of the polytope's radius. The rounding that confuses adjacent features is proportional to 1 /
/// height.
inline constexpr double rounded_polytope_height = 0x1p-12;

/// If the error E of a line is above this, in units of the radius by which a polytope is rounded,
/// the features' normals are less precise than points on the features.
inline constexpr double rounded_line_error = 0x1p-40;

/// Bounds the displacement of a polytope's corner, projected along a line with the error E, in
/// units of E. The sum of E itself and of 20 * 2^-53 of the radius for the projection's axes and
/// products; E is at least 12 * 2^-53 of the radius.
inline constexpr double polytope_beside = 4;

/// Sine below which two edges of a face count as parallel. Support points that are differences of
/// two shapes' points are rounded, so edges on one line may form a slight angle.
template <class T>
inline constexpr T collinear = T(4) * epsilon<T>;

/// Proofs use the part of a ray that is at most this far, in radii of the bounding ball, from the
/// ray's point closest to the ball's centre.
inline constexpr double proof_reach = 2;

/// Factor by which the error of a proof may exceed the rounding of double: the middle of a sliver
/// triangle is less precise than its corners by this factor.
inline constexpr double proof_roundings = 16;

/// Precision at which the search for a proof stops, in machine epsilons of the size: a quarter of
/// the checker's tolerance.
inline constexpr double proof_good_enough = 16;

/// The proof search computes its own hit. The search's hit counts as the claimed hit up to this
/// distance along the normal, in epsilons of the claim's precision.
inline constexpr double proof_close_to_claim = 32;

/// A point spanned by support points counts as the hit point up to this distance, in machine
/// epsilons of the size. The rounding of support points is about as large.
inline constexpr double proof_on_the_spot = 2;

/// Uncertainty of a position in float lanes, in units of the magnitude of its summands. 32
/// roundings by 2^-24: twelve for the position relative to the form (listed in docs/forms.md), and
/// twenty for the form's operations.
inline constexpr float screen_rounding = 0x1p-19f;

/// Float lanes are used if the error of positions is at most this, relative to a form's least
/// radius. Squares of errors, which the forms' error bounds neglect, are then far below the bounds.
inline constexpr float screen_largest_share = 0x1p-6f;

/// Limits of the squared lengths of directions in a form's frame, and of the form's radii. Within
/// these limits, numbers in float lanes neither overflow nor underflow.
inline constexpr float screen_shortest_squared = 1e-8f;
inline constexpr float screen_longest_squared = 1e8f;
inline constexpr double screen_least_radius = 1e-7;
inline constexpr double screen_largest_radius = 1e7;

/// Uncertainty of t, a sum of two numbers, in float lanes, in units of t.
inline constexpr float screen_digits = 0x1p-21f;

/// Margin of the box around a shape without a form, relative to the shape's radius: more than the
/// error that any solver allows for a hit in float.
inline constexpr double screen_box_margin = 0x1p-13;

}  // namespace minkray::tolerance
