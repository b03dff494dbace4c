/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include "look/require.h"

#include <inttypes.h>
#include <stdbool.h>

#include "look/memory.h"

struct features {
	uint64_t kinds[SHAPE_KINDS];
	uint64_t triangles, vertices, smooth;
	bool mirror, clear, refraction, fade, layered, blended;
};

static void look_at_finishes(const struct scene *s, struct features *f)
{
	for (uint32_t i = 0; i < s->texture_count; i++) {
		const struct texture *t = &s->texture[i];

		f->layered |= t->count > 1;
		f->clear |= texture_translucent(t);
		for (uint32_t l = 0; l < t->count; l++)
			f->mirror |= rgb_max(t->layer[l].finish.reflection_max) > 0 ||
				     rgb_max(t->layer[l].finish.reflection_min) > 0;
	}
	for (uint32_t i = 0; i < s->interior_count; i++) {
		f->refraction |= s->interior[i].ior != 1 || s->interior[i].dispersion != 1;
		f->fade |= s->interior[i].fade_distance != 0;
	}
}

static void look_at_shapes(const struct scene *s, struct features *f)
{
	for (uint32_t i = 0; i < s->object_count; i++)
		f->kinds[s->object[i].kind]++;
	for (uint32_t i = 0; i < s->mesh_count; i++) {
		const struct mesh *m = &s->mesh[i];

		f->triangles += m->triangle_count;
		f->vertices += m->vertex_count;
		f->smooth += m->normal ? m->smooth_count : 0;
		f->blended |= m->textures_per_face == 3;
	}
}

static void print_objects(const struct scene *s, const struct features *f, FILE *out)
{
	for (int k = 0; k < SHAPE_KINDS; k++) {
		if (f->kinds[k])
			fprintf(out, "  %-18s %" PRIu64 "\n", shape_name((enum shape_kind)k), f->kinds[k]);
	}
	if (s->mesh_count)
		fprintf(out,
			"  meshes' data       %u, with %" PRIu64 " triangles (%" PRIu64 " smooth), %" PRIu64
			" vertices\n",
			s->mesh_count, f->triangles, f->smooth, f->vertices);
}

static void print_lights(const struct scene *s, FILE *out)
{
	uint32_t point = 0, spot = 0, cylinder = 0, parallel = 0, area = 0, shadowless = 0;

	for (uint32_t i = 0; i < s->light_count; i++) {
		const struct light *l = &s->light[i];

		point += l->kind == LIGHT_POINT && !l->parallel;
		spot += l->kind == LIGHT_SPOT;
		cylinder += l->kind == LIGHT_CYLINDER;
		parallel += l->parallel;
		area += l->area;
		shadowless += l->shadowless;
	}
	fprintf(out,
		"lights\n  point %u, spot %u, cylinder %u, parallel %u; of these area %u, shadowless %u\n",
		point, spot, cylinder, parallel, area, shadowless);
}

#define MESHES_SHOWN 10

struct mesh_list {
	const struct scene *scene;
	FILE *out;
	uint64_t left; /* to be shown */
};

static bool print_mesh(void *data, const struct mesh_vertices *m)
{
	struct mesh_list *l = data;
	const struct object *o = m->object == SCENE_NONE ? NULL : &l->scene->object[m->object];

	fprintf(l->out, "    %s:%u: ", o && o->pos.file ? o->pos.file : "the scene", o ? o->pos.line : 0);
	if (m->loss > 0)
		fprintf(l->out, "double, floats would change it by %.2g of its size\n", m->loss / m->size);
	else
		fputs(m->wide ? "double, as others beside it need it\n" : "float, which loses nothing\n", l->out);
	return --l->left > 0;
}

