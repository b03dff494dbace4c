/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The part of scene_dump() that textures are: patterns and maps once each, by number where they are used.
 */
#include <config.h>

#include "scene/put.h"

#include <stdlib.h>

/* The shortest of the usual precisions that reads back as the same number. */
void put(FILE *to, double x)
{
	char text[40];

	for (int digits = 6; digits <= 17; digits++) {
		snprintf(text, sizeof(text), "%.*g", digits, x);
		if (strtod(text, NULL) == x)
			break;
	}
	fprintf(to, " %s", text);
}

void put_word(FILE *to, const char *word, double x)
{
	fprintf(to, " %s", word);
	put(to, x);
}

void put_vec(FILE *to, const char *word, vec v)
{
	fprintf(to, " %s <", word);
	put(to, v.x);
	put(to, v.y);
	put(to, v.z);
	fputs(" >", to);
}

void put_rgb(FILE *to, const char *word, struct rgb c)
{
	put_vec(to, word, vec_make(c.r, c.g, c.b));
}

void put_rgbft(FILE *to, const char *word, struct rgbft c)
{
	put_rgb(to, word, rgbft_rgb(c));
	put_word(to, "filter", c.filter);
	put_word(to, "transmit", c.transmit);
}

void put_mat(FILE *to, const char *word, const struct mat *m)
{
	fprintf(to, " %s <", word);
	for (int r = 0; r < 4; r++) {
		for (int c = 0; c < 3; c++)
			put(to, m->m[r][c]);
	}
	fputs(" >", to);
}

static const char *const kind_name[PATTERN_KINDS] = {
	[PATTERN_CHECKER] = "checker",	 [PATTERN_BRICK] = "brick",
	[PATTERN_HEXAGON] = "hexagon",	 [PATTERN_SQUARE] = "square",
	[PATTERN_TRIANGULAR] = "triangular", [PATTERN_CUBIC] = "cubic",
	[PATTERN_OBJECT] = "object",	 [PATTERN_AVERAGE] = "average",
	[PATTERN_IMAGE_MAP] = "image_map", [PATTERN_MATERIAL_MAP] = "material_map",
	[PATTERN_BUMP_MAP] = "bump_map", [PATTERN_GRADIENT] = "gradient",
	[PATTERN_AGATE] = "agate",	 [PATTERN_AOI] = "aoi",
	[PATTERN_BOXED] = "boxed",	 [PATTERN_BOZO] = "bozo",
	[PATTERN_BUMPS] = "bumps",	 [PATTERN_CELLS] = "cells",
	[PATTERN_CRACKLE] = "crackle",	 [PATTERN_CYLINDRICAL] = "cylindrical",
	[PATTERN_DENSITY_FILE] = "density_file", [PATTERN_DENTS] = "dents",
	[PATTERN_FACETS] = "facets",	 [PATTERN_FRACTAL] = "fractal",
	[PATTERN_FUNCTION] = "function", [PATTERN_GRANITE] = "granite",
	[PATTERN_IMAGE] = "image_pattern", [PATTERN_LEOPARD] = "leopard",
	[PATTERN_MARBLE] = "marble",	 [PATTERN_ONION] = "onion",
	[PATTERN_PAVEMENT] = "pavement", [PATTERN_PIGMENT] = "pigment_pattern",
	[PATTERN_PLANAR] = "planar",	 [PATTERN_QUILTED] = "quilted",
	[PATTERN_RADIAL] = "radial",	 [PATTERN_RIPPLES] = "ripples",
	[PATTERN_SLOPE] = "slope",	 [PATTERN_SPHERICAL] = "spherical",
	[PATTERN_SPIRAL1] = "spiral1",	 [PATTERN_SPIRAL2] = "spiral2",
	[PATTERN_SPOTTED] = "spotted",	 [PATTERN_TILING] = "tiling",
	[PATTERN_WAVES] = "waves",	 [PATTERN_WOOD] = "wood",
	[PATTERN_WRINKLES] = "wrinkles",
};

static const char *const warp_name[] = { "transform", "turbulence", "repeat",	"black_hole", "planar",
					 "cylindrical", "spherical", "toroidal", "cubic" };
static const char *const wave_name[] = { "ramp", "sine", "triangle", "scallop", "cubic", "poly" };
static const char *const map_name[] = { "none", "colour", "pigment", "normal", "texture", "slope" };

static void put_turbulence(FILE *to, vec amount, uint32_t octaves, double lambda, double omega)
{
	put_vec(to, "amount", amount);
	fprintf(to, " octaves %u", octaves);
	put_word(to, "lambda", lambda);
	put_word(to, "omega", omega);
}

