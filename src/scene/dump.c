/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include "scene/dump.h"
#include "scene/put.h"

static void put_index(FILE *to, const char *word, uint32_t i)
{
	if (i != SCENE_NONE)
		fprintf(to, " %s %u", word, i);
}

static void end_line(FILE *to, unsigned what, const struct diag_pos *pos)
{
	if (what & SCENE_DUMP_PLACES && pos && pos->file)
		fprintf(to, " at %s:%u:%u", pos->file, pos->line, pos->col);
	putc('\n', to);
}

static void dump_camera(const struct scene *s, unsigned what, FILE *to)
{
	static const char *const kind[] = { "perspective", "orthographic", "fisheye",
					    "ultra_wide_angle", "omnimax", "panoramic", "spherical",
					    "cylinder 1", "cylinder 2", "cylinder 3", "cylinder 4" };
	const struct camera *c = &s->camera;

	if (!s->has_camera)
		return;
	fprintf(to, "camera %s", kind[c->kind]);
	put_vec(to, "location", c->location);
	put_vec(to, "direction", c->direction);
	put_vec(to, "right", c->right);
	put_vec(to, "up", c->up);
	if (c->kind != CAMERA_PERSPECTIVE && c->kind != CAMERA_ORTHOGRAPHIC)
		put_word(to, "angle", c->angle);
	if (c->kind == CAMERA_SPHERICAL)
		put_word(to, "angle_up", c->angle_up);
	if (c->aperture != 0) {
		put_word(to, "aperture", c->aperture);
		put_word(to, "focal_distance", c->focal_distance);
		fprintf(to, " blur_samples %u", c->blur_samples);
	}
	end_line(to, what, &c->pos);
}

static void dump_sky(const struct sky_sphere *sky, FILE *to)
{
	fprintf(to, "sky_sphere pigments %u", sky->count);
	put_rgb(to, "emission", sky->emission);
	putc('\n', to);
	for (uint32_t i = 0; i < sky->count; i++) {
		fputs("  pigment", to);
		if (sky->pigment[i]->pattern)
			fputs(" pattern", to);
		else
			put_rgbft(to, "colour", sky->pigment[i]->colour);
		putc('\n', to);
	}
}

static void dump_fog(const struct fog *f, uint32_t i, FILE *to)
{
	fprintf(to, "fog %u", i);
	put_word(to, "distance", f->distance);
	put_rgbft(to, "colour", f->colour);
	if (f->ground) {
		put_vec(to, "ground up", f->up);
		put_word(to, "offset", f->offset);
		put_word(to, "alt", f->alt);
	}
	if (f->turbulence.x != 0 || f->turbulence.y != 0 || f->turbulence.z != 0) {
		put_vec(to, "turbulence", f->turbulence);
		put_word(to, "turb_depth", f->turb_depth);
		put_word(to, "lambda", f->lambda);
		put_word(to, "omega", f->omega);
		fprintf(to, " octaves %u", f->octaves);
	}
	putc('\n', to);
}

static void dump_light(const struct light *l, uint32_t i, unsigned what, FILE *to)
{
	static const char *const kind[] = { "point", "spot", "cylinder" };

	fprintf(to, "light %u %s", i, kind[l->kind]);
	put_vec(to, "location", l->location);
	put_rgb(to, "colour", l->colour);
	if (l->parallel)
		fputs(" parallel", to);
	if (l->shadowless)
		fputs(" shadowless", to);
	if (l->attenuated)
		fputs(" attenuated", to);
	if (l->no_media)
		fputs(" no_media", to);
	if (l->kind != LIGHT_POINT || l->parallel)
		put_vec(to, "direction", l->direction);
	if (l->kind != LIGHT_POINT) {
		put_word(to, "axis_length", l->axis_length);
		put_word(to, "radius", l->radius);
		put_word(to, "falloff", l->falloff);
		put_word(to, "tightness", l->tightness);
	}
	if (l->area) {
		put_vec(to, "area", l->axis1);
		put_vec(to, "by", l->axis2);
		fprintf(to, " points %u %u", l->size1, l->size2);
		put_index(to, "adaptive", l->adaptive);
		fprintf(to, "%s%s%s%s", l->area_illumination ? " area_illumination" : "",
			l->jitter ? " jitter" : "", l->circular ? " circular" : "",
			l->orient ? " orient" : "");
	}
	if (l->fade_distance != 0 || l->fade_power != 0) {
		put_word(to, "fade_distance", l->fade_distance);
		put_word(to, "fade_power", l->fade_power);
	}
	put_index(to, "group", l->group);
	fputs(l->projected ? " projected" : "", to);
	end_line(to, what, &l->pos);
}

static void dump_media(uint32_t count, const struct media *media, FILE *to)
{
	for (const struct media *m = media; m < media + count; m++) {
		fputs("  media", to);
		put_rgb(to, "absorption", m->absorption);
		put_rgb(to, "emission", m->emission);
		put_rgb(to, "scattering", m->scattering);
		fprintf(to, " type %d", (int)m->phase);
		put_word(to, "extinction", m->extinction);
		put_word(to, "eccentricity", m->eccentricity);
		fprintf(to, " method %u intervals %u samples %u %u densities %u\n", m->method, m->intervals,
			m->samples_min, m->samples_max, m->density_count);
	}
}

