/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/camera.h"

#include "pattern/pattern.h"

#define PI 3.14159265358979323846
#define DEGREE (PI / 180)

/* As far as POV-Ray goes where a panoramic camera's tangent has no end. */
#define FAR 2e10
/* An Omnimax screen is this much wider than high, and is seen from this far down. */
#define OMNIMAX_SHAPE 1.283458
#define OMNIMAX_LOWEST (135 * DEGREE)
#define LENS_SHIFT 0.03125 /* of a pixel, right and down, that all in a picture with a lens is */

static vec combine(const struct camera *c, double right, double up, double ahead)
{
	return vec_mad(vec_mad(vec_scale(c->right, right), c->up, up), c->direction, ahead);
}

/* The same of unit vectors. */
static vec combine_unit(const struct camera *c, double right, double up, double ahead)
{
	vec a = vec_scale(vec_unit(c->right), right), b = vec_scale(vec_unit(c->up), up);

	return vec_mad(vec_add(a, b), vec_unit(c->direction), ahead);
}

/* At radius and angle around the direction: bent away from it by out radians. */
static vec bent(const struct camera *c, double x, double y, double radius, double out)
{
	double across = radius > 0 ? x / radius : 1, up = radius > 0 ? y / radius : 0;

	return combine_unit(c, across * sin(out), up * sin(out), cos(out));
}

static bool fisheye(const struct camera *c, double u, double v, vec *dir)
{
	double x = 2 * u * vec_length(c->right), y = 2 * v * vec_length(c->up);
	double radius = sqrt(x * x + y * y);

	*dir = bent(c, x, y, radius, radius * c->angle * DEGREE / 2);
	return radius <= 1;
}

static bool omnimax(const struct camera *c, double u, double v, vec *dir)
{
	double shape = vec_length(c->right) / vec_length(c->up), x = 2 * u, y = 2 * v, r, out;

	if (shape > OMNIMAX_SHAPE) {
		x *= shape / OMNIMAX_SHAPE;
		y = (y - 1) / OMNIMAX_SHAPE + 1;
	} else if (shape > 1) {
		y = (y - 1) / shape + 1;
	} else {
		y /= shape;
	}
	r = sqrt(x * x + y * y);
	out = r * (1.411269 + r * r * (-0.09439 + r * r * 0.25674)); /* the lens of the projector */
	*dir = bent(c, x, y, r, out);
	return r <= 1 && (r > 0 ? y / r : 0) * sin(out) >= tan(OMNIMAX_LOWEST) * cos(out);
}

static vec panoramic(const struct camera *c, double u, double v)
{
	double across = (0.5 - u) * PI, up = PI * v;
	double rise = fabs(PI / 2 - fabs(up)) < 1e-10 ? copysign(FAR, up) : tan(up);

	return combine(c, cos(across), rise, sin(across));
}

static vec ultra_wide_angle(const struct camera *c, double u, double v)
{
	double a = u * c->angle * DEGREE;
	double b = v * c->angle * DEGREE * vec_length(c->up) / vec_length(c->right);

	return combine_unit(c, sin(a), sin(b), cos(a) * cos(b));
}

/* v turned about a unit axis. */
static vec turned(vec v, vec axis, double angle)
{
	double s = sin(angle), c = cos(angle);
	vec along = vec_scale(axis, vec_dot(axis, v) * (1 - c));

	return vec_add(vec_add(vec_scale(v, c), vec_scale(vec_cross(axis, v), s)), along);
}

static vec spherical(const struct camera *c, double u, double v)
{
	vec ahead = turned(c->direction, vec_unit(c->right), -v * c->angle_up * DEGREE);

	return turned(ahead, vec_unit(c->up), u * c->angle * DEGREE);
}

static void cylinder(const struct camera *c, double u, double v, vec *org, vec *dir)
{
	bool upright = c->kind == CAMERA_CYLINDER_1 || c->kind == CAMERA_CYLINDER_3;
	double a = (upright ? u : v) * c->angle * DEGREE;
	vec along = upright ? vec_scale(c->up, v) : vec_scale(c->right, u);

	*dir = upright ? combine_unit(c, sin(a), 0, cos(a)) : combine_unit(c, 0, sin(a), cos(a));
	if (c->kind == CAMERA_CYLINDER_1 || c->kind == CAMERA_CYLINDER_2)
		*dir = vec_add(*dir, along);
	else
		*org = vec_add(*org, along);
}

