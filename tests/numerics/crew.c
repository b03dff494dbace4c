/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "crew.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { CELLS = 1024, PROCESSES = 64, LINE = 400 };

struct cell {
	_Atomic bool told;
	bool good;
	char name[LINE], detail[LINE];
	struct tally tally;
};

struct board { /* all processes see it */
	_Atomic uint32_t next, cells; /* to claim; how many there are, once somebody knows */
	struct cell cell[CELLS];
};

static struct board *board;
static int bell[2]; /* a byte comes down it when a cell is done */
static uint32_t here = UINT32_MAX, mine; /* the cell that this process is at; the next that it runs */

bool crew_claims(void)
{
	here++;
	return here == mine && here < CELLS;
}

uint32_t crew_cell(void)
{
	return here;
}

void crew_tell(const char *name, const struct tally *t, bool good, const char *detail)
{
	struct cell *c = &board->cell[here];

	snprintf(c->name, sizeof(c->name), "%s", name);
	snprintf(c->detail, sizeof(c->detail), "%s", detail);
	c->tally = *t;
	c->good = good;
	atomic_store(&c->told, true);
	mine = atomic_fetch_add(&board->next, 1);
	if (write(bell[1], "", 1) != 1)
		_exit(1);
}

static void work(void (*all)(void))
{
	close(bell[0]);
	mine = atomic_fetch_add(&board->next, 1);
	all();
	atomic_store(&board->cells, here + 1);
	_exit(0);
}

/* Cells that follow those already printed, as far as they are done. */
static uint32_t print(uint32_t done)
{
	for (; done < CELLS && atomic_load(&board->cell[done].told); done++) {
		const struct cell *c = &board->cell[done];

		printf("%sok %u - %s\n# %s\n", c->good ? "" : "not ", done + 1, c->name, c->detail);
	}
	fflush(stdout);
	return done;
}

static void add(struct tally *a, const struct tally *b)
{
	uint64_t *to = &a->rays;
	const uint64_t *from = &b->rays;

	for (size_t i = 0; i < TALLY_COUNTS; i++)
		to[i] += from[i];
	a->t_error = fmax(a->t_error, b->t_error);
}

static void print_sums(uint32_t cells)
{
	for (int class = 'a'; class <= 'z'; class++) {
		struct tally sum = { 0 };
		unsigned n = 0;

		for (uint32_t i = 0; i < cells; i++) {
			if (board->cell[i].name[0] == class) {
				add(&sum, &board->cell[i].tally);
				n++;
			}
		}
		if (n)
			printf("# class %c: %u cells, %llu rays, hard %llu, silhouette %llu, neighbour %llu, sheet "
			       "%llu, self %llu, foreign %llu, wall missed %llu, unlike %llu; without the sieve "
			       "%llu, otherwise %llu\n",
			       class, n, (unsigned long long)sum.rays, (unsigned long long)tally_hard(&sum),
			       (unsigned long long)sum.silhouettes, (unsigned long long)sum.neighbours,
			       (unsigned long long)sum.wrong_sheet, (unsigned long long)sum.self,
			       (unsigned long long)sum.foreign, (unsigned long long)sum.missed,
			       (unsigned long long)sum.unlike, (unsigned long long)sum.plain,
			       (unsigned long long)sum.unlike_plain);
	}
}

bool crew_run(unsigned processes, uint32_t first, void (*all)(void))
{
	pid_t pid[PROCESSES];
	uint32_t done = first, cells, bad = 0;
	char c[64];
	int status;

	processes = processes < 1 ? 1 : processes > PROCESSES ? PROCESSES : processes;
	board = mmap(NULL, sizeof(*board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	if (board == MAP_FAILED || pipe(bell)) {
		printf("Bail out! no memory\n");
		return false;
	}
	atomic_store(&board->next, first);
	fflush(stdout);
	for (unsigned i = 0; i < processes; i++) {
		pid[i] = fork();
		if (!pid[i])
			work(all);
	}
	close(bell[1]);
	while (read(bell[0], c, sizeof(c)) > 0)
		done = print(done);
	for (unsigned i = 0; i < processes; i++) {
		if (pid[i] < 0 || waitpid(pid[i], &status, 0) != pid[i] || status) {
			printf("# process %u ended badly\n", i);
			bad++;
		}
	}
	cells = atomic_load(&board->cells);
	for (uint32_t i = first; i < cells; i++) {
		if (!board->cell[i].told) { /* then its process has died */
			board->cell[i].told = true;
			snprintf(board->cell[i].name, LINE, "Cell %u was not finished", i + 1);
		}
		bad += !board->cell[i].good;
	}
	print(done);
	print_sums(cells);
	printf("%u..%u\n", first + 1, cells);
	return !bad && cells > first && cells <= CELLS;
}
