/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Media (manual 3.4.8.2): in interiors, and by themselves as what fills the world.
 */
#include <config.h>

#include "read/pov/pattern.h"

#include <string.h>

#define SAMPLES_MAX 60000 /* and intervals: their numbers fit into 16 bits, see shade/pov/media.c */
#define LEVELS_MAX 15

static void read_samples(struct pov *p, struct media *m)
{
	m->samples_min = m->samples_max = pov_count(p, "samples", 1, SAMPLES_MAX);
	pov_comma(p);
	if (pov_starts_number(p))
		m->samples_max = pov_count(p, "samples", m->samples_min, SAMPLES_MAX);
}

static void read_scattering(struct pov *p, struct media *m)
{
	if (!pov_expect(p, TOK_LEFT_BRACE, "scattering"))
		return;
	m->phase = (enum media_scattering)pov_count(p, "the type of scattering", 1, 5);
	pov_comma(p);
	m->scattering = rgbft_rgb(pov_finite_colour(p, "scattering"));
	while (!pov_failed(p)) {
		struct diag_pos at = pov_here(p);

		if (pov_accept(p, TOK_EXTINCTION)) {
			m->extinction = pov_finite_float(p, "extinction");
		} else if (pov_accept(p, TOK_ECCENTRICITY)) {
			m->eccentricity = pov_finite_float(p, "eccentricity");
			if (m->phase != MEDIA_HENYEY_GREENSTEIN)
				pov_fail_at(p, &at, "eccentricity belongs to scattering type 5, not %d", (int)m->phase);
			else if (!(fabs(m->eccentricity) < 1))
				pov_fail_at(p, &at, "eccentricity is %g, but has to be between -1 and 1",
					    m->eccentricity);
		} else {
			break;
		}
	}
	pov_expect(p, TOK_RIGHT_BRACE, "scattering");
}

/* How it is sampled. */
static bool sampling_word(struct pov *p, struct media *m)
{
	switch (pov_token(p)) {
	case TOK_INTERVALS:
		pov_next(p);
		m->intervals = pov_count(p, "intervals", 1, SAMPLES_MAX);
		return true;
	case TOK_SAMPLES:
		pov_next(p);
		read_samples(p, m);
		return true;
	case TOK_METHOD:
		pov_next(p);
		m->method = pov_count(p, "method", 1, 3);
		return true;
	case TOK_JITTER:
		pov_next(p);
		m->jitter = pov_finite_float(p, "jitter");
		return true;
	case TOK_AA_THRESHOLD:
		pov_next(p);
		m->aa_threshold = pov_positive(p, "aa_threshold");
		return true;
	case TOK_AA_LEVEL:
		pov_next(p);
		m->aa_level = pov_count(p, "aa_level", 1, LEVELS_MAX);
		return true;
	case TOK_RATIO:
		pov_next(p);
		m->ratio = pov_finite_float(p, "ratio");
		return true;
	case TOK_CONFIDENCE: /* when POV-Ray stops between the two numbers of samples */
	case TOK_VARIANCE:
		pov_next(p);
		pov_finite_float(p, "confidence or variance");
		return true;
	case TOK_COLLECT: /* photons */
		pov_next(p);
		pov_bool(p, true);
		return true;
	default:
		return false;
	}
}

static bool add_density(struct pov *p, struct pov_media *out)
{
	struct media *m = &out->media;
	struct pigment *all = pov_new(p, (m->density_count + 1) * sizeof(*all));
	struct pov_pigment *d = pov_read_density(p);

	if (!all || !d)
		return false;
	if (m->density_count)
		memcpy(all, m->density, m->density_count * sizeof(*all));
	all[m->density_count++] = d->pigment;
	m->density = all;
	pov_lack_add(&out->lack, &d->lack);
	return true;
}

/* Transforms move the densities that stand before them. */
static bool move_densities(struct pov *p, struct pov_media *out)
{
	struct media *m = &out->media;
	struct xform x = xform_identity;
	struct pigment *moved;

	if (!pov_transform(p, &x))
		return false;
	moved = pov_new(p, (m->density_count + 1) * sizeof(*moved));
	for (uint32_t i = 0; moved && i < m->density_count; i++) {
		moved[i] = m->density[i];
		if (moved[i].pattern)
			moved[i].pattern = pattern_transform(p, moved[i].pattern, &x);
	}
	m->density = moved;
	return true;
}

struct pov_media *pov_read_media(struct pov *p)
{
	struct pov_media out = { .media = media_default(pov_version(p)) }, *named;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_MEDIA);
	if (named)
		out = *named;
	while (!pov_failed(p)) {
		struct media *m = &out.media;

		if (pov_accept(p, TOK_ABSORPTION))
			m->absorption = rgbft_rgb(pov_finite_colour(p, "absorption"));
		else if (pov_accept(p, TOK_EMISSION))
			m->emission = rgbft_rgb(pov_finite_colour(p, "emission"));
		else if (pov_accept(p, TOK_SCATTERING))
			read_scattering(p, m);
		else if (pov_token(p) == TOK_DENSITY)
			add_density(p, &out);
		else if (!sampling_word(p, m) && !move_densities(p, &out))
			break;
	}
	return pov_close(p, "media") ? pov_copy(p, &out, sizeof(out)) : NULL;
}

bool pov_add_media(struct pov *p, uint32_t *count, struct pov_media **media)
{
	struct pov_media *one = pov_read_media(p), *all;

	if (!one)
		return false;
	all = pov_new(p, (*count + 1) * sizeof(*all));
	if (!all)
		return false;
	if (*count)
		memcpy(all, *media, *count * sizeof(*all));
	all[(*count)++] = *one;
	*media = all;
	return true;
}

static bool varies(const struct media *m)
{
	for (uint32_t i = 0; i < m->density_count; i++) {
		if (m->density[i].pattern)
			return true;
	}
	return false;
}

static bool use_one(struct pov *p, const struct pov_media *from, const struct xform *place, struct media *to)
{
	struct scene *s = pov_scene(p);

	if (!pov_lack_use(p, &from->lack))
		return false;
	*to = from->media;
	to->density = arena_zalloc(&s->arena, mem_product(to->density_count + 1, sizeof(*to->density)));
	if (!to->density)
		return pov_no_memory(p);
	if (!mat_is_identity(&place->fwd) && varies(&from->media)) {
		to->place = (void *)arena_memdup(&s->arena, place, sizeof(*place));
		if (!to->place)
			return pov_no_memory(p);
	}
	for (uint32_t i = 0; i < to->density_count; i++) {
		struct pigment *d = scene_adopt_pigment(s, &pov_state(p)->copies, &from->media.density[i]);

		if (!d)
			return pov_no_memory(p);
		to->density[i] = *d;
	}
	return true;
}

bool pov_use_media(struct pov *p, uint32_t count, const struct pov_media *from, const struct xform *place,
		   struct media **out)
{
	*out = arena_zalloc(&pov_scene(p)->arena, mem_product(count + 1, sizeof(**out)));
	if (!*out)
		return pov_no_memory(p);
	for (uint32_t i = 0; i < count; i++) {
		if (!use_one(p, &from[i], place, &(*out)[i]))
			return false;
	}
	return true;
}
