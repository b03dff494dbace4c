/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What rounds say. A ratio is taken round by round, as what else goes on in a machine disturbs all of a round alike;
 * its median lies between two of the sorted ratios, whatever their distribution is, as the binomial one tells. The
 * first engine is fired twice in each round: what these ratios are away from 1 is noise, and no difference that is
 * smaller is one.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "race.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int by_size(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

struct spread spread_of(const double *x, uint32_t n)
{
	double v[ROUNDS], chance, outside;
	uint32_t k = 0;

	memcpy(v, x, n * sizeof(*v));
	qsort(v, n, sizeof(*v), by_size);
	chance = ldexp(1, -(int)n);
	for (outside = 2 * chance; outside <= 0.05 && 2 * (k + 1) < n; outside += 2 * chance) {
		k++;
		chance = chance * (n - k + 1) / k;
	}
	k -= k > 0;
	return (struct spread){ n % 2 ? v[n / 2] : (v[n / 2 - 1] + v[n / 2]) / 2, v[k], v[n - 1 - k] };
}

double median(const double *x, uint32_t n)
{
	return spread_of(x, n).middle;
}

struct spread spread_ratio(const double *over, const double *under, uint32_t n)
{
	double ratio[ROUNDS];

	for (uint32_t r = 0; r < n; r++)
		ratio[r] = over[r] / under[r];
	return spread_of(ratio, n);
}

static double noise_of(struct spread s)
{
	double up = s.high - 1, down = 1 / s.low - 1;

	return up > down ? up : down;
}

enum verdict verdict_of(struct spread ratio, struct spread noise)
{
	double n = noise_of(noise);

	if (ratio.low > 1 && ratio.middle > 1 + n)
		return AHEAD;
	if (ratio.high < 1 && ratio.middle < 1 - n)
		return BEHIND;
	return NO_VERDICT;
}

static const struct engine *first_peer(const struct bench *b)
{
	for (uint32_t i = 1; i < b->engines; i++) {
		if (!strcmp(b->engine[i].name, "embree1"))
			return &b->engine[i];
	}
	return NULL;
}

const struct engine *tally_best(const struct bench *b, unsigned kind, bool robust)
{
	const struct engine *best = NULL;

	for (uint32_t i = 1; i < b->engines; i++) {
		const struct engine *e = &b->engine[i];

		if (!e->peer || !e->races[kind] || e->config.robust != robust)
			continue;
		if (!best || median(e->seconds[kind], b->rounds) < median(best->seconds[kind], b->rounds))
			best = e;
	}
	return best;
}

static double rate(const struct bench *b, const struct engine *e, unsigned k)
{
	return b->shots.n[k] / median(e->seconds[k], b->rounds) * 1e-6;
}

static void print_engines(const struct bench *b)
{
	printf("%-38s %8s %6s", "", "build ms", "B/tri");
	for (unsigned k = 0; k < KINDS; k++)
		printf(" %15s", kind_name[k]);
	puts("");
	for (uint32_t i = 0; i < b->engines; i++) {
		const struct engine *e = &b->engine[i];

		printf("%-38s %8.0f %6.0f", e->name, e->build * 1e3, e->bytes / b->world.mesh.prims.count);
		for (unsigned k = 0; k < KINDS; k++) {
			uint64_t wrong = e->wrong[k][0] + e->wrong[k][1] + e->wrong[k][2];

			if (!e->races[k]) {
				printf(" %15s", "");
				continue;
			}
			printf(" %8.2f (%4.2f)", rate(b, e, k),
			       spread_ratio(b->engine[0].seconds[k], e->seconds[k], b->rounds).middle);
			if (wrong)
				printf(" %llu wrong", (unsigned long long)wrong);
		}
		puts("");
	}
}

static void print_against(const struct bench *b, const char *what, unsigned k, const struct engine *e)
{
	struct spread noise = spread_ratio(b->again[k], b->engine[0].seconds[k], b->rounds), s;
	static const char *const word[] = { "BEHIND", "no verdict", "ahead" };

	if (!e)
		return;
	s = spread_ratio(e->seconds[k], b->engine[0].seconds[k], b->rounds);
	printf("  %-9s %-13s %7.2f  %5.2f  %4.2f .. %4.2f  %-10s  %5.1f %%  %-38s %llu\n", kind_name[k], what,
	       rate(b, e, k), s.middle, s.low, s.high, word[verdict_of(s, noise) + 1], 100 * noise_of(noise), e->name,
	       (unsigned long long)(e->wrong[k][0] + e->wrong[k][1] + e->wrong[k][2]));
}

