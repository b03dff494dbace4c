/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A scene and its geometry to a picture: tiles over the thread pool, each in waves of rays.
 */
#ifndef ALIDADE_RENDER_RENDER_H
#define ALIDADE_RENDER_RENDER_H

#include "accel/trace.h"
#include "base/diag.h"
#include "base/mem.h"
#include "base/pool.h"
#include "image/image.h"
#include "scene/scene.h"
#include "shade/shade.h"

#define RENDER_SPP_MOST 16384 /* of a budget that has no deadline and does not say */
#define RENDER_SPP_LIMIT (1u << 24)

enum render_aa {
	RENDER_AA_NONE, /* one ray through each pixel's centre */
	RENDER_AA_GRID, /* n x n a pixel */
	RENDER_AA_POV1, /* POV-Ray's method 1: neighbours, not recursive (manual 3.2.8.7) */
	RENDER_AA_POV2 /* POV-Ray's method 2: corners, recursive */
};

struct render_options {
	uint32_t width, height; /* of the whole picture */
	uint32_t crop_x, crop_y, crop_width, crop_height; /* the part to render; width 0: all */
	enum render_aa aa;
	uint32_t aa_n; /* grid: samples a side; pov1: samples a side; pov2: depth of recursion */
	double aa_threshold; /* pov1, pov2: summed difference of r, g and b after encoding */
	double aa_gamma; /* pov1, pov2: the encoding to compare in, 2.5 */
	uint32_t spp; /* samples a pixel, each of everything that is random, instead of aa; 0: as aa says */
	/* Samples in independent sets, so that their error is known: spp at most, RENDER_SPP_MOST if 0. */
	bool budget;
	double noise; /* a pixel has enough when its error as it is seen is below; 0: never */
	double deadline; /* on the clock of base/clock.h: what there is then is the picture; 0: none */
	double seconds; /* what was asked for, for the reports */
	bool clips; /* the picture's file has nothing brighter than white, so that noise there is not seen */
	bool texture_mip; /* pictures' smaller copies are there (pattern/mip.h), and are used */
	uint32_t blur_samples; /* focal blur: rays a sample; 0: until the picture is good enough */
	uint32_t tile; /* side in pixels, 0: default */
	bool alpha; /* the background is transparent as far as its filter and transmit say */
	enum indirect_method indirect; /* of scenes with a radiosity block */
	uint32_t indirect_samples; /* rays gathered a pixel, 0: default */
	double indirect_slack; /* of a cache: how much more than by default it may be off; 0: default, 1 */
	bool error; /* estimate standard errors: three more channels */
	bool lift; /* shadow rays of smooth meshes start where the smooth surface would be */
	bool verify; /* the geometry verifies: tell it of each ray what pixel it is for */
	uint64_t seed; /* other random numbers */
	bool camera_only; /* no shading at all: camera rays and their hits, for counting and timing */
	/* Called from one thread at a time, after each tile; pixels of the part to render. May be NULL. */
	void (*progress)(void *arg, uint64_t done, uint64_t total);
	/* Asked often, from any thread; true: leave the rest. May be NULL. */
	bool (*stop)(void *arg);
	void *arg;
};

/* Samples that every pixel has. */
static inline uint32_t render_pixel_samples(const struct render_options *o)
{
	bool all = o->aa == RENDER_AA_GRID || (o->aa == RENDER_AA_POV1 && o->aa_threshold <= 0);

	return o->spp ? o->spp : all ? o->aa_n * o->aa_n : 1;
}

enum render_ray {
	RENDER_CAMERA, RENDER_SHADOW, RENDER_REFLECTED, RENDER_REFRACTED, RENDER_GATHERED, RENDER_SUBSURFACE,
	RENDER_RAY_KINDS
};

/* What became of a budget. */
struct render_reached {
	bool told; /* there was one */
	bool missed; /* pixels did not get good enough, or had no sample of their own */
	bool cut; /* time was over within a pass: how far it came depends on the threads */
	double noise_asked, seconds_asked; /* 0: not asked for */
	double noise; /* root of the mean square of errors as they are seen, over all pixels and channels; below 0:
		       * unknown */
	double bound; /* the true one is below this with a probability of 95 % */
	uint64_t unfinished; /* pixels that are not good enough */
	uint64_t empty; /* pixels without a sample of their own */
	uint32_t passes, samples; /* of pixels that went on to the end; as spp it gives the same picture */
	uint32_t least, most; /* that a pixel's colour is the mean of */
	double mean;
};

struct render_counts {
	uint64_t cast[RENDER_RAY_KINDS], hit[RENDER_RAY_KINDS];
	uint64_t nonfinite; /* pixels of which a sample came out NaN or Inf; it is stored as 0 */
	uint32_t nonfinite_x, nonfinite_y; /* the first of them, by row then column */
	uint64_t pixels; /* finished */
	uint64_t samples;
	double seconds;
	struct render_reached reached;
	double error; /* mean over all pixels of the estimated standard error; below 0: not asked for */
};

/* About what rendering is going to take, beside the geometry. */
uint64_t render_memory(const struct render_options *, uint32_t threads);
/* Render into out, an image of the crop's size made here (R, G, B, A, linear, premultiplied; A is 1 but
 * where the background is seen through). Pixels not finished when stopped are all 0, and the status is
 * then STATUS_SIGINT; STATUS_NONFINITE if the picture is complete but nonfinite is not 0; STATUS_BUDGET if it
 * is, but a budget was missed. out is valid in all these cases. The same scene
 * and size give the same bytes for any accelerator, number of threads and
 * tile side, and a crop equals the same part of the whole. */
enum status render_scene(const struct scene *, const struct geometry *, const struct render_options *,
			 struct pool *, struct mem_book *, struct image *out, struct render_counts *,
			 struct diag *);

#endif
