/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Accelerators and peers on the same rays, taking turns. A cell is one kind of ray over one world.
 */
#ifndef TESTS_BENCH_RACE_H
#define TESTS_BENCH_RACE_H

#include "accel/load.h"
#include "base/json_write.h"
#include "peers.h"
#include "worlds.h"

enum { ENGINES = 64, ROUNDS = 64, THREADS = 64 };
enum { WRONG_MISSED, WRONG_GHOST, WRONG_OTHER, WRONGS };

struct engine {
	char name[96];
	struct accel_choice choice;
	uint32_t precision;
	bool peer, one; /* one: ray by ray */
	ald_accel *it; /* not a peer's */
	struct geometry *geometry; /* instead of it, of a forest */
	ald_query q[THREADS];
	struct peer *tree;
	bool lent; /* tree is another engine's */
	struct peer_config config;
	struct peer_way way;
	double build, bytes; /* seconds by the clock, the median of all builds; of the structure */
	bool races[KINDS];
	double seconds[KINDS][ROUNDS], builds[ROUNDS];
	uint64_t wrong[KINDS][WRONGS];
};

struct bench {
	struct world world;
	struct shots shots;
	struct test_host host;
	struct peer_mesh *floats;
	struct engine *engine;
	uint32_t engines, rounds, builds, width, threads;
	double (*again)[ROUNDS]; /* [KINDS] the first engine once more: what noise there is */
	ald_hit *truth[KINDS]; /* what the first engine finds */
	uint32_t sampled, strays; /* of it, rays asked of brute force, and those that it answered otherwise */
	ald_hit hit[THREADS][BATCH];
	uint8_t hidden[THREADS][BATCH];
	bool leaves_out[KINDS]; /* not raced */
	bool counts, all, embree;
	double load[2], others; /* the machine's, before and after; share of it that others used meanwhile */
};

/* ---- race.c ---- */
bool engine_open(struct bench *, const char *name); /* at the end of the list; false: told why not */
void engine_close(struct engine *);
bool engine_rebuild(struct bench *, struct engine *);
/* Every step-th batch; seconds, of the processor with one thread and by the clock with more. */
double engine_fire(struct bench *, const struct engine *, unsigned kind, uint32_t step);
/* What it answers, for all rays of a kind. */
void engine_answers(struct bench *, const struct engine *, unsigned kind, ald_hit *out);
void race_truth(struct bench *); /* and its rays that are not camera rays */
void race_run(struct bench *);
void race_count_wrong(struct bench *);
/* Adds the usual rtcIntersect1 and, of all ways to call Embree, the two best of each kind, robust and not. */
void race_screen(struct bench *);

/* ---- tally.c ---- */
struct spread {
	double middle, low, high; /* the median, and where it surely (95 %) lies */
};
struct spread spread_of(const double *x, uint32_t n);
double median(const double *x, uint32_t n);
/* Of seconds to seconds, round by round. */
struct spread spread_ratio(const double *over, const double *under, uint32_t n);
enum verdict { BEHIND = -1, NO_VERDICT, AHEAD };
/* Is the ratio above 1, when what should be 1 is noise? */
enum verdict verdict_of(struct spread ratio, struct spread noise);
/* The best peer of a kind, robust or not; NULL: there is none. */
const struct engine *tally_best(const struct bench *, unsigned kind, bool robust);
void tally_print(const struct bench *);
void tally_json(const struct bench *, struct json_writer *);

#endif