void tally_print(const struct bench *b)
{
	printf("\n%s: %u triangles, %u camera rays, %u others; %u thread%s; medians of %u rounds\n", b->world.name,
	       world_triangles(&b->world), b->shots.n[CAMERA], b->shots.n[AO], b->threads,
	       b->threads > 1 ? "s" : "", b->rounds);
	printf("load %.1f before, %.1f after; others used %.0f %% of the machine; brute force agrees on %u of %u rays "
	       "with %s\n", b->load[0], b->load[1], 100 * b->others, b->sampled - b->strays, b->sampled,
	       b->engine[0].name);
	puts("million rays a second (ratio to the first)");
	print_engines(b);
	if (first_peer(b) && b->embree) {
		printf("\n%s against Embree: its million rays a second, %s's as a multiple, where that lies (95 %%), "
		       "noise, wrong answers\n", b->engine[0].name, b->engine[0].name);
		for (unsigned k = 0; k < KINDS; k++) {
			print_against(b, "best", k, tally_best(b, k, false));
			print_against(b, "best, robust", k, tally_best(b, k, true));
			print_against(b, "rtcIntersect1", k, first_peer(b));
		}
	}
	fflush(stdout);
}

static void json_engine(const struct bench *b, struct json_writer *j, const struct engine *e)
{
	static const char *const wrong[] = { "missed", "ghosts", "elsewhere" };

	jw_object(j, NULL);
	jw_string(j, "name", e->name);
	jw_bool(j, "peer", e->peer);
	jw_double(j, "build_seconds", e->build);
	jw_array(j, "builds");
	for (uint32_t r = 0; r < b->builds && e->builds[r] > 0; r++)
		jw_double(j, NULL, e->builds[r]);
	jw_end(j);
	jw_double(j, "bytes", e->bytes);
	jw_object(j, "kinds");
	for (unsigned k = 0; k < KINDS; k++) {
		if (!e->races[k])
			continue;
		jw_object(j, kind_name[k]);
		jw_double(j, "rays_per_second", 1e6 * rate(b, e, k));
		jw_array(j, "seconds");
		for (uint32_t r = 0; r < b->rounds; r++)
			jw_double(j, NULL, e->seconds[k][r]);
		jw_end(j);
		jw_object(j, "wrong");
		for (unsigned i = 0; i < WRONGS; i++)
			jw_uint(j, wrong[i], e->wrong[k][i]);
		jw_end(j);
		jw_end(j);
	}
	jw_end(j);
	jw_end(j);
}

static void json_against(const struct bench *b, struct json_writer *j, const char *key, unsigned k,
			 const struct engine *e)
{
	struct spread noise = spread_ratio(b->again[k], b->engine[0].seconds[k], b->rounds), s;
	static const char *const word[] = { "behind", "none", "ahead" };

	if (!e)
		return;
	s = spread_ratio(e->seconds[k], b->engine[0].seconds[k], b->rounds);
	jw_object(j, key);
	jw_string(j, "engine", e->name);
	jw_double(j, "rays_per_second", 1e6 * rate(b, e, k));
	jw_double(j, "ratio", s.middle);
	jw_double(j, "low", s.low);
	jw_double(j, "high", s.high);
	jw_double(j, "noise", noise_of(noise));
	jw_string(j, "verdict", word[verdict_of(s, noise) + 1]);
	jw_end(j);
}

void tally_json(const struct bench *b, struct json_writer *j)
{
	jw_string(j, "world", b->world.name);
	jw_uint(j, "triangles", world_triangles(&b->world));
	jw_uint(j, "threads", b->threads);
	jw_uint(j, "rounds", b->rounds);
	jw_double(j, "load_before", b->load[0]);
	jw_double(j, "load_after", b->load[1]);
	jw_double(j, "others_share", b->others);
	jw_uint(j, "brute_force_rays", b->sampled);
	jw_uint(j, "brute_force_disagrees", b->strays);
	jw_object(j, "rays");
	for (unsigned k = 0; k < KINDS; k++)
		jw_uint(j, kind_name[k], b->shots.n[k]);
	jw_end(j);
	jw_array(j, "engines");
	for (uint32_t i = 0; i < b->engines; i++)
		json_engine(b, j, &b->engine[i]);
	jw_end(j);
	jw_object(j, "against_embree");
	for (unsigned k = 0; k < KINDS && b->embree && first_peer(b); k++) {
		jw_object(j, kind_name[k]);
		json_against(b, j, "best", k, tally_best(b, k, false));
		json_against(b, j, "best_robust", k, tally_best(b, k, true));
		json_against(b, j, "rtcIntersect1", k, first_peer(b));
		jw_end(j);
	}
	jw_end(j);
}
