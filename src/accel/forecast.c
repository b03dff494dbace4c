/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How much memory building is going to take, asked of the plugin before it builds; and, where there is not as much,
 * an error instead, which names what would fit.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accel/geometry.h"
#include "accel/load.h"
#include "accel/param.h"
#include "base/process.h"
#include "base/room.h"

#define SMALL ((uint64_t)64 << 20) /* bytes; what needs less isn't worth a look at what the machine has */
#define OFFERS 3u /* shown, at most */

struct amount {
	char text[24];
};

static struct amount amount(uint64_t bytes)
{
	double m = (double)bytes / 1048576;
	struct amount a;

	if (m < 10000)
		snprintf(a.text, sizeof(a.text), m < 10 ? "%.2f MiB" : "%.0f MiB", m);
	else
		snprintf(a.text, sizeof(a.text), "%.1f GiB", m / 1024);
	return a;
}

bool forecast_need(const struct geometry *g, const ald_accel_plugin *plugin, const double *value, struct need *n)
{
	static const double none[1] = { 0 };
	uint64_t levels = g->set.level_count, each = sizeof(struct worker) + levels * sizeof(struct query);
	uint64_t kept = atomic_load(&g->book->now), most = kept;

	for (uint32_t i = 0; i < levels; i++) {
		ald_memory m = { 0, 0, 0 };
		int status;

		if (!g->view[i].prims.count || g->view[i].accel)
			continue;
		if (!ACCEL_HAS(plugin, predict))
			return false;
		status = plugin->predict(&g->host.host, &g->view[i].prims, value ? value : none, &m);
		process_arithmetic(); /* which a plugin should not, but may change */
		if (status)
			return false;
		most = most > kept + m.peak ? most : kept + m.peak;
		kept += m.kept;
		each += m.scratch;
	}
	n->kept = kept + g->threads * each;
	n->most = most > n->kept ? most : n->kept;
	return true;
}

/* ---- what would fit ---- */

struct offer {
	char text[96];
	uint64_t most;
};

struct offers {
	const struct geometry *g;
	const struct accel_choice *choice;
	uint64_t fits; /* bytes that do */
	struct offer best[OFFERS]; /* the smallest last */
	uint32_t count;
};

static uint64_t whole(const struct offers *o, const struct need *n)
{
	return n->most > n->kept + o->choice->later ? n->most : n->kept + o->choice->later;
}

/* Of those that fit, the ones that take most are most like what was asked for. */
static void add_offer(struct offers *o, const char *text, uint64_t most)
{
	uint32_t at = 0;

	if (most > o->fits)
		return;
	while (at < o->count && o->best[at].most >= most)
		at++;
	if (at == OFFERS)
		return;
	o->count += o->count < OFFERS;
	memmove(&o->best[at + 1], &o->best[at], (o->count - 1 - at) * sizeof(*o->best));
	snprintf(o->best[at].text, sizeof(o->best[at].text), "%s", text);
	o->best[at].most = most;
}

static void try_value(struct offers *o, uint32_t param, double x)
{
	const ald_accel_plugin *plugin = o->g->plugin;
	const ald_param *p = &plugin->params[param];
	double value[ACCEL_PARAMS_MAX];
	char text[96], number[32];
	struct need n;

	memcpy(value, o->choice->value, sizeof(value));
	if (x == value[param])
		return;
	value[param] = x;
	if (!forecast_need(o->g, plugin, value, &n))
		return;
	param_value_text(p, x, number, sizeof(number));
	snprintf(text, sizeof(text), "-a %s:%s=%s", plugin->name, p->name, number);
	add_offer(o, text, whole(o, &n));
}

/* Each parameter's every choice, or its ends; inexact ones are not offered. */
static void try_params(struct offers *o)
{
	const ald_accel_plugin *plugin = o->g->plugin;

	for (uint32_t i = 0; plugin->params && plugin->params[i].name; i++) {
		const ald_param *p = &plugin->params[i];

		if (plugin->inexact >> i & 1)
			continue;
		for (uint32_t k = 0; p->type == ALD_CHOICE && p->label[k]; k++)
			try_value(o, i, k);
		if (p->type != ALD_CHOICE) {
			try_value(o, i, p->min);
			try_value(o, i, p->max);
		}
	}
}

static void try_other(void *arg, const struct accel_choice *c)
{
	struct offers *o = arg;
	char text[96];
	struct need n;

	if (!strcmp(c->plugin->name, o->g->plugin->name) || !(c->plugin->precisions & o->g->precision) ||
	    !forecast_need(o->g, c->plugin, c->value, &n))
		return;
	snprintf(text, sizeof(text), "-a %s", c->plugin->name);
	add_offer(o, text, whole(o, &n));
}

static void describe(const struct offers *o, char *out, size_t size)
{
	size_t at = 0;

	if (!o->count)
		snprintf(out, size, "no accelerator here would fit; fewer triangles or a smaller picture would");
	else
		at = (size_t)snprintf(out, size, "what would fit: ");
	for (uint32_t i = 0; i < o->count && at < size; i++)
		at += (size_t)snprintf(out + at, size - at, "%s%s (%s)", i ? ", " : "", o->best[i].text,
				       amount(o->best[i].most).text);
}

/* ---- the check ---- */

static enum status refuse(const struct geometry *g, const struct accel_choice *choice, uint64_t most, uint64_t fits,
			  const char *left, const char *anyway, struct diag *diag)
{
	struct offers o = { .g = g, .choice = choice, .fits = fits };
	struct diag silent = { 0 };
	struct geometry_counts c;
	char text[512], others[48] = "";

	try_params(&o);
	if (!o.count)
		accel_list(try_other, &o, &silent);
	describe(&o, text, sizeof(text));
	geometry_get_counts(g, &c);
	if (c.primitives + c.instances)
		snprintf(others, sizeof(others), " and %llu other primitives",
			 (unsigned long long)(c.primitives + c.instances));
	return diag_fail(diag, STATUS_MEMORY, NULL,
			 "accelerator %s: with %llu triangles%s it would take about %s, the scene's %s and the "
			 "picture's %s included, and %s; %s%s",
			 g->plugin->name, (unsigned long long)c.triangles, others, amount(most).text,
			 amount(atomic_load(&g->book->now)).text, amount(choice->later).text, left, text, anyway);
}

enum status forecast_check(struct geometry *g, const struct accel_choice *choice, struct diag *diag)
{
	uint64_t now = atomic_load(&g->book->now), most;
	char left[128], anyway[96] = "";
	struct need n;
	struct room room;

	g->memory.predicted = forecast_need(g, g->plugin, choice ? choice->value : NULL, &n);
	if (!g->memory.predicted)
		return STATUS_OK;
	g->memory.predicted_most = n.most;
	g->memory.predicted_kept = n.kept;
	if (!choice)
		return STATUS_OK;
	most = n.most > n.kept + choice->later ? n.most : n.kept + choice->later;
	if (g->book->limit) {
		snprintf(left, sizeof(left), "--memory allows %s", amount(g->book->limit).text);
		return most > g->book->limit ? refuse(g, choice, most, g->book->limit, left, anyway, diag) : STATUS_OK;
	}
	if (!choice->guard || most - now < SMALL)
		return STATUS_OK;
	room_find(&room, "");
	if (most - now <= room.bytes)
		return STATUS_OK;
	snprintf(left, sizeof(left), "beside the scene %s are left %s", amount(room.bytes).text, room.what);
	snprintf(anyway, sizeof(anyway), "; --memory=%.0fG tries all the same", ceil((double)most / 1073741824));
	return refuse(g, choice, most, now + room.bytes, left, anyway, diag);
}
