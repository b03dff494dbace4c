/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A window of the text, which ends at the first }, is cut before some of its < into shares of about the same length.
 * How many < there are in each tells into which places its elements go. This is a guess: there may be some in comments.
 * So a share counts only if the one before it has ended where it begins, and has as many elements as were thought;
 * behind the first that has not, whoever called scans on. Windows are small enough to be in a cache still when they
 * are read again.
 */
#include <config.h>

#include "read/pov/share.h"

#include <stdint.h>
#include <string.h>

#include "read/pov/scan.h"

#define SHARE ((size_t)128 << 10) /* bytes */
#define SHARE_LEAST (SHARE / 4) /* what is worth handing over */
#define SHARES_MAX 64u
#define SHARES_EACH 4u /* a thread, as some take longer */

struct share {
	const char *begin, *stop, *at; /* at: behind what has been scanned of it */
	size_t first, most, count;
	bool last; /* of the list */
};

struct shares {
	share_element *one;
	void *list;
	const char *end;
	struct share share[SHARES_MAX];
};

static void count_job(void *arg, uint32_t i, uint32_t thread)
{
	struct share *s = &((struct shares *)arg)->share[i];
	const char *close = memchr(s->at, '}', (size_t)(s->stop - s->at));

	(void)thread;
	s->last = close;
	s->stop = close ? close : s->stop;
	s->most = scan_count(s->at, s->stop, '<');
}

static void scan_job(void *arg, uint32_t i, uint32_t thread)
{
	const struct shares *all = arg;
	struct share *s = &((struct shares *)arg)->share[i];
	const char *next;

	(void)thread;
	while (s->count < s->most) {
		next = all->one(all->list, s->at, all->end, s->first + s->count);
		if (!next)
			break;
		s->at = next;
		s->count++;
	}
}

/* Returns how many shares there are. */
static uint32_t cut(struct shares *all, const char *begin, const char *close, uint32_t n)
{
	size_t each = (size_t)(close - begin) / n;
	const char *at = begin;
	uint32_t i;

	for (i = 0; i < n && at < close; i++) {
		const char *aim = begin + each * (i + 1), *stop = NULL;

		aim = aim > at ? aim : at + 1;
		if (i + 1 < n)
			stop = memchr(aim, '<', (size_t)(close - aim));
		stop = stop ? stop : close;
		all->share[i] = (struct share){ .at = at, .begin = at, .stop = stop };
		at = stop;
	}
	return i;
}

/* Where each one's elements go. Returns how many shares have any. */
static uint32_t place(struct shares *all, uint32_t n, size_t first, size_t most)
{
	for (uint32_t i = 0; i < n; i++) {
		struct share *s = &all->share[i];

		s->first = first;
		s->most = s->most < most ? s->most : most;
		first += s->most;
		most -= s->most;
		if (s->last)
			return i + 1;
	}
	return n;
}

/* How many elements count; *whole: all that there are. */
static size_t join(const struct shares *all, uint32_t n, const char **at, bool *whole)
{
	size_t count = 0;

	for (uint32_t i = 0; i < n; i++) {
		const struct share *s = &all->share[i];

		*whole = !i || scan_blanks(*at, all->end) == s->begin;
		if (!*whole)
			break;
		*at = s->at;
		count += s->count;
		*whole = s->count == s->most;
		if (!*whole)
			break;
	}
	return count;
}

bool share_worth(const struct pool *pool, const char *at, const char *end)
{
	return pool && pool_threads(pool) > 1 && (size_t)(end - at) / SHARE_LEAST >= 2;
}

size_t share_scan(struct pool *pool, share_element *one, void *list, size_t first, size_t most, const char **at,
		  const char *end)
{
	struct shares all = { .one = one, .list = list, .end = end };
	uint32_t threads = pool ? pool_threads(pool) : 1;
	uint32_t shares = threads < SHARES_MAX / SHARES_EACH ? SHARES_EACH * threads : SHARES_MAX;
	bool whole = threads > 1;
	size_t count = 0;

	while (whole && count < most) {
		size_t window = (size_t)(end - *at) < shares * SHARE ? (size_t)(end - *at) : shares * SHARE;
		size_t worth = window / SHARE_LEAST;
		uint32_t n;

		if (worth < 2)
			break;
		n = cut(&all, *at, *at + window, worth < shares ? (uint32_t)worth : shares);
		pool_run(pool, n, count_job, &all);
		n = place(&all, n, first + count, most - count);
		pool_run(pool, n, scan_job, &all);
		count += join(&all, n, at, &whole);
		whole = whole && !all.share[n - 1].last;
	}
	return count;
}
