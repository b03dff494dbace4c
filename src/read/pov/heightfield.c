/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * height_field (manual 3.4.5.1.6): a picture's or a function's values as heights of a grid, as a mesh.
 *
 * Its coordinates are whole numbers, the pixels' and 16 bits of height, until the object's first transform brings
 * them to the unit cube: so single precision holds them exactly. Measured of POV-Ray, beyond the manual: cells are
 * cut from their +x corner to their +z corner; of colours of 8 bits and of floats a height is 65280 red + 255 green,
 * after gamma if the file's gamma is given; of greys and of 16 bits it is 65535 times the grey; a palette's is 256
 * times the number; all are cut off to whole numbers, and a function's are taken modulo 65536. A function's picture
 * begins at the top, so its y grows towards -z.
 */
#include <config.h>

#include "read/pov/mesh.h"

#include <math.h>

#include "pattern/function.h"
#include "pattern/image.h"
#include "read/pov/function.h"
#include "read/pov/picture.h"

#define POINTS_MAX (1u << 26)

struct field {
	uint32_t width, height;
	struct picture_place place; /* of a picture */
	const struct function *function; /* or of none */
	bool smooth;
	double water; /* 0 to 1 */
	double least; /* of all heights, 0 to 65535 */
};

static bool check_size(struct pov *p, const struct field *f, const struct diag_pos *at)
{
	if (pov_failed(p))
		return false;
	if (f->width < 2 || f->height < 2)
		pov_fail_at(p, at, "a height_field needs at least 2 x 2 points, not %u x %u", f->width, f->height);
	else if ((uint64_t)f->width * f->height > POINTS_MAX)
		pov_fail_at(p, at, "a height_field of %u x %u points is too large; the limit is %u points", f->width,
			    f->height, POINTS_MAX);
	return !pov_failed(p);
}

static bool read_function(struct pov *p, struct field *f)
{
	struct diag_pos at = pov_here(p);
	struct pov_function *function;

	f->width = pov_count(p, "the width", 1, 65536);
	pov_comma(p);
	f->height = pov_count(p, "the height", 1, 65536);
	if (!check_size(p, f, &at))
		return false;
	at = pov_here(p);
	function = function_read(p);
	if (!function || !function_of_points(p, &at, function) || !pov_lack_use(p, &function->lack))
		return false;
	f->function = &function->function;
	return true;
}

static bool read_source(struct pov *p, struct field *f)
{
	struct diag_pos at = pov_here(p);
	double unused;

	if (pov_accept(p, TOK_FUNCTION))
		return read_function(p, f);
	if (!pov_picture_read(p, PICTURE_OF_DATA, &f->place, &unused))
		return false;
	f->width = f->place.picture->width;
	f->height = f->place.picture->height;
	return check_size(p, f, &at);
}

static void read_words(struct pov *p, struct field *f)
{
	for (;;) {
		if (pov_accept(p, TOK_SMOOTH))
			f->smooth = pov_bool(p, true);
		else if (pov_accept(p, TOK_WATER_LEVEL))
			f->water = pov_finite_float(p, "water_level");
		else
			return;
	}
}

/* Of the y-th row from the top. */
static double height_at(struct pov *p, const struct field *f, uint32_t x, uint32_t y)
{
	const struct picture *m = f->place.picture;
	struct rgbft c;
	double v;

	if (f->function) {
		v = 65535 * function_at(pov_scene(p), f->function,
					vec_make(x / (f->width - 1.0), y / (f->height - 1.0), 0));
		v = isfinite(v) ? fmod(trunc(v), 65536) : 0;
		return v < 0 ? v + 65536 : v;
	}
	if (m->palette_count)
		return 256 * ((const uint8_t *)m->sample)[(size_t)y * m->width + x];
	c = image_texel(&f->place, x, y);
	if (m->depth == PICTURE_16 || m->channels < 3)
		v = 65535 * (0.297 * c.r + 0.589 * c.g + 0.114 * c.b);
	else
		v = 65280 * c.r + 255 * c.g;
	return trunc(fmax(0, fmin(65535, v + 1.0 / 1024))); /* decoded in single precision */
}

static bool add_points(struct pov *p, struct mesh_draft *d, struct field *f)
{
	size_t n = (size_t)f->width * f->height;
	double *v;

	if (!mesh_reserve(p, &d->vertex, n, n))
		return false;
	v = d->vertex.data;
	f->least = 65536;
	for (uint32_t z = 0; z < f->height; z++) {
		for (uint32_t x = 0; x < f->width; x++, v += 3) {
			v[0] = x;
			v[1] = height_at(p, f, x, f->height - 1 - z);
			v[2] = z;
			f->least = fmin(f->least, v[1]);
		}
	}
	d->vertex.count = n;
	return true;
}

