/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "accel/host.h"

#include <stdio.h>

#include "base/interrupt.h"
#include "base/process.h"

static void *host_alloc(void *ctx, size_t bytes, const char *what)
{
	struct accel_host *h = ctx;
	char purpose[40];

	snprintf(purpose, sizeof(purpose), "accel: %s", what ? what : "other");
	return mem_alloc(h->book, purpose, bytes);
}

static void host_free(void *ctx, void *p)
{
	(void)ctx;
	mem_free(p);
}

static void host_trim(void *ctx, void *p, size_t bytes)
{
	(void)ctx;
	mem_trim(p, bytes);
}

struct job {
	void (*run)(void *arg, uint32_t i);
	void *arg;
};

static void run_job(void *arg, uint32_t i, uint32_t thread)
{
	const struct job *j = arg;

	(void)thread;
	j->run(j->arg, i);
	process_arithmetic(); /* which a plugin should not, but may change */
}

static void host_parallel(void *ctx, uint32_t n, void (*run)(void *arg, uint32_t i), void *arg)
{
	struct accel_host *h = ctx;
	struct job j = { run, arg };

	pool_run(h->pool, n, run_job, &j);
}

static int host_progress(void *ctx, double done)
{
	(void)ctx;
	(void)done;
	return interrupt_asked();
}

static void host_log(void *ctx, int level, const char *text)
{
	struct accel_host *h = ctx;

	pthread_mutex_lock(&h->lock);
	if (h->diag)
		diag_report(h->diag, level <= 0 ? DIAG_ERROR : level >= 3 ? DIAG_DEBUG : (enum diag_level)level,
			    NULL, "accelerator %s: %s", h->plugin, text);
	pthread_mutex_unlock(&h->lock);
}

static int host_account(void *ctx, int64_t bytes, const char *what)
{
	struct accel_host *h = ctx;
	char purpose[40];

	snprintf(purpose, sizeof(purpose), "accel: %s", what ? what : "other");
	return mem_account_foreign(h->book, purpose, bytes);
}

void accel_host_init(struct accel_host *h, struct mem_book *book, struct pool *pool, struct diag *diag,
		     const char *plugin)
{
	*h = (struct accel_host){ .host = { .abi = ALD_ACCEL_ABI,
					    .size = sizeof(ald_host),
					    .ctx = h,
					    .threads = pool_threads(pool),
					    .alloc = host_alloc,
					    .free = host_free,
					    .parallel = host_parallel,
					    .progress = host_progress,
					    .log = host_log,
					    .account = host_account,
					    .trim = host_trim },
				  .book = book,
				  .pool = pool,
				  .diag = diag,
				  .plugin = plugin };
	pthread_mutex_init(&h->lock, NULL);
}

void accel_host_release(struct accel_host *h)
{
	pthread_mutex_destroy(&h->lock);
}
