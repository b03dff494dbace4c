/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The one changeable variable of the program that is not on a stack: a signal handler has no other way
 * to say anything (POSIX.1-2017, 2.4.3).
 */
#include <config.h>

#include "base/interrupt.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <unistd.h>

static atomic_int came;
_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal handler may only use lock-free atomics");

static void on_signal(int number)
{
	int none = 0;

	if (!atomic_compare_exchange_strong(&came, &none, number))
		_exit(128 + number);
}

void interrupt_install(void)
{
	static const int number[] = { SIGINT, SIGTERM };
	struct sigaction act = { .sa_handler = on_signal, .sa_flags = SA_RESTART }, old;

	sigemptyset(&act.sa_mask);
	for (size_t i = 0; i < sizeof(number) / sizeof(*number); i++) {
		if (!sigaction(number[i], NULL, &old) && old.sa_handler != SIG_IGN)
			sigaction(number[i], &act, NULL);
	}
}

bool interrupt_asked(void)
{
	return atomic_load_explicit(&came, memory_order_relaxed) != 0;
}

int interrupt_status(void)
{
	int number = atomic_load(&came);

	return number ? 128 + number : 0;
}
