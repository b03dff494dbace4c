/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Points, directions and affine transforms in double.
 *
 * A point is a row vector, as in POV-Ray's manual (3.3.1.12.4): p' = p M, where the first three rows
 * of M are the images of x, y and z, and the fourth is the translation. The vector type is the
 * plugin contract's, so that nothing is converted at that border.
 */
#ifndef ALIDADE_BASE_VEC_H
#define ALIDADE_BASE_VEC_H

#include <math.h>
#include <stdbool.h>

#include "alidade/accel.h"

typedef ald_vec vec;

static inline vec vec_make(double x, double y, double z)
{
	return (vec){ x, y, z };
}

static inline vec vec_add(vec a, vec b)
{
	return (vec){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline vec vec_sub(vec a, vec b)
{
	return (vec){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline vec vec_scale(vec a, double s)
{
	return (vec){ a.x * s, a.y * s, a.z * s };
}

/* a + b s */
static inline vec vec_mad(vec a, vec b, double s)
{
	return (vec){ a.x + b.x * s, a.y + b.y * s, a.z + b.z * s };
}

static inline vec vec_neg(vec a)
{
	return (vec){ -a.x, -a.y, -a.z };
}

static inline double vec_dot(vec a, vec b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec vec_cross(vec a, vec b)
{
	return (vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double vec_length(vec a)
{
	return sqrt(vec_dot(a, a));
}

/* The unit vector along a; a itself if its length is 0. */
static inline vec vec_unit(vec a)
{
	double l = vec_length(a);

	return l > 0 ? vec_scale(a, 1 / l) : a;
}

static inline bool vec_finite(vec a)
{
	return a.x * 0 + a.y * 0 + a.z * 0 == 0; /* infinity and NaN make it NaN */
}

struct mat {
	double m[4][3];
};

/* A transform and its inverse, kept together so that neither has to be found again. */
struct xform {
	struct mat fwd, inv;
};

extern const struct mat mat_identity;
extern const struct xform xform_identity;

static inline vec mat_point(const struct mat *a, vec p)
{
	return (vec){ p.x * a->m[0][0] + p.y * a->m[1][0] + p.z * a->m[2][0] + a->m[3][0],
		      p.x * a->m[0][1] + p.y * a->m[1][1] + p.z * a->m[2][1] + a->m[3][1],
		      p.x * a->m[0][2] + p.y * a->m[1][2] + p.z * a->m[2][2] + a->m[3][2] };
}

static inline vec mat_dir(const struct mat *a, vec p)
{
	return (vec){ p.x * a->m[0][0] + p.y * a->m[1][0] + p.z * a->m[2][0],
		      p.x * a->m[0][1] + p.y * a->m[1][1] + p.z * a->m[2][1],
		      p.x * a->m[0][2] + p.y * a->m[1][2] + p.z * a->m[2][2] };
}

/* A normal (covector) goes through the transpose of the inverse: pass xform.inv. Not unit. */
static inline vec mat_normal(const struct mat *inv, vec n)
{
	return (vec){ n.x * inv->m[0][0] + n.y * inv->m[0][1] + n.z * inv->m[0][2],
		      n.x * inv->m[1][0] + n.y * inv->m[1][1] + n.z * inv->m[1][2],
		      n.x * inv->m[2][0] + n.y * inv->m[2][1] + n.z * inv->m[2][2] };
}

struct mat mat_mul(const struct mat *first, const struct mat *then);
double mat_det(const struct mat *a); /* of the 3x3 part */
bool mat_invert(const struct mat *a, struct mat *out); /* false: singular or not finite */
bool mat_is_identity(const struct mat *a);

struct xform xform_mul(const struct xform *first, const struct xform *then);
bool xform_from_mat(const struct mat *a, struct xform *out); /* false: singular */
struct xform xform_translate(vec by);
struct xform xform_scale(vec by); /* no component may be 0 */
struct xform xform_rotate(vec degrees); /* about x, then y, then z; left-handed as in SDL */
struct xform xform_axis_rotate(vec axis, double degrees); /* POV-Ray's Axis_Rotate */

#endif