/* Two triangles a cell, the lower one first; outside is up. */
static bool add_cells(struct pov *p, struct mesh_draft *d, const struct field *f)
{
	size_t n = 2 * (size_t)(f->width - 1) * (f->height - 1);
	uint32_t *i;

	if (!mesh_reserve(p, &d->index, n, n))
		return false;
	i = d->index.data;
	for (uint32_t z = 0; z + 1 < f->height; z++) {
		for (uint32_t x = 0; x + 1 < f->width; x++, i += 6) {
			uint32_t at = z * f->width + x;

			i[0] = at;
			i[1] = i[5] = at + 1;
			i[2] = i[4] = at + f->width;
			i[3] = at + f->width + 1;
		}
	}
	d->index.count = n;
	return true;
}

/* What a corner's neighbour along x and one along z say of its normal. */
static vec quarter(const struct field *f, const double *v, uint32_t x, uint32_t z, int dx, int dz)
{
	const double *at = v + 3 * ((size_t)z * f->width + x);
	vec n;

	if ((dx < 0 && x == 0) || (dx > 0 && x + 1 == f->width) || (dz < 0 && z == 0) ||
	    (dz > 0 && z + 1 == f->height))
		return vec_make(0, 0, 0);
	n = vec_make(-dx * (at[3 * dx + 1] - at[1]), 1, -dz * ((at + 3 * (ptrdiff_t)f->width * dz)[1] - at[1]));
	return vec_unit(n);
}

/* Unit means of the four, in 16 bits as POV-Ray keeps them. */
static bool add_normals(struct pov *p, struct mesh_draft *d, const struct field *f)
{
	const double *v = d->vertex.data;
	float *out;

	if (!mesh_reserve(p, &d->normal, d->vertex.count, d->vertex.count))
		return false;
	out = d->normal.data;
	for (uint32_t z = 0; z < f->height; z++) {
		for (uint32_t x = 0; x < f->width; x++, out += 3) {
			vec n = vec_add(vec_add(quarter(f, v, x, z, 1, 1), quarter(f, v, x, z, -1, 1)),
					vec_add(quarter(f, v, x, z, -1, -1), quarter(f, v, x, z, 1, -1)));

			n = vec_unit(n);
			for (unsigned k = 0; k < 3; k++)
				out[k] = (float)trunc(32767 * (&n.x)[k]);
		}
	}
	d->normal.count = d->vertex.count;
	d->smooth_count = (uint32_t)d->index.count;
	return true;
}

/* What is below the water is not there. In POV-Ray the air of a pond is inside all the same, which shows where
 * other solids are made with the object: use.c refuses that. */
static bool cut_water(struct pov *p, const struct field *f, struct pov_object *o)
{
	struct pov_child *c;

	if (f->water * 65536 <= f->least)
		return true;
	c = pov_new(p, sizeof(*c));
	if (c)
		c->object = pov_object_new(p, SHAPE_PLANE, &o->object.pos);
	if (!c || !c->object)
		return false;
	c->object->object.shape.plane.normal = vec_make(0, -1, 0);
	c->object->object.shape.plane.distance = -f->water;
	c->before = o->object.place;
	o->clip = c;
	o->water = true;
	o->weight += c->object->weight;
	return true;
}

struct pov_object *pov_read_height_field(struct pov *p, const struct diag_pos *at)
{
	struct field f = { .smooth = false };
	struct pov_object *o = NULL;
	struct mesh_draft d;

	mesh_draft_init(&d);
	d.pos = *at;
	d.partial = true; /* all have the object's texture */
	if (!read_source(p, &f))
		return NULL;
	read_words(p, &f);
	if (!pov_failed(p) && add_points(p, &d, &f) && add_cells(p, &d, &f) &&
	    (!f.smooth || add_normals(p, &d, &f))) {
		d.has_inside = true;
		d.inside = vec_make(0, 1, 0);
		o = mesh_draft_finish(p, &d);
	}
	mesh_draft_release(&d);
	if (!o)
		return NULL;
	pov_scene(p)->mesh[o->mesh->index].lone = true; /* its surface coordinates are not its own */
	pov_scene(p)->mesh[o->mesh->index].grid = f.smooth;
	o->object.place = xform_scale(vec_make(1.0 / (f.width - 1), 1.0 / 65536, 1.0 / (f.height - 1)));
	return cut_water(p, &f, o) ? o : NULL;
}
