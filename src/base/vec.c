/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "base/vec.h"

#define PI 3.14159265358979323846

const struct mat mat_identity = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 } } };
const struct xform xform_identity = {
	{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 } } },
	{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 } } },
};

struct mat mat_mul(const struct mat *first, const struct mat *then)
{
	struct mat out;

	for (int i = 0; i < 4; i++) {
		for (int j = 0; j < 3; j++) {
			out.m[i][j] = first->m[i][0] * then->m[0][j] + first->m[i][1] * then->m[1][j] +
				      first->m[i][2] * then->m[2][j] + (i == 3 ? then->m[3][j] : 0);
		}
	}
	return out;
}

double mat_det(const struct mat *a)
{
	vec x = { a->m[0][0], a->m[0][1], a->m[0][2] };
	vec y = { a->m[1][0], a->m[1][1], a->m[1][2] };
	vec z = { a->m[2][0], a->m[2][1], a->m[2][2] };

	return vec_dot(x, vec_cross(y, z));
}

bool mat_invert(const struct mat *a, struct mat *out)
{
	vec r[3], c[3], t;
	double det;

	for (int i = 0; i < 3; i++)
		r[i] = vec_make(a->m[i][0], a->m[i][1], a->m[i][2]);
	c[0] = vec_cross(r[1], r[2]);
	c[1] = vec_cross(r[2], r[0]);
	c[2] = vec_cross(r[0], r[1]);
	det = vec_dot(r[0], c[0]);
	if (det == 0 || !isfinite(det))
		return false;
	for (int i = 0; i < 3; i++) {
		out->m[0][i] = c[i].x / det;
		out->m[1][i] = c[i].y / det;
		out->m[2][i] = c[i].z / det;
		out->m[3][i] = 0;
	}
	t = mat_dir(out, vec_make(a->m[3][0], a->m[3][1], a->m[3][2]));
	out->m[3][0] = -t.x;
	out->m[3][1] = -t.y;
	out->m[3][2] = -t.z;
	for (int i = 0; i < 4; i++) {
		if (!isfinite(out->m[i][0]) || !isfinite(out->m[i][1]) || !isfinite(out->m[i][2]))
			return false;
	}
	return true;
}

bool mat_is_identity(const struct mat *a)
{
	for (int i = 0; i < 4; i++) {
		for (int j = 0; j < 3; j++) {
			if (a->m[i][j] != mat_identity.m[i][j])
				return false;
		}
	}
	return true;
}

struct xform xform_mul(const struct xform *first, const struct xform *then)
{
	return (struct xform){ .fwd = mat_mul(&first->fwd, &then->fwd),
			       .inv = mat_mul(&then->inv, &first->inv) };
}

bool xform_from_mat(const struct mat *a, struct xform *out)
{
	out->fwd = *a;
	return mat_invert(a, &out->inv);
}

struct xform xform_translate(vec by)
{
	struct xform x = xform_identity;

	x.fwd.m[3][0] = by.x;
	x.fwd.m[3][1] = by.y;
	x.fwd.m[3][2] = by.z;
	x.inv.m[3][0] = -by.x;
	x.inv.m[3][1] = -by.y;
	x.inv.m[3][2] = -by.z;
	return x;
}

struct xform xform_scale(vec by)
{
	struct xform x = xform_identity;

	x.fwd.m[0][0] = by.x;
	x.fwd.m[1][1] = by.y;
	x.fwd.m[2][2] = by.z;
	x.inv.m[0][0] = 1 / by.x;
	x.inv.m[1][1] = 1 / by.y;
	x.inv.m[2][2] = 1 / by.z;
	return x;
}

/* A rotation: its inverse is its transpose. */
static struct xform rotation(const double r[3][3])
{
	struct xform x = xform_identity;

	for (int i = 0; i < 3; i++) {
		for (int j = 0; j < 3; j++) {
			x.fwd.m[i][j] = r[i][j];
			x.inv.m[j][i] = r[i][j];
		}
	}
	return x;
}

struct xform xform_rotate(vec degrees)
{
	vec a = vec_scale(degrees, PI / 180);
	double cx = cos(a.x), sx = sin(a.x), cy = cos(a.y), sy = sin(a.y);
	double cz = cos(a.z), sz = sin(a.z);
	struct xform x = rotation((const double[3][3]){ { 1, 0, 0 }, { 0, cx, sx }, { 0, -sx, cx } });
	struct xform y = rotation((const double[3][3]){ { cy, 0, -sy }, { 0, 1, 0 }, { sy, 0, cy } });
	struct xform z = rotation((const double[3][3]){ { cz, sz, 0 }, { -sz, cz, 0 }, { 0, 0, 1 } });

	x = xform_mul(&x, &y);
	return xform_mul(&x, &z);
}

struct xform xform_axis_rotate(vec axis, double degrees)
{
	vec k = vec_unit(axis);
	double c = cos(degrees * PI / 180), s = sin(degrees * PI / 180), v = 1 - c;

	/* Rodrigues, for row vectors. */
	return rotation((const double[3][3]){
		{ c + k.x * k.x * v, k.x * k.y * v + k.z * s, k.x * k.z * v - k.y * s },
		{ k.x * k.y * v - k.z * s, c + k.y * k.y * v, k.y * k.z * v + k.x * s },
		{ k.x * k.z * v + k.y * s, k.y * k.z * v - k.x * s, c + k.z * k.z * v } });
}
