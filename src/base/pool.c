/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "base/pool.h"
#include "base/process.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <unistd.h>

struct worker {
	struct pool *pool;
	pthread_t id;
	uint32_t number;
};

struct pool {
	uint32_t threads, started;
	pthread_mutex_t lock;
	pthread_cond_t work, done;
	uint64_t round; /* counts calls of pool_run() */
	uint32_t busy; /* workers still in this round */
	bool quit;
	pool_job *job;
	void *arg;
	uint32_t n;
	_Atomic uint32_t next;
	struct worker worker[];
};

static void take_jobs(struct pool *p, uint32_t thread)
{
	uint32_t i;

	while ((i = atomic_fetch_add(&p->next, 1)) < p->n)
		p->job(p->arg, i, thread);
}

static void *work(void *arg)
{
	struct worker *w = arg;
	struct pool *p = w->pool;
	uint64_t seen = 0;

	process_arithmetic(); /* a thread starts with that of the one that started it */
	pthread_mutex_lock(&p->lock);
	for (;;) {
		while (p->round == seen && !p->quit)
			pthread_cond_wait(&p->work, &p->lock);
		if (p->quit)
			break;
		seen = p->round;
		pthread_mutex_unlock(&p->lock);
		take_jobs(p, w->number);
		pthread_mutex_lock(&p->lock);
		if (!--p->busy)
			pthread_cond_signal(&p->done);
	}
	pthread_mutex_unlock(&p->lock);
	return NULL;
}

struct pool *pool_new(uint32_t threads)
{
	struct pool *p = calloc(1, sizeof(*p) + threads * sizeof(p->worker[0]));

	if (!p)
		return NULL;
	p->threads = threads;
	pthread_mutex_init(&p->lock, NULL);
	pthread_cond_init(&p->work, NULL);
	pthread_cond_init(&p->done, NULL);
	for (uint32_t i = 1; i < threads; i++) {
		struct worker *w = &p->worker[i];

		w->pool = p;
		w->number = i;
		if (pthread_create(&w->id, NULL, work, w)) {
			pool_free(p);
			return NULL;
		}
		p->started++;
	}
	return p;
}

uint32_t pool_threads(const struct pool *p)
{
	return p->threads;
}

void pool_run(struct pool *p, uint32_t n, pool_job *job, void *arg)
{
	if (n == 1) { /* nobody needs to wake up for that */
		job(arg, 0, 0);
		return;
	}
	pthread_mutex_lock(&p->lock);
	p->job = job;
	p->arg = arg;
	p->n = n;
	atomic_store(&p->next, 0);
	p->busy = p->started;
	p->round++;
	pthread_cond_broadcast(&p->work);
	pthread_mutex_unlock(&p->lock);

	take_jobs(p, 0);

	pthread_mutex_lock(&p->lock);
	while (p->busy)
		pthread_cond_wait(&p->done, &p->lock);
	pthread_mutex_unlock(&p->lock);
}

void pool_free(struct pool *p)
{
	if (!p)
		return;
	pthread_mutex_lock(&p->lock);
	p->quit = true;
	pthread_cond_broadcast(&p->work);
	pthread_mutex_unlock(&p->lock);
	for (uint32_t i = 1; i <= p->started; i++)
		pthread_join(p->worker[i].id, NULL);
	pthread_cond_destroy(&p->done);
	pthread_cond_destroy(&p->work);
	pthread_mutex_destroy(&p->lock);
	free(p);
}

uint32_t pool_cores(void)
{
#ifdef __linux__
	cpu_set_t set;

	if (!sched_getaffinity(0, sizeof(set), &set)) {
		int n = CPU_COUNT(&set);

		return n > 0 ? (uint32_t)n : 1;
	}
#endif
	long n = sysconf(_SC_NPROCESSORS_ONLN);

	return n > 0 ? (uint32_t)n : 1;
}
