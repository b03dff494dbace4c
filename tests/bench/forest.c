/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "forest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel/trace.h"
#include "read/pov/parser.h"

struct forest {
	float place[TREES][12];
	struct mem_book book;
	struct scene scene;
};

/* Evenly in [0, 1): the fractions of multiples of roots (Roberts: The Unreasonable Effectiveness of Quasirandom
 * Sequences, 2018). */
static double even(uint32_t i, unsigned dimension)
{
	static const double step[4] = { 0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
					0.5385972572236101 };

	return fmod(i * step[dimension], 1);
}

struct forest *forest_plant(void)
{
	struct forest *f = calloc(1, sizeof(*f));
	for (uint32_t i = 0; f && i < TREES; i++) {
		double size = 0.7 + 0.6 * even(i, 0), a = 6.283185307179586 * even(i, 1);
		float c = (float)(size * cos(a)), s = (float)(size * sin(a));
		float x = (float)(i % 100 + 0.8 * even(i, 2) - 50);
		float y = (float)(i / 100 + 0.8 * even(i, 3) - 50);
		const float place[12] = { c, s, 0, -s, c, 0, 0, 0, (float)size, x, y, 0 };

		memcpy(f->place[i], place, sizeof(place));
	}
	return f;
}

const float (*forest_places(const struct forest *f))[12]
{
	return f->place;
}

static void write_forest(const struct forest *f, const ald_prims *tree, uint32_t vertices, FILE *to)
{
	const double *v = tree->vertex;

	fprintf(to, "camera { location 0 }\n#declare T = mesh2 { vertex_vectors { %u", vertices);
	for (uint32_t i = 0; i < vertices; i++, v += 3)
		fprintf(to, ",<%.9g,%.9g,%.9g>", v[0], v[1], v[2]);
	fprintf(to, "} face_indices { %u", tree->tri_count);
	for (uint32_t i = 0; i < tree->tri_count; i++)
		fprintf(to, ",<%u,%u,%u>", tree->index[3 * i], tree->index[3 * i + 1], tree->index[3 * i + 2]);
	fputs("} }\n", to);
	for (uint32_t i = 0; i < TREES; i++) {
		fputs("object { T matrix <", to);
		for (unsigned k = 0; k < 12; k++)
			fprintf(to, "%s%.9g", k ? "," : "", (double)f->place[i][k]);
		fputs("> }\n", to);
	}
}

static void tell(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	(void)arg;
	(void)pos;
	if (level == DIAG_ERROR)
		fprintf(stderr, "rays: forest: %s\n", text);
}

bool forest_read(struct forest *f, const ald_prims *tree, uint32_t vertices)
{
	const struct read_options options = { 0 };
	struct diag diag = { .sink = tell };
	enum status status = STATUS_FAILED;
	char *text = NULL;
	size_t size;
	FILE *to = open_memstream(&text, &size);

	mem_book_init(&f->book, 0);
	scene_init(&f->scene, &f->book);
	if (to) {
		write_forest(f, tree, vertices, to);
		fclose(to);
		status = pov_read("forest.pov", text, size, &options, &f->scene, &diag);
	}
	free(text);
	return status == STATUS_OK;
}

void forest_free(struct forest *f)
{
	if (!f)
		return;
	scene_release(&f->scene);
	free(f);
}

struct geometry *forest_build(const struct forest *f, const struct accel_choice *choice, struct pool *pool,
			      struct mem_book *book)
{
	struct diag diag = { .sink = tell };
	struct geometry *g;

	return geometry_build(&g, &f->scene, choice, pool, book, false, &diag) == STATUS_OK ? g : NULL;
}

void forest_unbuild(struct geometry *g)
{
	geometry_free(g);
}

double forest_bytes(const struct geometry *g)
{
	const char *name;
	double value;

	for (uint32_t i = 0; geometry_stat(g, i, &name, &value); i++) {
		if (!strcmp(name, "memory"))
			return value;
	}
	return 0;
}

void forest_nearest(const struct geometry *g, uint32_t thread, const ald_ray *ray, ald_hit *hit, uint32_t n,
		    uint32_t hints)
{
	trace_nearest(g, thread, ray, hit, n, hints);
}

void forest_occluded(const struct geometry *g, uint32_t thread, const ald_ray *ray, uint8_t *hidden, uint32_t n,
		     uint32_t hints)
{
	trace_occluded(g, thread, ray, hidden, n, hints);
}

ald_vec forest_normal(const struct geometry *g, const ald_ray *ray, const ald_hit *hit)
{
	struct surface s;

	surface_at(g, ray, hit, &s);
	return (ald_vec){ s.n.x, s.n.y, s.n.z };
}