static void dump_warp(const struct warp *w, FILE *to)
{
	fprintf(to, "\n  warp %s", warp_name[w->kind]);
	switch (w->kind) {
	case WARP_TRANSFORM:
		put_mat(to, "place", &w->w.place.fwd);
		break;
	case WARP_TURBULENCE:
		put_turbulence(to, w->w.turbulence.amount, w->w.turbulence.octaves, w->w.turbulence.lambda,
			       w->w.turbulence.omega);
		break;
	case WARP_REPEAT:
		fprintf(to, " axis %u", w->w.repeat.axis);
		put_word(to, "width", w->w.repeat.width);
		put_vec(to, "offset", w->w.repeat.offset);
		put_vec(to, "flip", w->w.repeat.flip);
		break;
	case WARP_BLACK_HOLE:
		put_vec(to, "centre", w->w.hole.centre);
		put_word(to, "radius", w->w.hole.radius);
		put_word(to, "power", w->w.hole.power);
		put_word(to, "strength", w->w.hole.strength);
		fputs(w->w.hole.inverse ? " inverse" : "", to);
		if (w->w.hole.repeats)
			put_vec(to, "repeat", w->w.hole.repeat);
		break;
	case WARP_CUBIC:
		break;
	default:
		put_vec(to, "orientation", w->w.map.orientation);
		put_word(to, "dist_exp", w->w.map.exponent);
		put_word(to, "distance", w->w.map.distance);
		put_word(to, "major_radius", w->w.map.major);
	}
}

static void dump_picture(const struct picture_place *p, FILE *to)
{
	if (p->picture)
		fprintf(to, " %s %ux%u", p->picture->path ? p->picture->path : "-", p->picture->width,
			p->picture->height);
	fprintf(to, " map_type %d interpolate %d%s%s", (int)p->map_type, (int)p->interpolate,
		p->once ? " once" : "", p->clear ? " clear" : "");
}

static void dump_more(const struct pattern *q, FILE *to)
{
	switch (q->kind) {
	case PATTERN_IMAGE_MAP:
	case PATTERN_MATERIAL_MAP:
	case PATTERN_BUMP_MAP:
	case PATTERN_IMAGE:
		dump_picture(&q->of.image, to);
		break;
	case PATTERN_FRACTAL:
		fprintf(to, " magnet %u%s iterations %u exponent %u exterior %u interior %u", q->of.fractal.magnet,
			q->of.fractal.julia ? " julia" : "", q->of.fractal.iterations, q->of.fractal.exponent,
			q->of.fractal.exterior, q->of.fractal.interior);
		put_word(to, "factor", q->of.fractal.exterior_factor);
		put(to, q->of.fractal.interior_factor);
		put_word(to, "at", q->of.fractal.re);
		put(to, q->of.fractal.im);
		break;
	case PATTERN_TILING:
		fprintf(to, " %u", q->of.tiling);
		break;
	case PATTERN_PAVEMENT:
		fprintf(to, " sides %u tiles %u number %u exterior %u interior %u form %u", q->of.pavement.sides,
			q->of.pavement.tiles, q->of.pavement.number, q->of.pavement.exterior,
			q->of.pavement.interior, q->of.pavement.form);
		break;
	default:
		break;
	}
}

static void dump_parameters(const struct pattern *q, FILE *to)
{
	switch (q->kind) {
	case PATTERN_GRADIENT:
		put_vec(to, "along", q->of.gradient);
		break;
	case PATTERN_BRICK:
		put_vec(to, "size", q->of.brick.size);
		put_word(to, "mortar", q->of.brick.mortar);
		break;
	case PATTERN_AGATE:
		put_word(to, "agate_turb", q->of.agate_turb);
		break;
	case PATTERN_CRACKLE:
		put_vec(to, "form", q->of.crackle.form);
		put_word(to, "metric", q->of.crackle.metric);
		put_word(to, "offset", q->of.crackle.offset);
		fputs(q->of.crackle.solid ? " solid" : "", to);
		break;
	case PATTERN_FACETS:
		put_word(to, "size", q->of.facets.size);
		put_word(to, "coords", q->of.facets.coords);
		put_word(to, "metric", q->of.facets.metric);
		break;
	case PATTERN_QUILTED:
		put_word(to, "control0", q->of.quilted.control0);
		put_word(to, "control1", q->of.quilted.control1);
		break;
	case PATTERN_SLOPE:
		put_vec(to, q->of.slope.point_at ? "point_at" : "along", q->of.slope.slope);
		put_word(to, "from", q->of.slope.slope_low);
		put_word(to, "width", q->of.slope.slope_width);
		put_vec(to, "altitude", q->of.slope.altitude);
		put_word(to, "from", q->of.slope.altitude_low);
		put_word(to, "width", q->of.slope.altitude_width);
		put_word(to, "weight", q->of.slope.slope_weight);
		break;
	case PATTERN_SPIRAL1:
	case PATTERN_SPIRAL2:
		fprintf(to, " arms %d", (int)q->of.arms);
		break;
	default:
		dump_more(q, to);
	}
}

static void put_pigment(const struct pigment *p, FILE *to)
{
	if (!p->pattern) {
		put_rgbft(to, "colour", p->colour);
		return;
	}
	fprintf(to, "%s pattern %u", p->uv ? " uv" : "", p->pattern->id);
	if (p->map.count)
		fprintf(to, " map %u", p->map.id);
}