/* Which numbers the vertices are kept in, and what decided it. */
static void print_vertices(const struct scene *s, const struct geometry *g, bool all, FILE *out)
{
	struct mesh_list list = { .scene = s, .out = out, .left = all ? UINT64_MAX : MESHES_SHOWN };
	struct geometry_vertices v;
	const struct object *o;
	uint64_t more = 0;

	geometry_get_vertices(g, &v, NULL, NULL);
	fprintf(out, "  vertices of %" PRIu64 " mesh%s in double, of %" PRIu64 " in float, exactly\n", v.wide,
		v.wide == 1 ? "" : "es", v.meshes - v.wide);
	if (v.shift.x != 0 || v.shift.y != 0 || v.shift.z != 0)
		fprintf(out, "  vertices are relative to <%.9g, %.9g, %.9g>, as the scene is far from the origin\n",
			v.shift.x, v.shift.y, v.shift.z);
	if (v.worst.object != SCENE_NONE) {
		o = &s->object[v.worst.object];
		fprintf(out, "  floats would change %" PRIu64 " of them, most the one in %s:%u, by %.2g of its size",
			v.demanding, o->pos.file ? o->pos.file : "the scene", o->pos.line,
			v.worst.loss / v.worst.size);
		fprintf(out, " (%.3g units; it is %.3g wide, %.3g off the origin)\n", v.worst.loss, v.worst.size,
			v.worst.offset);
	}
	if (!all && v.meshes > MESHES_SHOWN)
		more = v.meshes - MESHES_SHOWN;
	geometry_get_vertices(g, &v, print_mesh, &list);
	if (more)
		fprintf(out, "    and %" PRIu64 " more, which -v lists\n", more);
}

static void print_structure(const struct scene *s, const struct geometry *g, const char *accel, bool all, FILE *out)
{
	struct geometry_counts c = { 0 };

	geometry_get_counts(g, &c);
	fprintf(out, "structure\n  %s\n", accel);
	fprintf(out, "  triangles %" PRIu64 ", with all instances %" PRIu64 "; other primitives %" PRIu64 "\n",
		c.triangles, c.effective_triangles, c.primitives);
	fprintf(out, "  instances %" PRIu64 ", unbounded %" PRIu64 "; left out for lack of area %" PRIu64 "\n",
		c.instances, c.unbounded, c.dropped);
	if (c.triangles + c.primitives + c.instances)
		fprintf(out, "  extent %.6g %.6g %.6g to %.6g %.6g %.6g\n", c.box.lo.x, c.box.lo.y, c.box.lo.z,
			c.box.hi.x, c.box.hi.y, c.box.hi.z);
	if (c.triangles)
		print_vertices(s, g, all, out);
}

static void print_memory(const struct mem_book *book, FILE *out)
{
	fputs("memory, MiB\n", out);
	for (uint32_t i = 0; i < book->count; i++) {
		if (book->account[i].peak >= 1 << 14)
			fprintf(out, "  %-26s %8.2f\n", book->account[i].name,
				(double)book->account[i].peak / 1048576);
	}
	fprintf(out, "  %-26s %8.2f\n", "all, without the picture", (double)book->peak / 1048576);
}

void require_text(const struct scene *s, const struct geometry *g, const char *accel,
		  const struct mem_book *book, bool all, FILE *out)
{
	struct features f = { 0 };

	look_at_finishes(s, &f);
	look_at_shapes(s, &f);
	fprintf(out, "camera\n  %s\n",
		!s->has_camera				? "none: POV-Ray's default" :
		s->camera.kind == CAMERA_PERSPECTIVE	? "perspective" :
							  "orthographic");
	fputs("objects\n", out);
	print_objects(s, &f, out);
	print_lights(s, out);
	fprintf(out, "surfaces\n  textures %u, interiors %u\n", s->texture_count, s->interior_count);
	fprintf(out,
		"required\n  shadows %s, mirrors %s, transparency %s, refraction %s, coloured glass %s\n",
		s->light_count ? "yes" : "no", f.mirror ? "yes" : "no", f.clear ? "yes" : "no",
		f.clear && f.refraction ? "yes" : "no", f.clear && f.fade ? "yes" : "no");
	fprintf(out, "  layered textures %s, vertex textures %s, rays up to depth %u\n",
		f.layered ? "yes" : "no", f.blended ? "yes" : "no", s->max_trace_level);
	if (s->radiosity.given)
		fprintf(out, "  indirect light of %u bounce%s\n", s->radiosity.recursion_limit,
			s->radiosity.recursion_limit == 1 ? "" : "s");
	print_structure(s, g, accel, all, out);
	print_memory(book, out);
	memory_building_text(g, out);
}