static void dump_interior(const struct interior *in, uint32_t i, FILE *to)
{
	fprintf(to, "interior %u", i);
	put_word(to, "ior", in->ior);
	put_word(to, "caustics", in->caustics);
	put_word(to, "fade_distance", in->fade_distance);
	put_word(to, "fade_power", in->fade_power);
	put_rgb(to, "fade_colour", in->fade_colour);
	if (in->dispersion != 1) {
		put_word(to, "dispersion", in->dispersion);
		fprintf(to, " samples %u", in->dispersion_samples);
	}
	putc('\n', to);
	dump_media(in->media_count, in->media, to);
}

static void dump_indices(const char *word, const uint32_t *v, size_t count, unsigned per, FILE *to)
{
	for (size_t i = 0; i < count; i++) {
		fprintf(to, "  %s %zu", word, i);
		for (unsigned k = 0; k < per; k++) {
			if (v[i * per + k] == SCENE_NONE)
				fputs(" none", to);
			else
				fprintf(to, " %u", v[i * per + k]);
		}
		putc('\n', to);
	}
}

static void dump_arrays(const struct mesh *m, FILE *to)
{
	for (size_t i = 0; i < m->vertex_count; i++) {
		fprintf(to, "  vertex %zu", i);
		for (int k = 0; k < 3; k++)
			put(to, m->vertex[3 * i + (size_t)k]);
		putc('\n', to);
	}
	for (size_t i = 0; i < m->normal_count; i++) {
		fprintf(to, "  normal %zu", i);
		for (int k = 0; k < 3; k++)
			fprintf(to, " %.6g", (double)m->normal[3 * i + (size_t)k]);
		putc('\n', to);
	}
	for (size_t i = 0; m->uv && i < m->uv_count; i++)
		fprintf(to, "  uv %zu %.6g %.6g\n", i, (double)m->uv[2 * i], (double)m->uv[2 * i + 1]);
	dump_indices("triangle", m->index, m->triangle_count, 3, to);
	if (m->normal_index)
		dump_indices("normal_index", m->normal_index, m->smooth_count, 3, to);
	if (m->uv_index)
		dump_indices("uv_index", m->uv_index, m->triangle_count, 3, to);
	if (m->texture)
		dump_indices("texture", m->texture, m->triangle_count, m->textures_per_face, to);
}

static void dump_mesh(const struct mesh *m, uint32_t i, unsigned what, FILE *to)
{
	fprintf(to, "mesh %u vertices %u triangles %u smooth %u normals %u textures_per_face %u", i,
		m->vertex_count, m->triangle_count, m->smooth_count, m->normal_count,
		m->textures_per_face);
	if (m->has_inside)
		put_vec(to, "inside", m->inside);
	end_line(to, what, &m->pos);
	if (what & SCENE_DUMP_ARRAYS)
		dump_arrays(m, to);
}

static void dump_shape(const struct object *o, FILE *to)
{
	switch (o->kind) {
	case SHAPE_MESH:
		fprintf(to, " mesh %u", o->shape.mesh);
		break;
	case SHAPE_SPHERE:
		put_vec(to, "sphere", o->shape.sphere.centre);
		put_word(to, "radius", o->shape.sphere.radius);
		break;
	case SHAPE_BOX:
		put_vec(to, "box", o->shape.box.lo);
		put_vec(to, "to", o->shape.box.hi);
		break;
	case SHAPE_CONE:
		put_vec(to, "cone", o->shape.cone.base);
		put_word(to, "radius", o->shape.cone.base_radius);
		put_vec(to, "to", o->shape.cone.apex);
		put_word(to, "radius", o->shape.cone.apex_radius);
		fputs(o->shape.cone.open ? " open" : "", to);
		break;
	case SHAPE_PLANE:
		put_vec(to, "plane", o->shape.plane.normal);
		put_word(to, "distance", o->shape.plane.distance);
		break;
	case SHAPE_DISC:
		put_vec(to, "disc", o->shape.disc.centre);
		put_vec(to, "normal", o->shape.disc.normal);
		put_word(to, "radius", o->shape.disc.radius);
		put_word(to, "hole", o->shape.disc.hole);
		break;
	case SHAPE_TORUS:
		put_word(to, "torus", o->shape.torus.major);
		put_word(to, "minor", o->shape.torus.minor);
		break;
	case SHAPE_SUPERELLIPSOID:
		put_word(to, "superellipsoid", o->shape.superellipsoid.a);
		put_word(to, "by", o->shape.superellipsoid.b);
		break;
	case SHAPE_ALGEBRAIC:
		fprintf(to, " algebraic %u", o->shape.algebraic);
		break;
	case SHAPE_SWEEP:
		fprintf(to, " sweep %u", o->shape.sweep);
		break;
	case SHAPE_LATHE:
		fprintf(to, " lathe %u", o->shape.lathe.index);
		break;
	case SHAPE_PRISM:
		fprintf(to, " prism %u", o->shape.prism.index);
		break;
	case SHAPE_ISOSURFACE:
		fprintf(to, " isosurface %u", o->shape.isosurface);
		break;
	case SHAPE_BLOB:
		fprintf(to, " blob %u", o->shape.blob);
		break;
	case SHAPE_MERGE:
		fputs(" merge", to);
		break;
	case SHAPE_INTERSECTION:
		fputs(" intersection", to);
		break;
	default:
		fputs(" union", to);
	}
}

