/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * For tests that ask accelerators for hits and compare them to the bit. After cmocka.h.
 */
#ifndef TESTS_UNIT_ACCEL_FIXTURE_H
#define TESTS_UNIT_ACCEL_FIXTURE_H

#include <stdlib.h>
#include <string.h>

#include "accel/load.h"
#include "rays.h"

/* Sanitizers see what the code does with memory, which a few rays a mesh show as well as many: an eighth of
 * them, in as many batches of each sort. */
#if defined __SANITIZE_ADDRESS__
#define FEWER 8u
#define BATCH 512u
#else
#define FEWER 1u
#define BATCH 1024u
#endif

struct accel {
	struct accel_choice choice;
	ald_accel *it;
	ald_query q;
	uint64_t count[ALD_COUNT_MAX];
	ald_hit hit[BATCH];
	uint8_t hidden[BATCH];
};

static void print_text(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	(void)arg;
	(void)level;
	(void)pos;
	print_message("%s\n", text);
}

static int accel_open(struct accel *a, const char *name, struct test_host *h, const struct mesh *m)
{
	struct diag d = { .sink = print_text };
	ald_error err = { "" };
	size_t scratch = 0;
	int status;

	memset(a, 0, sizeof(*a));
	assert_int_equal(accel_load(&a->choice, name, &d), STATUS_OK);
	status = a->choice.plugin->build(&h->host, &m->prims, a->choice.value, &a->it, &err);
	if (status) {
		accel_unload(&a->choice);
		return status;
	}
	if (a->choice.plugin->scratch_size)
		scratch = a->choice.plugin->scratch_size(a->it);
	a->q.scratch = mem_zalloc(&h->book, "scratch", scratch);
	return ALD_OK;
}

static void accel_close(struct accel *a)
{
	a->choice.plugin->destroy(a->it);
	mem_free(a->q.scratch);
	accel_unload(&a->choice);
}

static void fresh(ald_hit *hit, const ald_ray *ray, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++)
		hit[i] = (ald_hit){ .t = ray[i].tmax, .prim = ALD_NONE, .part = ALD_NONE };
}

/* What calls find on the stack is what others left: let it be nothing that will do by chance. */
static __attribute__((noinline)) void spoil_stack(void)
{
	unsigned char x[1 << 17];

	memset(x, 0xa5, sizeof(x));
	__asm__ volatile("" : : "r"(x) : "memory");
}

enum { ASK_ALL, ASK_PIECES, ASK_EACH }; /* pieces: of all sizes, a few rays at first */

static void ask(struct accel *a, const ald_ray *ray, uint32_t n, int how, uint32_t hints)
{
	const ald_accel_plugin *p = a->choice.plugin;
	ald_hit again;

	fresh(a->hit, ray, n);
	if (how != ASK_EACH && p->intersect_n && p->occluded_n) {
		for (uint32_t at = 0, size = how == ASK_ALL ? n : 1; at < n; at += size++) {
			uint32_t some = n - at < size ? n - at : size;

			spoil_stack();
			p->intersect_n(a->it, &a->q, ray + at, a->hit + at, some, hints);
			spoil_stack();
			p->occluded_n(a->it, &a->q, ray + at, a->hidden + at, some, hints);
		}
		return;
	}
	for (uint32_t i = 0; i < n; i++) {
		int hit = p->intersect(a->it, &a->q, &ray[i], &a->hit[i]);

		assert_int_equal(!!hit, a->hit[i].prim != ALD_NONE);
		if (p->occluded) {
			a->hidden[i] = !!p->occluded(a->it, &a->q, &ray[i]);
		} else {
			fresh(&again, &ray[i], 1);
			a->hidden[i] = !!p->intersect(a->it, &a->q, &ray[i], &again);
		}
	}
}

static void show(const char *what, const char *mesh, const char *name, const ald_ray *r,
		 const ald_hit *want, const ald_hit *got)
{
	print_message("%s, %s against none, %s\n"
		      "ray %a %a %a  %a %a %a  t %a..%a mask %x skip %u after %u\n"
		      "none %a %u (%a %a), here %a %u (%a %a)\n",
		      mesh, name, what, r->org.x, r->org.y, r->org.z, r->dir.x, r->dir.y, r->dir.z,
		      r->tmin, r->tmax, r->mask, r->skip, r->after, want->t, want->prim, want->u, want->v,
		      got->t, got->prim, got->u, got->v);
}

static void compare(const char *mesh, const char *name, const struct accel *want, const struct accel *got,
		    const ald_ray *ray, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		if (memcmp(&want->hit[i], &got->hit[i], sizeof(want->hit[i]))) {
			show("nearest", mesh, name, &ray[i], &want->hit[i], &got->hit[i]);
			fail();
		}
		if (want->hidden[i] != got->hidden[i] ||
		    want->hidden[i] != (want->hit[i].prim != ALD_NONE)) {
			show("occluded", mesh, name, &ray[i], &want->hit[i], &got->hit[i]);
			fail();
		}
	}
}

/* For walk(): volumes, in their order, to a number. */
static inline int fold_volume(void *arg, const ald_volume *v)
{
	uint64_t *sum = arg;

	for (unsigned k = 0; k < 6; k++) {
		uint64_t b;

		memcpy(&b, k < 3 ? &(&v->box.lo.x)[k] : &(&v->box.hi.x)[k - 3], sizeof(b));
		*sum = (*sum ^ b) * 0x9e3779b97f4a7c15u;
		*sum ^= *sum >> 29;
	}
	return 1;
}

#endif
