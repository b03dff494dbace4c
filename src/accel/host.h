/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The services that a plugin finds in its ald_host.
 */
#ifndef ALIDADE_ACCEL_HOST_H
#define ALIDADE_ACCEL_HOST_H

#include <pthread.h>

#include "alidade/accel.h"
#include "base/diag.h"
#include "base/mem.h"
#include "base/pool.h"

struct accel_host {
	ald_host host; /* ctx points to this struct, so it must not move */
	struct mem_book *book;
	struct pool *pool;
	struct diag *diag; /* NULL once nobody listens any more */
	const char *plugin; /* its name, for messages */
	pthread_mutex_t lock; /* of diag */
};

void accel_host_init(struct accel_host *, struct mem_book *, struct pool *, struct diag *,
		     const char *plugin);
void accel_host_release(struct accel_host *);

#endif
