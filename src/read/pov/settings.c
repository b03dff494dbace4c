/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * global_settings (manual 3.4.1).
 */
#include <config.h>

#include "read/pov/items.h"

static void read_gamma(struct pov *p)
{
	struct diag_pos at;
	double g;

	pov_next(p);
	if (pov_token(p) == TOK_SRGB) {
		pov_fail(p, "assumed_gamma srgb is not rendered; 1.0 is what POV-Ray advises");
		return;
	}
	at = pov_here(p);
	g = pov_positive(p, "assumed_gamma");
	if (pov_failed(p))
		return;
	if (pov_state(p)->gamma_given && g != pov_scene(p)->assumed_gamma)
		pov_warn(p, &at, "assumed_gamma changes from %g to %g: colours read before are not "
			 "converted", pov_scene(p)->assumed_gamma, g);
	pov_scene(p)->assumed_gamma = g;
	pov_state(p)->gamma_given = true;
}

static void read_trace_level(struct pov *p)
{
	struct diag_pos at;
	double x;

	pov_next(p);
	at = pov_here(p);
	x = pov_finite_float(p, "max_trace_level");
	if (pov_failed(p))
		return;
	/* POV-Ray's own limits, and its own way of keeping them. */
	if (x < 1 || x > 256) {
		pov_warn(p, &at, "max_trace_level is %g, but has to be from 1 to 256: the nearest is taken",
			 x);
		x = x < 1 ? 1 : 256;
	}
	pov_scene(p)->max_trace_level = (uint32_t)x;
}

#define SAMPLES_MAX 1e6

/* What only a picture with photons needs; decided when all has been read. */
static void read_photons(struct pov *p)
{
	pov_lack_note(p, &pov_state(p)->photons, "photons",
		      "remove photons { } from global_settings");
	pov_next(p);
	pov_skip_block(p);
}

/* POV-Ray takes none for 0 and less. */
static uint32_t read_samples(struct pov *p)
{
	double n = trunc(pov_finite_float(p, "subsurface's samples"));

	return n >= 1 ? (uint32_t)fmin(n, SAMPLES_MAX) : 0;
}

static bool read_subsurface_word(struct pov *p, struct subsurface *s)
{
	switch (pov_token(p)) {
	case TOK_SAMPLES:
		pov_next(p);
		s->samples = read_samples(p);
		pov_comma(p);
		s->single_samples = read_samples(p);
		return true;
	case TOK_RADIOSITY:
		pov_next(p);
		s->radiosity = pov_bool(p, true);
		return true;
	default:
		return false;
	}
}

static void read_subsurface(struct pov *p)
{
	struct subsurface *s = &pov_scene(p)->subsurface;

	if (!pov_open(p))
		return;
	s->given = true;
	while (!pov_failed(p) && read_subsurface_word(p, s))
		;
	pov_close(p, "subsurface");
}

uint32_t pov_noise_generator(struct pov *p)
{
	struct diag_pos at = pov_here(p);
	double n = trunc(pov_finite_float(p, "noise_generator"));

	if (n >= 1 && n <= 3)
		return (uint32_t)n;
	pov_fail_at(p, &at, "noise_generator %g is none of 1, 2 and 3", n);
	return 2;
}

static void read_waves(struct pov *p)
{
	struct diag_pos at;
	double n;

	pov_next(p);
	at = pov_here(p);
	n = trunc(pov_finite_float(p, "number_of_waves"));
	if (n > 1000)
		pov_fail_at(p, &at, "number_of_waves %g is more than 1000", n);
	else
		pov_scene(p)->number_of_waves = n >= 1 ? (uint32_t)n : 1;
}

static bool read_word(struct pov *p)
{
	struct scene *s = pov_scene(p);

	switch (pov_token(p)) {
	case TOK_ASSUMED_GAMMA:
		read_gamma(p);
		return true;
	case TOK_MAX_TRACE_LEVEL:
		read_trace_level(p);
		return true;
	case TOK_ADC_BAILOUT:
		pov_next(p);
		s->adc_bailout = pov_finite_float(p, "adc_bailout");
		return true;
	case TOK_AMBIENT_LIGHT:
		pov_next(p);
		s->ambient_light = rgbft_rgb(pov_finite_colour(p, "ambient_light"));
		return true;
	case TOK_PHOTONS:
		read_photons(p);
		return true;
	case TOK_SUBSURFACE:
		read_subsurface(p);
		return true;
	case TOK_RADIOSITY:
		pov_read_radiosity(p);
		return true;
	case TOK_NUMBER_OF_WAVES:
		read_waves(p);
		return true;
	case TOK_NOISE_GENERATOR:
		pov_next(p);
		s->noise_generator = pov_noise_generator(p);
		return true;
	case TOK_MM_PER_UNIT:
		pov_next(p);
		s->subsurface.mm_per_unit = pov_positive(p, "mm_per_unit");
		return true;
	/* For what is not rendered anyway: height fields. */
	case TOK_MAX_INTERSECTIONS:
		pov_next(p);
		pov_float(p);
		return true;
	case TOK_HF_GRAY_16:
		pov_next(p);
		pov_bool(p, true);
		return true;
	case TOK_IRID_WAVELENGTH:
		pov_next(p);
		s->irid_wavelength = rgbft_rgb(pov_finite_colour(p, "irid_wavelength"));
		return true;
	case TOK_CHARSET:
		pov_next(p);
		pov_next(p);
		return true;
	default:
		return false;
	}
}

void pov_read_settings(struct pov *p)
{
	if (!pov_open(p))
		return;
	while (!pov_failed(p) && read_word(p))
		;
	pov_close(p, "global_settings");
}
