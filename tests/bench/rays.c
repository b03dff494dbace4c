/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Rays a second, by kind of ray, world and accelerator; no test. All get the same rays in rounds, one after
 * another, in one process.
 *
 *	rays [options] [ENGINE ..]
 *	-m WORLD,..	worlds.c has the list
 *	-n ROUNDS	7
 *	-s WIDTH	of the picture whose camera rays are traced, 512; three quarters as high
 *	-t THREADS	1. Counted is the processor's time with one thread, the clock's with more
 *	-k KIND,..	of rays: camera, shadow, bounce, shuffled, ao; all
 *	-a		all: every world, instruction set and quality of Embree's, huge pages
 *	-b BUILDS	of each engine that is named, in turns, 3
 *	-c		counters, too: steps a ray
 *	-j FILE		everything as JSON
 *
 * An engine is as alidade -a has it (with @exact or @fast behind it, it is asked for that precision, and in exact
 * order what the host has to do is done too; with @one, it is called for each ray); or Embree's own calls without any
 * of Alidade, as peers.h names them; or "peers": all ways to call it are tried, and the best of each kind of ray race.
 * Without engines: bvh8 peers. Ratios, wrong answers and verdicts are the first one's.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "race.h"

/* What each ray cost in steps. */
static void report_counts(struct bench *b, struct engine *e)
{
	uint64_t count[ALD_COUNT_MAX];
	ald_hit *hit = malloc((size_t)b->shots.n[CAMERA] * sizeof(*hit));

	for (unsigned k = 0; k < KINDS && e->it; k++) {
		double n = b->shots.n[k];

		memset(count, 0, sizeof(count));
		e->q[0].count = count;
		engine_answers(b, e, k, hit);
		e->q[0].count = NULL;
		printf("  %s: %s: nodes %.2f, primitives %.2f, volumes %.2f a ray\n", e->name, kind_name[k],
		       (double)count[ALD_COUNT_NODES] / n, (double)count[ALD_COUNT_PRIMS] / n,
		       (double)count[ALD_COUNT_VOLUME_TESTS] / n);
	}
	free(hit);
}