static void dump_flags(unsigned flags, FILE *to)
{
	static const char *const word[] = { "no_shadow", "no_image", "no_reflection", "hollow",
					    "double_illuminate", "inverse", "no_radiosity", "projected" };

	for (unsigned i = 0; i < sizeof(word) / sizeof(word[0]); i++) {
		if (flags & 1u << i)
			fprintf(to, " %s", word[i]);
	}
}

static void dump_object(const struct object *o, uint32_t i, unsigned what, FILE *to)
{
	fprintf(to, "object %u", i);
	dump_shape(o, to);
	put_index(to, "texture", o->texture);
	put_index(to, "interior_texture", o->interior_texture);
	put_index(to, "interior", o->interior);
	put_index(to, "light_set", o->light_set);
	put_index(to, "first_child", o->first_child);
	put_index(to, "first_clip", o->first_clip);
	put_index(to, "next", o->next_sibling);
	dump_flags(o->flags, to);
	if (!mat_is_identity(&o->place.fwd))
		put_mat(to, "place", &o->place.fwd);
	if (o->texture_place)
		put_mat(to, "texture_place", &o->texture_place->fwd);
	if (o->interior_texture_place)
		put_mat(to, "interior_texture_place", &o->interior_texture_place->fwd);
	end_line(to, what, &o->pos);
}

static void dump_radiosity(const struct radiosity *r, FILE *to)
{
	fprintf(to, "radiosity recursion_limit %u", r->recursion_limit);
	put_word(to, "brightness", r->brightness);
	put_word(to, "gray_threshold", r->gray_threshold);
	put_word(to, "adc_bailout", r->adc_bailout);
	put_word(to, "max_sample", r->max_sample);
	fprintf(to, " count %u nearest_count %u", r->count, r->nearest_count);
	put_word(to, "error_bound", r->error_bound);
	put_word(to, "low_error_factor", r->low_error_factor);
	put_word(to, "minimum_reuse", r->minimum_reuse);
	put_word(to, "maximum_reuse", r->maximum_reuse);
	put_word(to, "pretrace_start", r->pretrace_start);
	put_word(to, "pretrace_end", r->pretrace_end);
	fprintf(to, "%s%s%s%s\n", r->normal ? " normal" : "", r->media ? " media" : "",
		r->subsurface ? " subsurface" : "", r->always_sample ? " always_sample" : "");
}

static void dump_subsurface(const struct subsurface *s, FILE *to)
{
	fprintf(to, "subsurface samples %u %u", s->samples, s->single_samples);
	put_word(to, "mm_per_unit", s->mm_per_unit);
	fprintf(to, "%s\n", s->radiosity ? " radiosity" : "");
}

void scene_dump(const struct scene *s, unsigned what, FILE *to)
{
	fprintf(to, "scene version %d", s->version);
	put_word(to, "assumed_gamma", s->assumed_gamma);
	fprintf(to, " max_trace_level %u", s->max_trace_level);
	put_word(to, "adc_bailout", s->adc_bailout);
	put_rgb(to, "ambient_light", s->ambient_light);
	put_rgbft(to, "background", s->background);
	fputc('\n', to);
	if (s->radiosity.given)
		dump_radiosity(&s->radiosity, to);
	if (s->subsurface.given)
		dump_subsurface(&s->subsurface, to);
	dump_camera(s, what, to);
	if (s->sky)
		dump_sky(s->sky, to);
	for (uint32_t i = 0; i < s->fog_count; i++)
		dump_fog(&s->fog[i], i, to);
	for (uint32_t i = 0; i < s->light_count; i++)
		dump_light(&s->light[i], i, what, to);
	for (uint32_t i = 0; i < s->light_set_count; i++)
		fprintf(to, "light_set %u group %u%s\n", i, s->light_set[i].group,
			s->light_set[i].global ? " global_lights" : "");
	dump_textures(s, to);
	for (uint32_t i = 0; i < s->interior_count; i++)
		dump_interior(&s->interior[i], i, to);
	dump_media(s->media_count, s->media, to);
	for (uint32_t i = 0; i < s->mesh_count; i++)
		dump_mesh(&s->mesh[i], i, what, to);
	if (s->first_root != SCENE_NONE)
		fprintf(to, "roots from %u\n", s->first_root);
	for (uint32_t i = 0; i < s->object_count; i++)
		dump_object(&s->object[i], i, what, to);
}
