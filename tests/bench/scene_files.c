/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A world of worlds.c as files that renderers read: STEM.pov for POV-Ray and Alidade, STEM.dat for Tachyon. The same
 * triangles, decimals, camera and lamp in both; no normals at corners, no textures.
 *
 *	scene_files WORLD plain|glass STEM
 *
 * plain: everything is dull. glass: the stage is a mirror that shows three tenths, and what stands on it is clear
 * glass that bends rays, whose surface mirrors by Fresnel's law. Tachyon has no refraction, so that is not for it.
 *
 * Tachyon's camera looks at things as in a mirror (its x, y and view are left-handed), so there x has the other sign.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "worlds.h"

enum { STAGE = 12 }; /* triangles of it, which come first */

static FILE *create(const char *stem, const char *ending)
{
	char path[4096];
	FILE *f;

	snprintf(path, sizeof(path), "%s%s", stem, ending);
	f = fopen(path, "w");
	if (!f) {
		fprintf(stderr, "scene_files: can't write %s\n", path);
		exit(1);
	}
	return f;
}

static void finish(FILE *f, const char *stem)
{
	if (ferror(f) | fclose(f)) {
		fprintf(stderr, "scene_files: %s: can't be written\n", stem);
		exit(1);
	}
}

static const char *const pov_texture[] = {
	"pigment { color rgb <0.8, 0.8, 0.8> } finish { ambient 0.1 diffuse 0.8 }",
	"pigment { color rgb <0.8, 0.5, 0.3> } finish { ambient 0.1 diffuse 0.8 }",
	"pigment { color rgb <0.8, 0.8, 0.8> } finish { ambient 0.1 diffuse 0.6 reflection 0.3 }",
	"pigment { color rgbf <0.9, 1, 0.9, 0.95> }\n"
	"\tfinish { ambient 0 diffuse 0.05 specular 0.5 reflection { 0, 1 fresnel on } conserve_energy }",
};

/* Triangles first to last - 1, with vertices from..to - 1, which are theirs alone. */
static void put_mesh(FILE *f, const struct mesh *m, uint32_t first, uint32_t last, uint32_t from, uint32_t to,
		     unsigned texture)
{
	fprintf(f, "mesh2 {\n\tvertex_vectors {\n\t\t%u", to - from);
	for (uint32_t i = from; i < to; i++)
		fprintf(f, ",\n\t\t<%.6f, %.6f, %.6f>", m->vertex[i].x, m->vertex[i].y, m->vertex[i].z);
	fprintf(f, "\n\t}\n\tface_indices {\n\t\t%u", last - first);
	for (uint32_t i = first; i < last; i++)
		fprintf(f, ",\n\t\t<%u,%u,%u>", m->index[3 * i] - from, m->index[3 * i + 1] - from,
			m->index[3 * i + 2] - from);
	fprintf(f, "\n\t}\n\ttexture { %s }\n%s}\n", pov_texture[texture],
		texture == 3 ? "\tinterior { ior 1.5 }\n" : "");
}

static void put_pov(FILE *f, const struct world *w, bool stage, bool glass)
{
	const struct mesh *m = &w->mesh;
	uint32_t split = stage ? STAGE : 0, from = stage ? 8 : 0;

	fprintf(f, "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level %d }\n", glass ? 10 : 5);
	fprintf(f, "camera {\n\tperspective\n\tlocation <%.6f, %.6f, %.6f>\n\tsky <0, 0, 1>\n"
		"\tup <0, 1, 0>\n\tright <-4/3, 0, 0>\n\tangle %.9f\n\tlook_at <%.6f, %.6f, %.6f>\n}\n",
		w->eye.x, w->eye.y, w->eye.z, 2 * atan(w->wide) * 57.29577951308232, w->at.x, w->at.y, w->at.z);
	fprintf(f, "light_source { <%.6f, %.6f, %.6f> color rgb <1, 1, 1> }\n", w->light.x, w->light.y, w->light.z);
	fprintf(f, "background { color rgb <0.2, 0.3, 0.4> }\n");
	if (stage)
		put_mesh(f, m, 0, STAGE, 0, 8, glass ? 2 : 0);
	put_mesh(f, m, split, m->prims.count, from, m->vertices, glass ? 3 : 1);
}

static void put_dat(FILE *f, const struct world *w, bool stage)
{
	const struct mesh *m = &w->mesh;
	ald_vec d = { w->at.x - w->eye.x, w->at.y - w->eye.y, w->at.z - w->eye.z };

	/* Zoom 1 shows 1 of height at distance 1. */
	fprintf(f, "BEGIN_SCENE\nRESOLUTION 800 600\nCAMERA\nZOOM %.9f\nASPECTRATIO 1.0\nANTIALIASING 0\nRAYDEPTH 5\n"
		"CENTER %.6f %.6f %.6f\nVIEWDIR %.9f %.9f %.9f\nUPDIR 0.0 0.0 1.0\nEND_CAMERA\n"
		"BACKGROUND 0.2 0.3 0.4\n", 0.5 / (0.75 * w->wide), -w->eye.x, w->eye.y, w->eye.z, -d.x, d.y, d.z);
	fprintf(f, "LIGHT CENTER %.6f %.6f %.6f RAD 0.001 COLOR 1.0 1.0 1.0\n", -w->light.x, w->light.y, w->light.z);
	fprintf(f, "TEXDEF one AMBIENT 0.1 DIFFUSE 0.8 SPECULAR 0.0 OPACITY 1.0 COLOR 0.8 0.8 0.8 TEXFUNC 0\n"
		"TEXDEF two AMBIENT 0.1 DIFFUSE 0.8 SPECULAR 0.0 OPACITY 1.0 COLOR 0.8 0.5 0.3 TEXFUNC 0\n");
	for (uint32_t i = 0; i < m->prims.count; i++) {
		fprintf(f, "TRI");
		for (unsigned k = 0; k < 3; k++) {
			const ald_vec *v = &m->vertex[m->index[3 * i + k]];

			fprintf(f, " V%u %.6f %.6f %.6f", k, -v->x, v->y, v->z);
		}
		fprintf(f, " %s\n", stage && i < STAGE ? "one" : "two");
	}
	fprintf(f, "END_SCENE\n");
}

int main(int argc, char **argv)
{
	static struct world w;
	bool glass = argc == 4 && !strcmp(argv[2], "glass"), stage;
	FILE *f;

	if (argc != 4 || (!glass && strcmp(argv[2], "plain")) || !world_make(&w, argv[1]) || w.forest) {
		fprintf(stderr, "usage: scene_files WORLD plain|glass STEM\n");
		return 2;
	}
	stage = !strncmp(w.name, "statue", 6) || !strcmp(w.name, "suzanne");
	f = create(argv[3], ".pov");
	put_pov(f, &w, stage, glass);
	finish(f, argv[3]);
	if (!glass) {
		f = create(argv[3], ".dat");
		put_dat(f, &w, stage);
		finish(f, argv[3]);
	}
	world_release(&w);
	return 0;
}