static void dump_pattern(const struct pattern *q, FILE *to)
{
	fprintf(to, "pattern %u %s", q->id, kind_name[q->kind]);
	dump_parameters(q, to);
	if (q->kind == PATTERN_PIGMENT)
		put_pigment(q->of.pigment, to);
	if (q->kind >= PATTERN_FIRST_VALUE) {
		fprintf(to, " wave %s", wave_name[q->wave]);
		put_word(to, "frequency", q->frequency);
		put_word(to, "phase", q->phase);
	}
	if (q->wave == WAVE_POLY)
		put_word(to, "exponent", q->exponent);
	if (q->noise)
		fprintf(to, " noise_generator %u", q->noise);
	if (vec_length(q->turbulence.amount) > 0) {
		fputs(" turbulence", to);
		put_turbulence(to, q->turbulence.amount, q->turbulence.octaves, q->turbulence.lambda,
			       q->turbulence.omega);
	}
	for (uint32_t i = 0; i < q->warp_count; i++)
		dump_warp(&q->warp[i], to);
	putc('\n', to);
}

static void dump_finish(const struct finish *f, FILE *to)
{
	put_rgb(to, "ambient", f->ambient);
	put_rgb(to, "emission", f->emission);
	put_word(to, "diffuse", f->diffuse);
	put_word(to, "diffuse_back", f->diffuse_back);
	put_word(to, "brilliance", f->brilliance);
	put_word(to, "phong", f->phong);
	put_word(to, "phong_size", f->phong_size);
	put_word(to, "specular", f->specular);
	put_word(to, "roughness", f->roughness);
	put_word(to, "metallic", f->metallic);
	put_rgb(to, "reflection", f->reflection_min);
	put_rgb(to, "to", f->reflection_max);
	put_word(to, "falloff", f->reflection_falloff);
	put_word(to, "exponent", f->reflection_exponent);
	put_word(to, "reflection_metallic", f->reflection_metallic);
	if (f->irid > 0) {
		put_word(to, "irid", f->irid);
		put_word(to, "thickness", f->irid_thickness);
		put_word(to, "turbulence", f->irid_turbulence);
	}
	if (f->crand > 0)
		put_word(to, "crand", f->crand);
	if (f->subsurface)
		put_rgb(to, "translucency", f->translucency);
	fprintf(to, "%s%s\n", f->reflection_fresnel ? " fresnel" : "",
		f->conserve_energy ? " conserve_energy" : "");
}

static void dump_normal(const struct normal *n, FILE *to)
{
	if (!n || !n->pattern) {
		fputs(" none", to);
		return;
	}
	fprintf(to, "%s%s pattern %u", n->uv ? " uv" : "", n->no_bump_scale ? " no_bump_scale" : "",
		n->pattern->id);
	put_word(to, "amount", n->amount);
	put_word(to, "accuracy", n->accuracy);
	if (n->map.count)
		fprintf(to, " map %u", n->map.id);
}

static void dump_texture(const struct texture *t, FILE *to)
{
	if (t->pattern) {
		fprintf(to, "%s pattern %u map %u\n", t->uv ? " uv" : "", t->pattern->id, t->map.id);
		return;
	}
	fprintf(to, " layers %u%s\n", t->count, t->uv ? " uv" : "");
	for (uint32_t k = 0; k < t->count; k++) {
		fputs("  pigment", to);
		put_pigment(&t->layer[k].pigment, to);
		if (t->layer[k].normal) {
			fputs("\n  normal", to);
			dump_normal(t->layer[k].normal, to);
		}
		fputs("\n  finish", to);
		dump_finish(&t->layer[k].finish, to);
	}
}

static void dump_map(const struct map *m, FILE *to)
{
	fprintf(to, "map %u %s\n", m->id, map_name[m->kind]);
	for (uint32_t i = 0; i < m->count; i++) {
		const struct map_entry *e = &m->entry[i];

		put_word(to, " at", e->at);
		switch (m->kind) {
		case MAP_COLOUR:
			put_rgbft(to, "colour", e->is.colour);
			break;
		case MAP_PIGMENT:
			put_pigment(e->is.pigment, to);
			break;
		case MAP_NORMAL:
			dump_normal(e->is.normal, to);
			break;
		case MAP_TEXTURE:
			dump_texture(e->is.texture, to);
			continue;
		default:
			put_word(to, "height", e->is.slope.height);
			put_word(to, "slope", e->is.slope.slope);
		}
		putc('\n', to);
	}
}

void dump_textures(const struct scene *s, FILE *to)
{
	for (uint32_t i = 0; i < s->pattern_count; i++)
		dump_pattern(s->pattern[i], to);
	for (uint32_t i = 0; i < s->map_count; i++)
		dump_map(&s->map[i], to);
	for (uint32_t i = 0; i < s->texture_count; i++) {
		fprintf(to, "texture %u", i);
		dump_texture(&s->texture[i], to);
	}
}