/* Seconds that all processors, and this process, have worked. */
static void machine(double *all, double *own)
{
	FILE *f = fopen("/proc/stat", "r");
	unsigned long long v[8] = { 0 };
	struct timespec t;

	if (f) {
		if (fscanf(f, "cpu %llu %llu %llu %llu %llu %llu %llu %llu", &v[0], &v[1], &v[2], &v[3], &v[4], &v[5],
			   &v[6], &v[7]) < 4)
			memset(v, 0, sizeof(v));
		fclose(f);
	}
	*all = (double)(v[0] + v[1] + v[2] + v[5] + v[6] + v[7]) / (double)sysconf(_SC_CLK_TCK);
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	*own = (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void race(struct bench *b)
{
	double all[2], own[2], start = clock_seconds();

	getloadavg(&b->load[0], 1);
	machine(&all[0], &own[0]);
	race_run(b);
	machine(&all[1], &own[1]);
	getloadavg(&b->load[1], 1);
	b->others = (all[1] - all[0] - (own[1] - own[0])) / ((clock_seconds() - start) * pool_cores());
	b->others = b->others > 0 ? b->others : 0;
}

/* All in turns, so that none meets memory fresher than the others'. */
static bool build_again(struct bench *b)
{
	for (uint32_t r = 0; r < b->builds; r++) {
		for (uint32_t i = 0; i < b->engines; i++) {
			if (r && !engine_rebuild(b, &b->engine[i]))
				return false;
			b->engine[i].builds[r] = b->engine[i].build;
		}
	}
	for (uint32_t i = 0; i < b->engines; i++)
		b->engine[i].build = median(b->engine[i].builds, b->builds);
	return true;
}

static bool open_all(struct bench *b, char **names, int count)
{
	for (int i = 0; i < count && i < ENGINES / 2; i++) {
		if (!strcmp(names[i], "peers") && peer_there()) {
			b->embree = true;
			continue;
		}
		if (!engine_open(b, names[i]))
			return false;
	}
	if (!b->engines || b->engine[0].peer) {
		fprintf(stderr, "rays: the first engine has to be an accelerator\n");
		return false;
	}
	return build_again(b);
}

static int run(struct bench *b, const char *name, char **names, int count, struct json_writer *json)
{
	uint32_t width;
	bool fine;

	if (!world_make(&b->world, name)) {
		fprintf(stderr, "rays: no world %s; there are %s\n", name, worlds_all);
		return 2;
	}
	width = (uint32_t)(b->width * sqrt(b->world.share)) & ~127u;
	b->engines = 0;
	test_host_init(&b->host, b->threads, 0);
	b->floats = NULL;
	fine = open_all(b, names, count);
	if (fine) {
		shots_camera(&b->shots, &b->world, width < 128 ? 128 : width);
		race_truth(b);
		if (b->embree)
			race_screen(b);
		race(b);
		race_count_wrong(b);
		tally_print(b);
		for (uint32_t i = 0; i < b->engines && b->counts; i++)
			report_counts(b, &b->engine[i]);
		jw_object(json, NULL);
		tally_json(b, json);
		jw_end(json);
		shots_release(&b->shots);
		for (unsigned k = 0; k < KINDS; k++)
			free(b->truth[k]);
	}
	for (uint32_t i = b->engines; i--;)
		engine_close(&b->engine[i]);
	peer_mesh_free(b->floats);
	test_host_release(&b->host);
	world_release(&b->world);
	return !fine;
}

static void json_machine(struct json_writer *j)
{
	char line[200], *at;
	FILE *f = fopen("/proc/cpuinfo", "r");

	while (f && fgets(line, sizeof(line), f)) {
		at = strchr(line, ':');
		if (at && !strncmp(line, "model name", 10)) {
			line[strcspn(line, "\n")] = 0;
			jw_string(j, "processor", at + 2);
			printf("%s, %u cores\n", at + 2, pool_cores());
			break;
		}
	}
	if (f)
		fclose(f);
	jw_uint(j, "cores", pool_cores());
}

static bool kinds_of(struct bench *b, char *list)
{
	char *left = NULL;

	for (unsigned k = 0; k < KINDS; k++)
		b->leaves_out[k] = true;
	for (char *w = strtok_r(list, ",", &left); w; w = strtok_r(NULL, ",", &left)) {
		unsigned k = 0;

		while (k < KINDS && strcmp(w, kind_name[k]))
			k++;
		if (k == KINDS) {
			fprintf(stderr, "rays: no kind of rays is called %s\n", w);
			return false;
		}
		b->leaves_out[k] = false;
	}
	return true;
}

int main(int argc, char **argv)
{
	static char *usual[] = { "bvh8", "peers" };
	struct bench *b = calloc(1, sizeof(*b));
	char *worlds = NULL, *left = NULL;
	FILE *out = NULL;
	struct json_writer json;
	int c, status = 0;

	b->rounds = 7;
	b->width = 512;
	b->builds = 3;
	b->threads = 1;
	b->engine = calloc(ENGINES, sizeof(*b->engine));
	b->again = calloc(KINDS, sizeof(*b->again));
	while ((c = getopt(argc, argv, "n:s:m:t:j:b:k:ac")) != -1) {
		if (c == 'n')
			b->rounds = (uint32_t)atoi(optarg);
		else if (c == 's')
			b->width = (uint32_t)atoi(optarg) & ~127u;
		else if (c == 'm')
			worlds = strdup(optarg);
		else if (c == 'a')
			b->all = true;
		else if (c == 'c')
			b->counts = true;
		else if (c == 'b')
			b->builds = (uint32_t)atoi(optarg);
		else if (c == 'k' && !kinds_of(b, optarg))
			return 2;
		else if (c == 'k')
			continue;
		else if (c == 't')
			b->threads = (uint32_t)atoi(optarg);
		else if (c == 'j')
			out = fopen(optarg, "w");
		else
			return 2;
	}
	if (b->rounds < 1 || b->rounds > ROUNDS || b->width < 128 || b->width > 8192 || b->threads < 1 ||
	    b->threads > THREADS || b->builds < 1 || b->builds > ROUNDS)
		return 2;
	if (!out)
		out = fopen("/dev/null", "w");
	jw_init(&json, out, JW_INDENT);
	jw_object(&json, NULL);
	json_machine(&json);
	jw_array(&json, "worlds");
	worlds = worlds ? worlds : strdup(b->all ? worlds_all : worlds_usual);
	for (char *m = strtok_r(worlds, ",", &left); m && !status; m = strtok_r(NULL, ",", &left))
		status = optind < argc ? run(b, m, argv + optind, argc - optind, &json) :
					 run(b, m, usual, peer_there() ? 2 : 1, &json);
	jw_end(&json);
	jw_end(&json);
	jw_finish(&json);
	free(worlds);
	return status;
}