/* The direction's length is left as it comes: it is what a lens focuses by. */
static bool pinhole_ray(const struct camera *c, double u, double v, vec *org, vec *dir)
{
	*org = c->location;
	switch (c->kind) {
	case CAMERA_PERSPECTIVE:
		*dir = combine(c, u, v, 1);
		return true;
	case CAMERA_ORTHOGRAPHIC:
		*org = vec_add(*org, combine(c, u, v, 0));
		*dir = c->direction;
		return true;
	case CAMERA_FISHEYE:
		return fisheye(c, u, v, dir);
	case CAMERA_ULTRA_WIDE_ANGLE:
		*dir = ultra_wide_angle(c, u, v);
		return true;
	case CAMERA_OMNIMAX:
		return omnimax(c, u, v, dir);
	case CAMERA_PANORAMIC:
		*dir = panoramic(c, u, v);
		return true;
	case CAMERA_SPHERICAL:
		*dir = spherical(c, u, v);
		return true;
	case CAMERA_CYLINDER_1:
	case CAMERA_CYLINDER_2:
	case CAMERA_CYLINDER_3:
	case CAMERA_CYLINDER_4:
		cylinder(c, u, v, org, dir);
		return true;
	}
	return false;
}

static inline bool make_unit(vec org, vec from, vec *dir)
{
	double length = vec_length(from);

	if (!(length > 0) || !isfinite(length) || !vec_finite(org))
		return false;
	*dir = vec_scale(from, 1 / length);
	return true;
}

bool camera_ray(const struct camera *c, double x, double y, double width, double height, vec *org,
		vec *dir)
{
	double u = x / width - 0.5, v = 0.5 - y / height;

	if (c->kind == CAMERA_PERSPECTIVE) { /* nearly all are */
		*org = c->location;
		return make_unit(c->location, combine(c, u, v, 1), dir);
	} else if (!pinhole_ray(c, u, v, org, dir)) {
		return false;
	}
	return make_unit(*org, *dir, dir);
}

LANED void perspective_lane(const struct camera *c, double x, double y, double width, double height,
			    struct camera_rays *out, unsigned i)
{
	double u = x / width - 0.5, v = 0.5 - y / height, length, inverse, nothing;
	vec ahead = vec_mad(vec_mad(vec_scale(c->right, u), c->up, v), c->direction, 1);

	length = vec_length(ahead);
	inverse = 1 / length;
	nothing = length * 0 + c->location.x * 0 + c->location.y * 0 + c->location.z * 0;
	out->org[0][i] = c->location.x;
	out->org[1][i] = c->location.y;
	out->org[2][i] = c->location.z;
	out->dir[0][i] = ahead.x * inverse;
	out->dir[1][i] = ahead.y * inverse;
	out->dir[2][i] = ahead.z * inverse;
	out->there[i] = ((length > 0) & (nothing == 0)) ? 1 : 0;
}

WIDE static void perspective_all(const struct camera *restrict from, const double *restrict x, const double *restrict y,
				 double width, double height, struct camera_rays *restrict out)
{
	const struct camera c = { .location = from->location, .right = from->right, .up = from->up,
				  .direction = from->direction };

	for (unsigned i = 0; i < LANES; i++)
		perspective_lane(&c, x[i], y[i], width, height, out, i);
}

void camera_rays(const struct camera *c, const double *x, const double *y, double width, double height,
		 struct camera_rays *out)
{
	if (c->kind == CAMERA_PERSPECTIVE) {
		perspective_all(c, x, y, width, height, out);
		return;
	}
	for (unsigned i = 0; i < LANES; i++) {
		vec org, dir;

		out->there[i] = camera_ray(c, x[i], y[i], width, height, &org, &dir);
		out->org[0][i] = org.x;
		out->org[1][i] = org.y;
		out->org[2][i] = org.z;
		out->dir[0][i] = dir.x;
		out->dir[1][i] = dir.y;
		out->dir[2][i] = dir.z;
	}
}

/* A quarter of the aperture is the lens's radius: the aperture is a diameter, of which POV-Ray's grid
 * of lens points fills the inner half (measured, and so are the two below). The places that POV-Ray's rays through a
 * lens take in a pixel are on a grid of sixteenths from its upper left corner, none on the far sides: their mean is
 * half of one off the middle, and so are its pictures (measured on slanted edges: 0.032 to 0.034 of a pixel). */
bool camera_lens_ray(const struct camera *c, double x, double y, double width, double height,
		     double lens_x, double lens_y, vec *org, vec *dir)
{
	vec across = vec_unit(vec_cross(c->up, c->direction));
	vec up = vec_unit(vec_cross(c->direction, across)), off;
	double r = c->aperture / 4;

	if (!pinhole_ray(c, (x - LENS_SHIFT) / width - 0.5, 0.5 - (y - LENS_SHIFT) / height, org, dir))
		return false;
	off = vec_add(vec_scale(across, lens_x * r), vec_scale(up, lens_y * r));
	*org = vec_add(*org, off);
	*dir = vec_sub(vec_scale(*dir, c->focal_distance / vec_length(c->direction)), off);
	return make_unit(*org, *dir, dir);
}

/* The pattern is asked where the ray goes through a picture from -0.5 to 0.5, and the ray taken for a normal:
 * measured, as the manual says only that there is one. */
void camera_bend(const struct scene *s, double x, double y, double width, double height, vec *dir)
{
	struct pattern_point at = { .p = { x / width - 0.5, 0.5 - y / height, 0 }, .n = *dir, .dir = *dir };

	if (s->camera.normal)
		*dir = normal_at(s, s->camera.normal, &at, *dir);
}
